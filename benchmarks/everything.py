"""All benchmarks of speed in a row: what `make bench` runs.

    python benchmarks/everything.py            an hour and a half, of which an hour peers at a thousand blocks
    python benchmarks/everything.py --full     all methods and tolerances of compare.py, hours

Each script is a process of its own, so that none inherits the caches or the memory of another, and one that fails
does not keep the others from running.
"""

import argparse
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).parent
SCRIPTS = ("compare.py", "bend_growth.py", "engine_choice.py", "scaling.py")


def main() -> None:
    """Command line; the exit code says whether all scripts ended well."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--full", action="store_true", help="all methods and tolerances")
    full = parser.parse_args().full
    failed = []
    for script in SCRIPTS:
        print(f"\n== {script}", flush=True)
        extra = ["--full"] if full and script == "compare.py" else []
        if subprocess.run([sys.executable, str(HERE / script), *extra], check=False).returncode:
            failed.append(script)
    sys.exit(f"failed: {', '.join(failed)}" if failed else 0)


if __name__ == "__main__":
    main()
