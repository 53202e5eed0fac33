"""An answer depends on the scene alone: not on names, order, processor, libraries, or on what ran before.

    plays.py       scenes as text: the bundled models, and random ones (tests/scenes)
    worker.py      a process that plays scenes under one setting and keeps what came out
    settings.py    the settings: hash seed, build, BLAS, instructions of numpy
    renaming.py    the same scene under other names
    reordering.py  the same scene in another order: lines of the netlist, or instances and unknowns of the flat model
    lockstep.py    the first trial step at which a scene and its twin part, and what was decided there
    outcome.py     what came out of a run, and how two of them differ
    known.py       what still depends on something that should not matter, with the reason
    ties.py        scenes of which two outcomes are equally right

`make invariance` runs all of it; `python -m tests.invariance` takes fresh seeds and prints them.
"""
