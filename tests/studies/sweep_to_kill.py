"""A process that sweeps until it is killed, and writes its table after every row: folder of the table, how many cases.

`tests.studies.jobs.GATE` in the environment says which case it never gets past.
"""

import math
import sys
from pathlib import Path

from fairlead.studies.sweeps import table
from fairlead.studies.sweeps.design import Design
from fairlead.studies.sweeps.sweep import sweep
from tests.studies.jobs import job, square

if __name__ == "__main__":
    table.PERIOD, table.SHARE = 0.0, math.inf
    design = Design(grid={"x": [str(k) for k in range(int(sys.argv[2]))]})
    sweep(job(square), design, Path(sys.argv[1]), processes=2)
