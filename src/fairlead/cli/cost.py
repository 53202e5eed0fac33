"""`fairlead cost`: what accuracy costs in time, as a table, a figure, and a sentence for each of three targets."""

import json
import pathlib
from typing import TYPE_CHECKING, Annotated, Any

import typer

from fairlead.cli.exit_codes import INTERRUPTED
from fairlead.cli.options import AllowFmu, AsJson, Libraries, Netlist, Quiet, Settings, Verbose, parse_settings
from fairlead.cli.places import refuse_place
from fairlead.cli.study import Budget, Fresh, Outputs, number, say, write_record
from fairlead.cli.terminal import echo

if TYPE_CHECKING:
    from fairlead.analysis.cost.choice import Choice
    from fairlead.analysis.cost.ladder import Ladder
    from fairlead.analysis.cost.study import Study


def cost(
    netlist: Netlist,
    settings: Settings,
    libraries: Libraries,
    budget: Budget = "60 s",
    outputs: Outputs = None,
    accuracy: Annotated[str, typer.Option(metavar="A,B,C", help="Accuracies to try.")] = "1e-2,1e-3,1e-4,1e-5",
    engine: Annotated[str, typer.Option(metavar="A,B", help="Engines to try. Default: all installed.")] = "",
    friction: Annotated[str, typer.Option(metavar="A,B", help="Treatments to try. Default: hold,binding.")] = "",
    creep: Annotated[str, typer.Option(metavar="A,B", help="Creeps to try. Default: 10 and 0.1 times it.")] = "",
    finer: Annotated[str, typer.Option(metavar="A,B", help="How much finer elements to try. Default: 0.5,2.")] = "",
    full: Annotated[bool, typer.Option("--full", help="Study all of the scene's time, however long it takes.")] = False,
    fresh: Fresh = False,
    write: Annotated[
        pathlib.Path | None, typer.Option(metavar="FILE", help="Write the choice as a settings file for run.")
    ] = None,
    target: Annotated[str, typer.Option(metavar="PERCENT", help="The target whose choice --write writes.")] = "1 %",
    out: Annotated[
        pathlib.Path | None,
        typer.Option("--out", "-o", metavar="DIR", help="Table and figure go here. Default: results/NAME-cost."),
    ] = None,
    allow_fmu: AllowFmu = False,
    as_json: AsJson = False,
    quiet: Quiet = False,
    verbose: Verbose = False,
) -> None:
    """What accuracy costs: error against time for accuracies, engines, treatments and elements. Ctrl-C keeps all."""
    import fairlead
    from fairlead.analysis.cost.choice import TARGETS, choose
    from fairlead.analysis.cost.cost import cost as study_cost
    from fairlead.analysis.cost.kept_runs import KeptRuns, default_folder
    from fairlead.report.cost_figure import draw

    refuse_place("--out", out or pathlib.Path("results") / f"{pathlib.Path(netlist).stem}-cost", folder=True)
    refuse_place("--write", write)
    fixed, aim = parse_settings(settings), number("--target", target, "1")
    study = study_cost(
        lambda more: fairlead.load(netlist, set={**fixed, **more}, libraries=libraries, allow_fmu=allow_fmu),
        _ladder(accuracy, engine, friction, creep, finer), budget=number("--budget", budget, "s"),
        signals=outputs or ["*"], kept=KeptRuns(None if fresh else default_folder()), libraries=libraries,
        full=full, note=None if quiet or as_json else say,
    )  # fmt: skip
    choices = [choose(study, one) for one in sorted({*TARGETS, aim}, reverse=True)]
    folder = out or pathlib.Path("results") / f"{study.name}-cost"
    figure = draw(study, folder / "cost.png")
    record = _record(study, choices)
    written = write_record(folder, "cost.json", record)
    if as_json:
        echo(json.dumps(record, indent=1))
    elif not quiet:
        from fairlead.cli.cost_table import print_study

        print_study(study, choices)
        echo(f"wrote {figure} and {written} (every output by itself)")
    if write is not None:
        _write(write, next(choice for choice in choices if choice.target == aim), study, fixed)
    if study.interrupted:
        raise typer.Exit(INTERRUPTED)


def _ladder(accuracy: str, engine: str, friction: str, creep: str, finer: str) -> "Ladder":
    from fairlead.analysis.cost.ladder import Ladder

    return Ladder(
        tuple(number("--accuracy", one, "1") for one in _words(accuracy)),
        _words(engine) or None, _words(friction) or None,
        tuple(number("--creep", one, "m/s") for one in _words(creep)) or None,
        tuple(number("--finer", one, "1") for one in _words(finer)) or None,
    )  # fmt: skip


def _words(text: str) -> list[str]:
    return [word.strip() for word in text.split(",") if word.strip()]


def _write(path: pathlib.Path, choice: "Choice", study: "Study", fixed: dict[str, str]) -> None:
    from fairlead.netlist.settings_file import write_settings

    if not choice.settings:
        echo(f"warning: {path} is not written. {choice.sentence}", err=True)
        return
    use = f"Use: fairlead run {study.name} --settings {path}"
    comment = f"Made by fairlead cost {study.name}.\n{choice.sentence}\n{use}"
    echo(f"wrote {write_settings(path, {**fixed, **choice.settings}, comment)}")


def _record(study: "Study", choices: list["Choice"]) -> dict[str, Any]:
    """All of a study as JSON: the lines with the error of every output."""
    from dataclasses import asdict

    def errors(found: Any) -> Any:
        return None if found is None else [asdict(one) for one in found]

    rows = [
        {
            "label": row.rung.label, "settings": row.rung.settings, **row.timed.plain(),
            "error": {name: study.size(getattr(row, name)) for name in ("numerical", "modelling", "discretisation")},
            "below_floor": {name: study.told(getattr(row, name), row)[1]
                            for name in ("numerical", "modelling", "discretisation")},
            "numerical": errors(row.numerical), "modelling": errors(row.modelling),
            "discretisation": errors(row.discretisation),
            "switching": None if row.switching is None else asdict(row.switching),
        }
        for row in study.rows
    ]  # fmt: skip
    reference = study.reference
    return {
        "name": study.name, "span": study.span, "whole": study.whole, "sensitive": study.sensitive,
        "interrupted": study.interrupted, "reference": None if reference is None else reference.label,
        "floor": None if reference is None else reference.spread,
        "dissent": "" if reference is None else reference.dissent, "remarks": study.remarks,
        "left_out": study.left_out, "rows": rows,
        "choices": [{"target": c.target, "sentence": c.sentence, "settings": dict(c.settings)} for c in choices],
    }  # fmt: skip
