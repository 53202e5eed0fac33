"""Pictures of a sweep, and indices of what matters.

Owner of what `fairlead plot SWEEP` draws (`draw.py`), of the numbers behind a tornado (`tornado.py`) and of Sobol's and
Morris' indices (`indices.py`). Contract: all come from the table alone; no model is loaded and nothing is run.
"""
