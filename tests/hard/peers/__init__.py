"""Hard cases that other tools can state too: scipy with events, PathSim, MuJoCo, and how far each is off.

`python -m tests.hard --peers` plays them and writes their part of docs/stability.md. No quick test plays a peer.

    dry.py       bodies, springs and contacts as plain numbers, and what a zone does to them: the statement of each case
    cases.py     the cases, each with its closed form and its netlist
    played.py    one function for each tool: positions at the sample times
    table.py     the part of the page
"""
