"""Events, for every method: where guards fire, and what follows.

Given a step with its interpolant, or a point. Does
      the first crossing of a step (crossing.py), the next step's length with time events (pace.py), growth from rest;
      arrival at the end of a piece (arrival.py), and there, if a guard fired or a time event changed something,
      a settlement (settling.py): impulses (impulse.py, rebound.py), the order of release of what a jump of load lets go
      (release.py, fast_way.py), zones, a consistent point (consistent.py), until no guard is violated (violators.py);
      who switches too often (chatter.py).
Says  GO_ON with the phase that follows, or a status of codes.py. Zones change nowhere else but inside `stepping`, and
      for as long as a row inside one of its steps is written (record/between.py).
"""
