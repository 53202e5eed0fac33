"""The table of `fairlead cost`, and what is said below it."""

from typing import TYPE_CHECKING

from fairlead.cli.study import print_table

if TYPE_CHECKING:
    from fairlead.analysis.cost.choice import Choice
    from fairlead.analysis.cost.deviation import OutputError
    from fairlead.analysis.cost.study import Row, Study

COLUMNS = (
    "equations", "engine", "accuracy", "numerical", "modelling", "elements", "worst output", "at end", "at worst",
    "switches", "late by", "CPU", "wall", "set-up",
)  # fmt: skip
NAMED = 6  # of the runs that were not begun
LEFT = ("equations", "engine", "worst output")


def print_study(study: "Study", choices: list["Choice"]) -> None:
    """Print table, reference, remarks, choices."""
    console = print_table(COLUMNS, LEFT, (_cells(study, row) for row in ordered(study)), 190)
    for line in _below(study):
        console.print(line, markup=False)
    for choice in choices:
        console.print(choice.sentence, markup=False)


def ordered(study: "Study") -> list["Row"]:
    """The lines as a reader looks for them: by equations, engine and accuracy, loose first."""
    labels = list(dict.fromkeys(row.rung.equations.label for row in study.rows))
    engines = list(dict.fromkeys(row.rung.engine for row in study.rows))
    return sorted(
        study.rows,
        key=lambda row: (labels.index(row.rung.equations.label), engines.index(row.rung.engine), -row.rung.accuracy),
    )


def _cells(study: "Study", row: "Row") -> list[str]:
    from fairlead.analysis.cost.choice import seconds
    from fairlead.analysis.cost.deviation import worst

    rung = row.rung
    head = [rung.equations.label or "as it is", rung.engine, f"{rung.accuracy:.0e}".replace("e-0", "e-")]
    if not row.timed.finished:
        return [*head, row.timed.status, *[""] * (len(COLUMNS) - 4)]
    found = worst(row.numerical, statistical=study.sensitive) if row.numerical else None
    late = row.switching.most if row.switching is not None else None
    return [
        *head, _told(study, row, row.numerical), "exact" if rung.equations.exact else _told(study, row, row.modelling),
        _told(study, row, row.discretisation),
        found.name if found else "", f"{found.end:.2g} {found.unit}" if found else "",
        f"{found.worst:.2g} {found.unit}" if found else "", _switches(row), "-" if late is None else seconds(late),
        seconds(row.timed.cpu), seconds(row.timed.wall), seconds(row.timed.setup),
    ]  # fmt: skip


def _told(study: "Study", row: "Row", errors: "list[OutputError] | None") -> str:
    """An error, or what it is below: nothing can be told below the floor."""
    from fairlead.analysis.cost.choice import percent

    size, below = study.told(errors, row)
    return f"{'<' if below else ''}{percent(size)}"


def _switches(row: "Row") -> str:
    if row.switching is None:
        return str(row.timed.switches)
    both = row.switching
    return str(both.mine) if both.mine == both.theirs else f"{both.mine} of {both.theirs}"


def _below(study: "Study") -> list[str]:
    from fairlead.analysis.cost.choice import front, knee, percent

    lines = []
    if not study.whole:
        lines.append(f"Studied is t = {study.span[0]:g} ... {study.span[1]:g} s only, to keep within the budget; later "
                     "errors may be larger. --full or a larger --budget takes more.")  # fmt: skip
    reference = study.reference
    if reference is not None:
        spread = "" if reference.spread is None else f"; they agree to {percent(reference.spread)}"
        if study.sensitive and spread:
            spread = f"; statistics of tight runs scatter by {percent(reference.spread)}"
        worst = f" (worst: {reference.spread_of})" if reference.spread_of else ""
        lines.append(f"Errors are rms over time, relative to the range; reference: {reference.label}{spread}{worst}.")
        if study.sensitive:
            lines.append(
                "Tight runs do not converge: the scene is sensitive to everything. Compared are means and standard "
                "deviations over time."
            )
        elif reference.spread is not None and not reference.agrees:
            lines.append("The references do not agree better than that; errors below it cannot be told.")
        if reference.dissent:
            lines.append(f"{reference.dissent[0].upper()}{reference.dissent[1:]}.")
    lines += [*study.remarks, *study.unfinished()]
    if study.left_out:
        left, more = study.left_out[:NAMED], len(study.left_out) - NAMED
        named = "; ".join(left) + (f"; and {more} more" if more > 0 else "")
        lines.append(f"{'Interrupted' if study.interrupted else 'Out of budget'}; not begun: {named}. The same command "
                     "goes on from here.")  # fmt: skip
    best = knee(front(study))
    if best is not None:
        lines.append(f"Knee: {best.rung.label}.")
    return lines
