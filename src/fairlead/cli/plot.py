"""`fairlead plot`: a figure for print of a run or of a model, pictures of a sweep, figures of the source paper."""

import enum
import pathlib
from typing import TYPE_CHECKING, Annotated

import typer

from fairlead.cli.options import Libraries, Quiet, Settings, Verbose, parse_settings
from fairlead.cli.places import FIGURES, refuse_place
from fairlead.cli.terminal import echo
from fairlead.errors import did_you_mean, listing

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from fairlead.results import Result

PAPER_CURVE = {"curve": "hump", "stiction": 0.35, "peak": 0.5, "peak_velocity": 0.1, "coulomb": 0.4}
"""Of Figure 3, which has no numbers: the shape it shows, with the low friction of Figure 6 at rest."""
LEVELS = (0.35, 0.6)
"""Friction of Figure 6."""


class What(enum.StrEnum):
    """What can be drawn; the last two are of a model."""

    SIGNALS = "signals"
    PROFILE = "profile"
    MAP = "map"
    ZONES = "zones"
    LEDGER = "ledger"
    FRICTION = "friction"
    WORK_PRECISION = "work-precision"


def _begun(incomplete: str) -> list[str]:
    """What can be drawn whose name begins so, for completion."""
    return [what for what in What if what.startswith(incomplete)]


def plot(
    settings: Settings,
    libraries: Libraries,
    source: Annotated[str, typer.Argument(metavar="RUN|MODEL", help="A folder of a run or sweep, or a netlist.")] = "",
    words: Annotated[
        list[str] | None,
        typer.Argument(metavar="WHAT", help=f"What to draw: {', '.join(What)}; or names of signals.",
                       autocompletion=_begun),
    ] = None,
    signals: Annotated[
        list[str] | None, typer.Option("--signals", metavar="PATTERN", help="Signals, or parts with zones. Repeatable.")
    ] = None,
    at: Annotated[
        list[str] | None,
        typer.Option("--at", metavar="TIME", help="Times of a profile; of signals and zones from when to when."),
    ] = None,
    out: Annotated[
        pathlib.Path | None,
        typer.Option("--out", "-o", metavar="FILE",
                     help="Write here, as PNG, SVG or PDF by its ending. Of --paper: a folder."),
    ] = None,
    paper: Annotated[bool, typer.Option("--paper", help="Make Figures 3, 5 and 6 of the source paper.")] = False,
    figure: Annotated[str, typer.Option(metavar="NAME", help="Of a sweep: which figure. Default: the first.")] = "",
    quiet: Quiet = False,
    verbose: Verbose = False,
) -> None:
    """Draw signals, a profile, a map, zones, the ledger, friction or work-precision, for print; or a sweep."""
    from fairlead.studies.sweeps.table import is_sweep

    what, named = _asked(words or [])
    signals = [*named, *(signals or ())]
    of_sweep = bool(source) and is_sweep(pathlib.Path(source))
    into_folder = paper or of_sweep
    refuse_place("--out", out, folder=into_folder, endings=() if into_folder else FIGURES)
    if of_sweep:
        written = _of_sweep(pathlib.Path(source), figure, what, out)
    elif paper:
        written = _paper(out or pathlib.Path("results") / "paper")
    elif not source or what is None:
        raise typer.BadParameter("plot wants a run or a model, and what to draw (or --paper).")
    elif what in (What.FRICTION, What.WORK_PRECISION):
        _refuse_what_it_ignores(source, what, signals, at)
        written = [_of_model(source, what, settings, libraries, out)]
    else:
        from fairlead.quantities import si
        from fairlead.report.printed import printed

        result, folder = _result(source, settings, libraries)
        times = [si(text, "s") for text in at or ()]
        written = [printed(result, what.value, out or folder / f"{what.value}.png", signals, times)]
    if not quiet:
        for file in written:
            echo(f"wrote {file}")


def _refuse_what_it_ignores(source: str, what: What, signals: list[str], at: list[str] | None) -> None:
    """Raise BadParameter for a folder of a run, and for signals and times, of what is drawn of a model."""
    if pathlib.Path(source).is_dir():
        raise typer.BadParameter(
            f"{what.value} is drawn of a model, not of a run; {source} is a folder. Give the netlist, "
            f"as in: fairlead plot {_netlist_of(source) or 'NETLIST'} {what.value}"
        )
    if signals or at:
        raise typer.BadParameter(f"{what.value} is drawn of a model and takes neither signals nor --at.")


def _netlist_of(folder: str) -> str:
    """The netlist that the run in a folder was made of; "" where that cannot be told."""
    from fairlead.errors import FairleadError
    from fairlead.results.run_file import load

    try:
        return str(load(pathlib.Path(folder)).get("netlist") or "")
    except FairleadError:
        return ""


def _asked(words: list[str]) -> tuple[What | None, list[str]]:
    """What is to be drawn, and the signals named behind it or alone: `plot RUN block.x pad.slip`."""
    if not words or words[0] in list(What):
        return (What(words[0]) if words else None), words[1:]
    if not any(sign in words[0] for sign in ".*?["):
        near = did_you_mean(words[0], list(What))
        told = f"{words[0]!r} is nothing to draw. {near} There are {listing(list(What))}; or name signals."
        raise typer.BadParameter(told)
    return What.SIGNALS, words


def _of_sweep(place: pathlib.Path, figure: str, what: What | None, out: pathlib.Path | None) -> list[pathlib.Path]:
    """All pictures that fit the design of a sweep, in a folder of the figure's name."""
    from fairlead.studies.pictures.draw import draw, folder_name
    from fairlead.studies.pictures.rows import Rows

    if what is not None:
        raise typer.BadParameter(f"{what.value} is of a run; of a sweep everything that fits is drawn (--figure NAME).")
    rows = Rows.read(place)
    chosen = rows.figure(figure)
    folder = place if place.is_dir() else place.parent
    written, reasons = draw(rows, chosen, out or folder / "figures" / folder_name(chosen))
    for reason in reasons:
        echo(reason, err=True)
    return written


def _result(source: str, settings: list[str], libraries: list[str]) -> tuple["Result", pathlib.Path]:
    """The run in a folder; of a model a run in memory, with what a figure may want recorded. And where figures go."""
    import fairlead
    from fairlead.analysis.statics.to_show import shown_besides
    from fairlead.result import Result

    path = pathlib.Path(source)
    if path.is_dir():
        if settings:
            raise typer.BadParameter("--set changes a model, and a run is over. Give the netlist.")
        return Result.open(path), path
    model = fairlead.load(source, set=parse_settings(settings), libraries=libraries)
    shown_besides(model)
    return model.run(out=None), pathlib.Path("results") / model.netlist.name


def _of_model(
    source: str, what: What, settings: list[str], libraries: list[str], out: pathlib.Path | None
) -> pathlib.Path:
    """Friction of every kind of contact of a model, or what accuracy costs it."""
    import fairlead

    fixed = parse_settings(settings)
    name = fairlead.load(source, set=fixed, libraries=libraries).netlist.name
    file = out or pathlib.Path("results") / name / f"{what.value}.png"
    file.parent.mkdir(parents=True, exist_ok=True)
    if what is What.FRICTION:
        from fairlead.cli.friction import contacts_of
        from fairlead.report.friction_figure import draw_all

        contacts, _ = contacts_of(source, settings, libraries, "")
        drawn = {}
        for names, one in contacts.items():
            found = one.characteristic(1.0)
            drawn[f"{names}: {found.label}"] = found
        return draw_all(drawn, file)
    from fairlead.analysis.cost.cost import cost
    from fairlead.analysis.cost.kept_runs import KeptRuns, default_folder
    from fairlead.analysis.cost.ladder import Ladder
    from fairlead.report.cost_figure import draw as draw_cost

    study = cost(
        lambda more: fairlead.load(source, set={**fixed, **more}, libraries=libraries), Ladder(), budget=60.0,
        signals=["*"], kept=KeptRuns(default_folder()), libraries=libraries,
    )  # fmt: skip
    return draw_cost(study, file)


def _paper(folder: pathlib.Path) -> list[pathlib.Path]:
    """Figures 3, 5 and 6 of the source paper, each as PNG and PDF."""
    import matplotlib

    from fairlead.report.figures import STYLE
    from fairlead.report.printed import save

    with matplotlib.rc_context({**STYLE, "backend": "agg"}):
        figures = _figures()
        return [save(figure, folder / f"{name}{ending}")
                for name, figure in figures.items() for ending in (".png", ".pdf")]  # fmt: skip


def _figures() -> dict[str, "Figure"]:
    import fairlead
    from fairlead.analysis.characteristic import characteristic
    from fairlead.component.parameters import make
    from fairlead.component.registry import known_types
    from fairlead.report.printed.paper import figure3, figure5, figure6

    members = known_types()["Contact"].members  # type: ignore[attr-defined]
    values = make(members["binding"], form="literal", curve=dict(PAPER_CURVE), creep=1e-4)
    runs = []
    for mu in LEVELS:
        runs.append(fairlead.load("single_bend", set={"mu": mu, "method": "binding"}).run(out=None))
    return {
        "figure3": figure3(characteristic(values, 100.0)), "figure5": figure5(values, 100.0),
        "figure6": figure6(runs, [f"mu = {mu:.2f}" for mu in LEVELS]),
    }  # fmt: skip
