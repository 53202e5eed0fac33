"""What the exit code of the command says; the one list, which docs/netlist.md prints.

The errors of `fairlead.errors` carry theirs. 70 is EX_SOFTWARE of sysexits.h, so that a script never takes a mistake
of fairlead for a verdict on a model; 130 is what shells give for Ctrl-C. SIGTERM and SIGHUP end the process as they end
any other, 143 and 129 in shells, when what was computed is kept and run.json says so.
"""

OK, MODEL_ERROR, USAGE, NUMERICAL_FAILURE, BUDGET, LIMIT_BROKEN, UNFORESEEN, INTERRUPTED = 0, 1, 2, 3, 4, 5, 70, 130

MEANINGS = {
    OK: "done; of `check`: no mistakes, though there may be warnings",
    MODEL_ERROR: "a mistake in the netlist or in a component; of `margins`: damaged results; "
    "of `doctor`: something to mend",
    USAGE: "the command cannot be carried out as typed, such as a run into a folder with results",
    NUMERICAL_FAILURE: "the engine could not go on; what was computed is kept",
    BUDGET: "a budget of the run (`max_wall`, `max_steps`, `max_events`) is used up; what was computed is kept",
    LIMIT_BROKEN: "a limit of the netlist is broken; of `run` and `margins`",
    UNFORESEEN: "a mistake of fairlead itself",
    INTERRUPTED: "Ctrl-C; what was computed is kept",
}
