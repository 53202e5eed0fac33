"""`fairlead` and `python -m fairlead`: the command line, and the first Ctrl-C that may end it.

Reading in the verbs takes part of a second, in which Ctrl-C is as good a wish as later.
"""

import atexit
import gc
import sys

YOUNG = 200_000
"""Objects that are made before Python looks for circles among them. By default 700, and starting makes 150,000 to stay:
Python would look through all of them again and again, a fifth of the time of a short run."""


def main() -> None:
    """Run the command line with the arguments of this process; does not return."""
    gc.set_threshold(YOUNG, 20, 20)
    atexit.register(gc.freeze)  # nor is anything to be looked through at the end: the process gives back all it has
    try:
        from fairlead.cli import main as command

        command()
    except KeyboardInterrupt:
        print("interrupted", file=sys.stderr)  # noqa: T201 - what prints otherwise may be what is not there yet
        sys.exit(130)  # as `exit_codes` says, which may not be there yet either


if __name__ == "__main__":
    main()
