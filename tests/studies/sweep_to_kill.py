"""A process that sweeps until it is killed: folder of the table, how many cases, seconds that each waits."""

import sys
from pathlib import Path

from fairlead.studies.sweeps import table
from fairlead.studies.sweeps.design import Design
from fairlead.studies.sweeps.sweep import sweep
from tests.studies.jobs import job, square

if __name__ == "__main__":
    table.PERIOD = 0.05
    design = Design(grid={"x": [str(k) for k in range(int(sys.argv[2]))], "wait": [sys.argv[3]]})
    sweep(job(square), design, Path(sys.argv[1]), processes=2)
