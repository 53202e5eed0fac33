"""More than two hundred mistakes of users, and what a good answer to each must hold.

They were written from the pages alone, before the checks they ask for: by whom it was not known which of them fairlead
finds. `python -m tests.mistakes` plays them and prints the score.

    entry.py                what a mistake is
    bases.py                the netlists that are damaged
    netlist_mistakes.py     in the text of a netlist, of a table, of what it includes
    command_mistakes.py     on the command line
    component_mistakes.py   in a class of one's own
    python_mistakes.py      in calls from Python
    second_look.py          fifty more by somebody else, most of them in calls from Python
    play.py, judge.py       make one and catch the answer; what is missing in it
    known.py                those that are not answered well yet, with a word on why
"""
