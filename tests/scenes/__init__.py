"""Random scenes: netlists from a seed, for whoever wants many that nobody has thought of.

    networks.network(seed)   masses, shafts, springs, stops and contacts in rows, stacks, trees, rings and nets
    blows.blow(seed)         bodies that run into each other, and what decides each impact (impulses.py)
    routes.route(seed)       a line through bends, pulleys, tubes and clamps, hauled or paid out

    catches.py, rebounds.py, ties.py, varying.py, ratios.py, starts.py, jumps.py    other classes, see classes.py
    verdicts.py              plays scenes of all classes and asks every oracle (oracles/) whether they are right

A seed gives the same text on every machine. Every scene loads and checks clean, and runs to its end in a moment.
By hand: `python -m tests.scenes --seed 7 --count 20`, `python -m tests.scenes.verdicts --class ties --seeds 0:20`.
"""
