"""`fairlead` and `python -m fairlead`: the command line, and the first Ctrl-C that may end it.

Reading in the verbs takes part of a second, in which Ctrl-C is as good a wish as later.
"""

import sys


def main() -> None:
    """Run the command line with the arguments of this process; does not return."""
    try:
        from fairlead.cli import main as command

        command()
    except KeyboardInterrupt:
        print("interrupted", file=sys.stderr)  # noqa: T201 - what prints otherwise may be what is not there yet
        sys.exit(130)  # as `exit_codes` says, which may not be there yet either


if __name__ == "__main__":
    main()
