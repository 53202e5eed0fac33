"""python -m tests.hard"""

import sys

from tests.hard.scoreboard import main

if __name__ == "__main__":
    sys.exit(main())
