"""`fairlead run`: simulate a netlist, leave a directory of results, and say how far to trust them."""

import json
import pathlib
import warnings
from typing import TYPE_CHECKING, Annotated, Any

import typer

from fairlead.cli.exit_codes import BUDGET, INTERRUPTED, LIMIT_BROKEN, NUMERICAL_FAILURE, OK
from fairlead.cli.options import (
    AllowFmu,
    AsJson,
    Libraries,
    Netlist,
    Quiet,
    Settings,
    Verbose,
    parse_settings,
    with_space,
)
from fairlead.cli.places import refuse_place
from fairlead.cli.terminal import echo
from fairlead.errors import RunWarning

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from fairlead import Model, Result
    from fairlead.pacing import Pacer

EXIT_CODES = {"finished": OK, "interrupted": INTERRUPTED, "budget": BUDGET}
"""How the status in run.json ends the process; any other status is a numerical failure."""
LARGE = 100e6
"""Bytes of results from which on a run says how to have fewer."""


def run(
    netlist: Netlist,
    settings: Settings,
    libraries: Libraries,
    settings_file: Annotated[
        pathlib.Path | None,
        typer.Option("--settings", metavar="FILE", help="Settings as cost --write leaves them; --set wins over them."),
    ] = None,
    out: Annotated[
        pathlib.Path | None,
        typer.Option("--out", "-o", metavar="DIR", help="Leave the results here. Default: results/NAME."),
    ] = None,
    real_time: Annotated[
        str | None,
        typer.Option(
            "--real-time",
            metavar="STEP",
            help="Steps of this length, such as 1ms, each when the clock is due. run.real_time: without clock.",
        ),
    ] = None,
    force: Annotated[bool, typer.Option("--force", help="Replace the results of a finished run.")] = False,
    csv: Annotated[bool, typer.Option("--csv", help="Also write the signals as series.csv.")] = False,
    report: Annotated[bool, typer.Option("--report", help="Also write report.html.")] = False,
    profile: Annotated[
        bool, typer.Option("--profile", help="Say which components cost the time, and one thing to try.")
    ] = False,
    allow_fmu: AllowFmu = False,
    as_json: AsJson = False,
    quiet: Quiet = False,
    verbose: Verbose = False,
) -> None:
    """Simulate a netlist. Ctrl-C ends a run early and keeps what was computed."""
    import fairlead
    from fairlead.cli.growing import Growing
    from fairlead.cli.progress import progress_bar
    from fairlead.model import Place
    from fairlead.netlist.settings_file import read_settings

    refuse_place("--out", out, folder=True)
    chosen = read_settings(settings_file) if settings_file is not None else {}
    given = {**chosen, **parse_settings(settings), **_step_of_clock(real_time, settings)}
    model = fairlead.load(netlist, set=given, libraries=libraries, allow_fmu=allow_fmu)
    if report:
        from fairlead.analysis.statics.to_show import shown_besides

        shown_besides(model)
    with progress_bar(pathlib.Path(netlist).stem, quiet or as_json) as progress, warnings.catch_warnings():
        warnings.simplefilter("ignore", RunWarning)  # told below the table
        seen = progress
        if not (quiet or as_json):
            seen = Growing(model, out or pathlib.Path("results") / model.netlist.name, LARGE, progress)
            seen.before()
        place = out or Place.RESULTS
        if real_time is None:
            result = model.run(out=place, force=force, progress=seen, profile=profile, check=False)
        else:
            result = model._run(place, force, seen, profile, False, {}, "run", _pacer(model))
    cut_short = bool(result.run.get("routes")) and _interrupted(lambda: _compare_with_statics(model, result))
    if not as_json:  # the run is whole, and its summary waits for no figure
        _tell(result, quiet=quiet, profile=profile)
    silent = as_json or quiet
    cut_short = cut_short or _interrupted(lambda: _write_extras(model, result, csv=csv, report=report, silent=silent))
    if as_json:  # at the end: a figure that cannot be drawn is told instead, and standard output holds one document
        echo(json.dumps({**result.run, "directory": str(result.path)}, indent=2, default=str))
    if cut_short:
        echo(f"interrupted while figures were drawn; the results in {result.folder} are whole", err=True)
        raise typer.Exit(INTERRUPTED)
    raise typer.Exit(exit_code(result.run))


def _step_of_clock(real_time: str | None, settings: list[str]) -> dict[str, str]:
    """What `--real-time` sets."""
    if real_time is None:
        return {}
    from fairlead.errors import Location
    from fairlead.netlist.settings_file import Setting

    if any(text.partition("=")[0].strip() == "run.real_time" for text in settings):
        raise typer.BadParameter("--real-time gives the step, and so does --set run.real_time. Leave one of them out.")
    return {"run.real_time": Setting(with_space(real_time), Location("--real-time"))}


def _pacer(model: "Model") -> "Pacer":
    """Who keeps time with the clock."""
    from fairlead.pacing import Pacer

    step = model.netlist.run.real_time
    assert step is not None, "it was given"
    return Pacer(step)


def exit_code(outcome: dict[str, Any]) -> int:
    """The exit code that the contents of a `run.json` call for."""
    code = EXIT_CODES.get(outcome["status"], NUMERICAL_FAILURE)
    return LIMIT_BROKEN if code == 0 and outcome.get("limits_broken") else code


def _compare_with_statics(model: "Model", result: "Result") -> None:
    from fairlead.analysis.margins.kept import compare_with_statics

    compare_with_statics(model.flat, result)


def _interrupted(work: "Callable[[], None]") -> bool:
    """Do it; True when Ctrl-C ended it early."""
    try:
        work()
    except KeyboardInterrupt:
        return True
    return False


def _tell(result: "Result", *, quiet: bool, profile: bool) -> None:
    """The closing table, and what there is to remark."""
    if not quiet:
        _print_summary(result, profile=profile)
    _say_what_went_wrong(result.run)
    _say_what_is_kept(result, quiet)


def _write_extras(model: "Model", result: "Result", *, csv: bool, report: bool, silent: bool) -> None:
    """Make files from the results and name them: figures the netlist names, and CSV and a page when asked."""
    for file in _extras(model, result, csv=csv, report=report):
        if not silent:
            echo(f"wrote {file}")


def _extras(model: "Model", result: "Result", *, csv: bool, report: bool) -> "Iterator[pathlib.Path]":
    plots = model.netlist.record.plots
    if report:
        from fairlead.report import page

        yield page.write(result)
    if plots:
        from fairlead.report import figures

        yield from figures.draw(result, plots)
    if csv:
        result.to_csv(result.folder / "series.csv")
        yield result.folder / "series.csv"


def _print_summary(result: "Result", *, profile: bool) -> None:
    """The closing table, and the profile when asked."""
    from fairlead.cli.summary import print_summary

    print_summary(result.run, result.folder)
    if profile:
        echo(result.run.get("profile", "no profile was kept"))


def _say_what_is_kept(result: "Result", quiet: bool) -> None:
    """Results that are large, and earlier ones that this run was to replace."""
    from fairlead.results.events import EVENT_FILE
    from fairlead.results.kept import earlier
    from fairlead.results.store import SERIES_FILE

    size = sum(file.stat().st_size for name in (SERIES_FILE, EVENT_FILE) for file in result.folder.glob(name))
    if size > LARGE and not quiet:
        rows = f"{len(result.t)} rows of {len(result.signals)} signals"
        echo(f"note: the results take {size / 1e6:.0f} MB ({rows}). {_fewer(result)}", err=True)
    kept = earlier(result.folder)
    if kept is not None:
        echo(f"note: the run did not finish, so the results it was to replace are kept in {kept}.", err=True)


def _fewer(result: "Result") -> str:
    """How to have fewer rows or columns. A jump of a recorded value has two rows beside those of the grid."""
    every, jumps = result.run.get("record_every"), result.run.get("jumps", {})
    if every is None:
        return "Give record.every a time, or record fewer signals (record.signals)."
    if 4 * jumps.get("kept", 0) > len(result.t):
        most = ", ".join(jumps["most"])
        return f"Most rows are those of {jumps['kept']} jumps; leave out what jumps most ({most}) in record.signals."
    return f"Record fewer signals (record.signals) or less often (record.every is {every:g} s)."


def _say_what_went_wrong(outcome: dict[str, Any]) -> None:
    """On standard error, with -q too: what `check` would remark, why a run ended early, chatter, limits broken."""
    from fairlead.analysis.record.reported import told

    for kind, text in told(outcome):
        echo(f"{outcome['status'] if kind == 'end' else kind}: {text}", err=True)
