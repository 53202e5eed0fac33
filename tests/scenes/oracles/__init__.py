"""What decides whether a run is right, each in a file that says what it can see and what it cannot.

    beginning.py   given places and speeds are there at the start
    energy.py      the ledger of the run closes
    momentum.py    every body obeys Newton's law under the forces that its neighbours show
    laws.py        forces are those that springs, friction and sources of the netlist give
    impulses.py    speeds jump as the laws of impact allow
    agreement.py   two runs show the same motion: another accuracy, another engine, a mirrored scene
    symmetry.py    bodies that are mirror images of each other, or equal, move so
    ramps.py       a load that jumps does what one that rises very fast does
    sensitive.py   until when a scene can be foretold, and how much of an error it makes of a small one

None of them knows how fairlead computes: they read recorded signals and the netlist.
"""
