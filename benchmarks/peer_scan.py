"""Compare scipy's ways through the belt and the chain at equal measured error.

Every method runs over its tolerance and, with the smooth law, over its width. Printed is the cheapest
run at each error; all runs go to `data/peers_<case>.json`. A run that fails or takes too long is
kept with its reason; a run below a second is timed three times.

    python benchmarks/peer_scan.py belt
    python benchmarks/peer_scan.py chain --blocks 100
"""

import argparse
import json
import platform

import numpy as np
import scipy
from peer_cases import Belt, Chain
from peers import DATA, IMPLICIT, SOLVERS, Case, Peer, error, event_driven, reference_positions, smooth

TOLERANCES = tuple(10.0**-k for k in range(3, 10))
WALL = 20.0  # [s]; a run that takes longer is no rival
WIDTHS = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6)  # [m/s]


def scan(case: Case, quick: bool = False) -> list[dict]:
    """All methods over tolerance and, for the smooth law, its width; failures are reported as such."""
    rows = []
    reference = reference_positions(case)
    tolerances = TOLERANCES[:4] if quick else TOLERANCES
    for method in SOLVERS:
        for rtol in tolerances:
            rows.append(_measured(case, reference, "events", method, rtol, None))
    for method in IMPLICIT:
        for width in WIDTHS:
            for rtol in tolerances[1:5]:
                rows.append(_measured(case, reference, "smooth", method, rtol, width))
    return rows


def _measured(case: Case, reference: np.ndarray, law: str, method: str, rtol: float, width: float | None) -> dict:
    row = {"law": law, "method": method, "rtol": rtol, "width": width}
    try:
        peer = _once(case, law, method, rtol, width)
    except (RuntimeError, TimeoutError, ValueError) as problem:
        return {**row, "failed": str(problem)}
    walls = [peer.wall]
    if peer.wall < 1.0:
        walls += [_once(case, law, method, rtol, width).wall for _ in range(2)]
    return {**row, "error": error(case, peer, reference), "wall_s": min(walls), **peer.counters}


def _once(case: Case, law: str, method: str, rtol: float, width: float | None) -> Peer:
    if law == "events":
        return event_driven(case, method, rtol, WALL)
    return smooth(case, method, rtol, width, WALL)


def cheapest(rows: list[dict], wanted: float) -> dict | None:
    """The fastest run whose measured error is at most `wanted`."""
    good = [row for row in rows if row.get("error", np.inf) <= wanted]
    return min(good, key=lambda row: row["wall_s"]) if good else None


def main() -> None:
    """Command line: scan one case, print the cheapest run at each error, write all rows."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("case", choices=("belt", "chain"))
    parser.add_argument("--blocks", type=int, default=100)
    parser.add_argument("--quick", action="store_true", help="fewer tolerances")
    a = parser.parse_args()
    case = Belt() if a.case == "belt" else Chain(a.blocks)
    rows = scan(case, a.quick)
    label = "belt" if a.case == "belt" else f"chain_{a.blocks}"
    versions = {"python": platform.python_version(), "numpy": np.__version__, "scipy": scipy.__version__}
    machine = f"{platform.machine()}, {platform.system()}"
    result = {"case": label, "versions": versions, "machine": machine, "rows": rows}
    (DATA / f"peers_{label}.json").write_text(json.dumps(result, indent=1) + "\n")
    for wanted in (1e-2, 1e-3, 1e-4, 1e-5, 1e-6):
        for law in ("events", "smooth"):
            print(f"{wanted:g} {law}:", cheapest([row for row in rows if row["law"] == law], wanted))


if __name__ == "__main__":
    main()
