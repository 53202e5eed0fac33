"""The study of docs/accuracy.md: `fairlead cost` over all bundled models, one table, made by one command.

    python benchmarks/accuracy.py                    all models, 30 s each; writes docs/accuracy.md
    python benchmarks/accuracy.py --budget 120       more of each model's time
    python benchmarks/accuracy.py belt capstan       these only, printed and not written
"""

from __future__ import annotations

import argparse
import pathlib
from collections.abc import Iterable

import fairlead.models

import fairlead
from fairlead.analysis.cost.choice import choose, percent, seconds
from fairlead.analysis.cost.cost import cost
from fairlead.analysis.cost.kept_runs import KeptRuns, default_folder
from fairlead.analysis.cost.study import Row, Study
from fairlead.errors import FairleadError

PAGE = pathlib.Path(__file__).resolve().parents[1] / "docs" / "accuracy.md"
PINNED = {"single_bend": {"method": "binding", "line.ruck_force": "null"}}  # the law of the paper
BEGIN, END = "<!-- table: benchmarks/accuracy.py -->", "<!-- end of table -->"
HEAD = (
    "model", "time studied", "references agree to", "engine", "1e-2", "1e-3", "1e-4", "1e-5", "modelling", "elements"
)  # fmt: skip


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("models", nargs="*", help="bundled models; default: all, and the page is written")
    parser.add_argument("--budget", type=float, default=30.0, help="seconds for each model")
    options = parser.parse_args()
    folder = pathlib.Path(next(iter(fairlead.models.__path__)))
    names = options.models or sorted(path.stem for path in folder.glob("*.yaml"))
    lines, sentences = [], []
    for name in names:
        print(name, flush=True)
        try:
            study = cost(lambda more, name=name: fairlead.load(name, set={**PINNED.get(name, {}), **more}),
                         budget=options.budget, kept=KeptRuns(default_folder()))  # fmt: skip
        except FairleadError as error:
            sentences.append(f"- `{name}`: {str(error).splitlines()[0]}")
            continue
        lines += rows(study)
        sentences += advice(study)
        if study.interrupted:
            break
    text = "\n".join([table(lines), "", *sentences])
    print(text)
    if not options.models:
        write(text, options.budget)


def rows(study: Study) -> Iterable[list[str]]:
    """A line for each engine on the scene as it is: error and time at each accuracy."""
    own = [row for row in study.rows if row.rung.equations.axis == "scene"]
    part = f"{study.span[1] - study.span[0]:g} s" + ("" if study.whole else " (part)")
    agree = "no reference" if study.reference is None else percent(study.reference.spread)
    if study.sensitive:
        agree += " (statistics)"
    for engine in dict.fromkeys(row.rung.engine for row in own):
        found = {f"{row.rung.accuracy:.0e}": row for row in own if row.rung.engine == engine}
        first = next(iter(found.values()))
        modelling = "exact" if first.rung.equations.exact else percent(study.size(first.modelling))
        cells = [cell(study, found.get(accuracy)) for accuracy in ("1e-02", "1e-03", "1e-04", "1e-05")]
        yield [study.name, part, agree, engine, *cells, modelling, percent(study.size(first.discretisation))]


def cell(study: Study, row: Row | None) -> str:
    if row is None:
        return "-"
    if not row.timed.finished:
        return "too slow" if row.timed.status == "budget" else row.timed.status
    return f"{percent(study.size(row.numerical))}, {seconds(row.timed.cpu)}"


def advice(study: Study) -> list[str]:
    """What the study says of 1 %, and why a line has no number."""
    remarks = [f"  {remark}" for remark in study.remarks if "used up" not in remark]
    return [f"- `{study.name}` {choose(study, 0.01).sentence}", *remarks]


def table(lines: list[list[str]]) -> str:
    return "\n".join("| " + " | ".join(line) + " |" for line in [HEAD, ["---"] * len(HEAD), *lines])


def write(text: str, budget: float) -> None:
    """Put the table into the page, between its marks."""
    page = PAGE.read_text(encoding="utf-8")
    before, _, rest = page.partition(BEGIN)
    _, _, after = rest.partition(END)
    made = f"Made with {budget:g} s for each model.\n\n{text}"
    PAGE.write_text(f"{before}{BEGIN}\n\n{made}\n\n{END}{after}", encoding="utf-8")


if __name__ == "__main__":
    main()
