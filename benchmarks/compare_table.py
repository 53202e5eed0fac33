"""What a comparison says: the cheapest run at each error, ratios, aims; as text on the terminal."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

ERRORS = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7)
# Case and error: solve time aimed at [s] on a machine where the best peer took the second time [s] (None: it does
# not get there), and C written by hand for these very equations the third. The ratio is what can be compared.
AIMS = {
    ("belt", 1e-4): (1e-3, 60e-3, None),
    ("belt", 1e-6): (2e-3, None, None),
    ("chain-100", 1e-4): (10e-3, 0.5, 2.3e-3),
    ("chain-1000", 1e-4): (0.3, 3.4, 0.11),
    ("chain-1000", 1e-6): (0.6, None, 0.17),
}


def cheapest(rows: Iterable[dict], wanted: float) -> dict | None:
    """The row with the least CPU time at an error of at most `wanted`."""
    good = [one for one in rows if one.get("error", 1.0) <= wanted]
    return min(good, key=lambda one: one["cpu"]) if good else None


def ratios(rows: list[dict]) -> list[dict[str, Any]]:
    """Per error asked for: the cheapest row of fairlead and of its peers, and how many times less fairlead takes."""
    table = []
    for wanted in ERRORS:
        ours = cheapest((one for one in rows if one["program"] == "fairlead"), wanted)
        theirs = cheapest((one for one in rows if one["program"] != "fairlead"), wanted)
        if ours is not None:
            ratio = theirs["cpu"] / ours["cpu"] if theirs else None
            table.append({"error": wanted, "fairlead": ours, "peer": theirs, "ratio": ratio})
    return table


def show(name: str, rows: list[dict]) -> None:
    """Print all rows of a case, the ratios and the aims."""
    print(f"\n{name}: ms; error over 0.1 m (closed form or converged reference); accuracy of MuJoCo: its step [s]")
    print(f"{'':30}{'accuracy':>9}{'width':>8}{'error':>10}{'CPU':>10}{'loop':>10}{'wall':>10}"
          f"{'steps':>8}{'rhs':>8}{'LU':>7}{'switches':>9}{'rounds':>7}")  # fmt: skip
    for one in rows:
        head = f"{one['series']:30}{one['accuracy']:9.0e}{one['width'] or 0:8.0e}"
        if "failed" in one:
            print(f"{head}   {one['failed'][:110]}")
            continue
        count = one["counters"]
        evaluations, factored = count.get("rhs", count.get("nfev", 0)), count.get("factorisations", count.get("nlu", 0))
        times = "".join(f"{1e3 * one[key]:10.2f}" for key in ("cpu", "solve", "wall"))
        counts = f"{count.get('steps', 0):8}{evaluations:8}{factored:7}{count.get('switches', 0):9}{one['rounds']:7}"
        print(f"{head}{one['error']:10.1e}{times}{counts}")
    print(f"\n{'error at most':14}{'fairlead CPU':>14}  {'by':30}{'best peer CPU':>15}  {'by':38}{'ratio':>7}")
    for line in ratios(rows):
        print(ratio_line(line))
    for (case, wanted), (aim, peer, by_hand) in AIMS.items():
        if case == name and any(one["program"] == "fairlead" for one in rows):
            print(verdict(rows, wanted, aim, peer, by_hand))


def ratio_line(line: dict) -> str:
    """One line of the table of ratios."""
    ours, theirs = line["fairlead"], line["peer"]
    text = f"{line['error']:<14.0e}{1e3 * ours['cpu']:11.2f} ms  {label(ours):30}"
    if theirs is None:
        return text + "  none gets there"
    name = f"{theirs['program']} {label(theirs)}"
    return text + f"{1e3 * theirs['cpu']:12.1f} ms  {name:38}{line['ratio']:7.1f}"


def verdict(rows: list[dict], wanted: float, aim: float, peer: float | None, by_hand: float | None) -> str:
    """What was aimed at, and what was found: as a ratio of solve times to the best peer where there is one."""
    ours = [one for one in rows if one["program"] == "fairlead" and one.get("error", 1.0) <= wanted]
    theirs = cheapest((one for one in rows if one["program"] != "fairlead"), wanted)
    beside = f", C by hand {1e3 * by_hand:g} ms" if by_hand else ""
    text = f"aim at {wanted:g}: {1e3 * aim:g} ms of solve time (best peer there {peer or 'never'} s{beside})"
    if not ours:
        return f"{text}: NOT met, fairlead does not get there"
    best = min(one["least_solve"] for one in ours)
    text += f"; here {1e3 * best:.2f} ms"
    if peer is None or theirs is None:
        return f"{text}: {'met' if best <= aim else 'NOT met'} by the clock of this machine"
    ratio = theirs["least_cpu"] / best
    return f"{text}, {ratio:.0f} times less than the best peer (aim {peer / aim:.0f}): {verb(ratio >= peer / aim)}"


def verb(met: bool) -> str:
    """The verdict in a word."""
    return "met" if met else "NOT met"


def label(one: dict) -> str:
    """Who won, with the setting."""
    width = f", {one['width']:.0e} m/s" if one["width"] else ""
    return f"{one['law']} {one['method']} {one['accuracy']:.0e}{width}"
