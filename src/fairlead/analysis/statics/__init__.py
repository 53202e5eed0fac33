"""Forces and shapes that follow from a netlist without a run.

Given the flat model.
Does  laid_route.py and on_the_drum.py place a line, machines.py and tracing.py find what moves it, schedule.py its
      steady stretches; states.py, sliding.py, cone.py and shares.py give tensions, solution.py puts all together.
Says  tables in SI units, and what a run records of them (to_show.py, route_record.py); ModelError for bad routes.
"""
