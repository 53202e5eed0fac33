"""`fairlead sweep`: many cases of a model by several processes, in one table that goes on where it stopped."""

import contextlib
import json
import pathlib
import signal
import sys
from collections.abc import Iterator
from typing import TYPE_CHECKING, Annotated, Any

import typer

import fairlead.cli.completion as completion
from fairlead.cli.exit_codes import INTERRUPTED, NUMERICAL_FAILURE, OK
from fairlead.cli.options import AllowFmu, AsJson, Libraries, Quiet, Settings, Verbose, parse_settings
from fairlead.cli.places import place, refuse_place
from fairlead.cli.terminal import echo
from fairlead.errors import UsageError

if TYPE_CHECKING:
    from fairlead.cases.cases import Cases
    from fairlead.studies.sweeps.plan import Plan
    from fairlead.studies.sweeps.sweep import Standing, Watch

SAMPLES = {"lhs": "latin_hypercube", "sobol": "sobol", "monte_carlo": "monte_carlo", "saltelli": "saltelli",
           "morris": "morris"}  # fmt: skip
LINES = 30.0
"""Seconds between two lines of progress where nobody watches."""
Many = list[str] | None


def _count(text: str) -> Any:
    return typer.Option(metavar="N", min=1, help=text)


def sweep(
    subject: Annotated[
        str, typer.Argument(help="A netlist, a bundled model, or a sweep file.", autocompletion=completion.netlists)
    ],
    settings: Settings,
    libraries: Libraries,
    grid: Annotated[
        Many,
        typer.Option(metavar="NAME=VALUES", help="Values: 0.2:0.7:0.05, a,b,c, lin(a, b, n). Repeatable: all pairs."),
    ] = None,
    cases: Annotated[pathlib.Path | None, typer.Option(metavar="FILE.csv", help="Cases, one in each line.")] = None,
    over: Annotated[
        Many, typer.Option(metavar="NAME=LAW", help="Distribution for a sample: uniform(0.2, 0.7). Repeatable.")
    ] = None,
    lhs: Annotated[int | None, _count("A Latin hypercube of so many cases.")] = None,
    sobol: Annotated[int | None, _count("So many points of Sobol's sequence; a power of two is best.")] = None,
    monte_carlo: Annotated[int | None, _count("So many independent cases.")] = None,
    saltelli: Annotated[int | None, _count("Points for Sobol's indices: N (parameters + 2) cases.")] = None,
    morris: Annotated[int | None, _count("Trajectories for Morris' indices: N (parameters + 1) cases.")] = None,
    seed: Annotated[int, typer.Option(min=0, help="Of the sample.")] = 0,
    correlate: Annotated[
        Many, typer.Option(metavar="A~B=R", help="Rank correlation of two parameters, with --monte-carlo. Repeatable.")
    ] = None,
    figure: Annotated[
        Many,
        typer.Option(metavar="NAME=FIGURE", help="What to tell of each case: peak(block.x), file.py:f. Repeatable."),
    ] = None,
    max_steps: Annotated[int | None, typer.Option(min=1, help="Steps after which a case ends.")] = None,
    processes: Annotated[
        int | None, typer.Option(min=0, help="Processes; 0: this one. Default: as many as cores.")
    ] = None,
    cluster: Annotated[
        str,
        typer.Option(metavar="ADDRESS", help="A scheduler of dask: tcp://host:8786, or its file."),
    ] = "",
    keep: Annotated[
        Many,
        typer.Option(metavar="WHICH", help="Full results of cases: 17, failed, broken, highest:FIGURE. Repeatable."),
    ] = None,
    out: Annotated[
        pathlib.Path | None,
        typer.Option("--out", "-o", metavar="DIR", help="The table goes here. Default: results/NAME-sweep."),
    ] = None,
    csv: Annotated[
        pathlib.Path | None, typer.Option(metavar="FILE", help="Write the rows here as well, for a spreadsheet.")
    ] = None,
    force: Annotated[bool, typer.Option("--force", help="Replace the table of another sweep.")] = False,
    allow_fmu: AllowFmu = False,
    as_json: AsJson = False,
    quiet: Quiet = False,
    verbose: Verbose = False,
) -> None:
    """Run many cases of a model. Typed again after Ctrl-C or a kill, it goes on where it stopped."""
    import fairlead
    from fairlead.cases.cases import Cases
    from fairlead.studies.sweeps import chosen
    from fairlead.studies.sweeps.plan import is_sweep_file, plan_of_options, read_plan
    from fairlead.studies.sweeps.sweep import sweep as run_all

    refuse_place("--out", out, folder=True)
    refuse_place("--csv", csv)
    counts = {"lhs": lhs, "sobol": sobol, "monte_carlo": monte_carlo, "saltelli": saltelli, "morris": morris}
    sample = _one_sample(counts)
    if is_sweep_file(subject):
        _refuse_options(subject, grid, cases, over, sample, figure, settings, libraries)
        plan = read_plan(subject)
    else:
        plan = plan_of_options(
            subject, parse_settings(settings), libraries, grid=grid or (), cases=cases, over=over or (), sample=sample,
            seed=seed, correlate=correlate or (), figures=figure or (), max_steps=max_steps, keep=keep or (),
        )  # fmt: skip
    model = fairlead.load(plan.model, set=plan.settings, libraries=plan.libraries, allow_fmu=allow_fmu)
    job = Cases(model, plan.figures, max_steps=plan.max_steps or max_steps)
    words = (*plan.keep, *(keep or ())) if plan.keep else tuple(keep or ())
    chosen.refuse(words, list(job.units), plan.design.count)
    folder = out or pathlib.Path("results") / f"{model.netlist.name}-sweep"
    with _ends_as_ctrl_c(), _watching(job.name, quiet or as_json) as watch:
        try:
            table, standing = run_all(job, plan.design, folder, computers=_computers(cluster), processes=processes,
                                      force=force, watch=watch)  # fmt: skip
        except KeyboardInterrupt:
            echo(f"interrupted; what was computed is in {folder}. Type the same again to go on.", err=True)
            raise typer.Exit(INTERRUPTED) from None
    frame = table.frame()
    kept = _keep(job, plan, words, frame, folder)
    if csv is not None:
        place(csv, frame.to_csv(index=False, lineterminator="\n"))
    record = _record(frame, plan, standing, folder, kept, limited=job.limited)
    record |= {"others": table.others, "csv": None if csv is None else str(csv)}
    _print(record, standing, as_json=as_json, quiet=quiet)
    raise typer.Exit(_exit_code(record))


def _refuse_options(subject: str, *options: Any) -> None:
    """Refuse options beside a sweep file, which says all of this itself."""
    if any(options):
        raise UsageError(f"{subject} says what to sweep; write it there and not as options.")


def _exit_code(record: dict[str, Any]) -> int:
    """A sweep in which any case finished is a sweep; its table says which did not."""
    return OK if record["cases"].get("finished") else NUMERICAL_FAILURE


def _one_sample(counts: dict[str, int | None]) -> tuple[str, int] | None:
    given = [(SAMPLES[name], count) for name, count in counts.items() if count is not None]
    if len(given) > 1:
        raise UsageError("--lhs, --sobol, --monte-carlo, --saltelli and --morris exclude each other.")
    return given[0] if given else None


def _computers(cluster: str) -> Any:
    if not cluster:
        return None
    from fairlead.studies.sweeps.cluster import Cluster

    return lambda job: Cluster(job, cluster)


@contextlib.contextmanager
def _ends_as_ctrl_c() -> Iterator[None]:
    """SIGTERM, by which schedulers end a process, is as good as Ctrl-C: the table is written first."""

    def interrupt(*_: object) -> None:
        raise KeyboardInterrupt

    before = signal.signal(signal.SIGTERM, interrupt)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, before)


@contextlib.contextmanager
def _watching(name: str, quiet: bool) -> "Iterator[Watch | None]":
    """A bar where somebody watches, a line now and then where it goes to a file."""
    if quiet:
        yield None
        return
    if not sys.stderr.isatty():
        yield _lines()
        return
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn

    from fairlead.cli.terminal import console

    columns = (
        TextColumn("{task.description}", markup=False),
        BarColumn(),
        MofNCompleteColumn(),
        TextColumn("{task.fields[told]}"),
    )
    with Progress(*columns, console=console(stderr=True), transient=True) as bar:
        task = bar.add_task(name, total=None, told="starting processes")

        def watch(now: "Standing") -> None:
            bar.update(task, total=now.total, completed=now.reused + now.done, told=_told(now))

        yield watch


def _lines() -> "Watch":
    last = [0.0]

    def watch(now: "Standing") -> None:
        if now.seconds - last[0] >= LINES:
            last[0] = now.seconds
            echo(f"{now.reused + now.done} of {now.total} cases, {_told(now)}", err=True)

    return watch


def _told(now: "Standing") -> str:
    failed = f", {now.failed} did not finish" if now.failed else ""
    return f"{now.rate:.3g} cases per second, {_duration(now.left)} to go{failed}"


def _duration(seconds: float) -> str:
    if seconds < 90:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 5400 else f"{seconds / 3600:.1f} h"


def _keep(job: "Cases", plan: "Plan", words: tuple[str, ...], frame: Any, folder: pathlib.Path) -> list[pathlib.Path]:
    """Run the cases that are to be kept once more, with all that the netlist records."""
    import itertools

    from fairlead.studies.sweeps.chosen import chosen

    made = []
    for number in chosen(words, frame):
        values = next(itertools.islice(plan.design.cases(), number, None))
        place = folder / "kept" / f"case_{number}"
        if frame["status"][frame["case"] == number].iloc[0] not in ("refused",):
            job.result(values, place)
            made.append(place)
    return made


def _record(
    frame: Any, plan: "Plan", standing: "Standing", folder: pathlib.Path, kept: list[pathlib.Path], *, limited: bool
) -> dict[str, Any]:
    from fairlead.studies.sweeps.breach import SAMPLES as SHARES
    from fairlead.studies.sweeps.breach import breach
    from fairlead.studies.sweeps.table import FILE

    sentences = frame[frame["status"] != "finished"].groupby(["status", "sentence"]).size().nlargest(5)
    sample = plan.design.sample
    shares = sample is not None and sample.kind in SHARES and limited
    likely = breach(frame) if shares else None
    return {
        "cases": {str(name): int(count) for name, count in frame["status"].value_counts().items()},
        "reused": standing.reused, "twice": standing.twice, "computed": standing.done,
        "seconds": round(standing.seconds, 3),
        "table": str(folder / FILE), "kept": [str(one) for one in kept],
        "reasons": [{"status": s, "sentence": t, "cases": int(n)} for (s, t), n in sentences.items()],
        "broken": int((frame["limits_broken"] > 0).sum()) if limited else None,
        "breach": None if likely is None else {**vars(likely), "sentence": str(likely)},
    }  # fmt: skip


def _print(record: dict[str, Any], standing: "Standing", *, as_json: bool, quiet: bool) -> None:
    if as_json:
        echo(json.dumps(record, indent=2))
    elif not quiet:
        _print_sentences(record, standing)


def _print_sentences(record: dict[str, Any], standing: "Standing") -> None:
    counts = ", ".join(f"{count} {name}" for name, count in record["cases"].items())
    there, twice = record["reused"] - record["twice"], record["twice"]
    reused = f", {there} were there already" if there else ""
    reused += f", {twice} stand twice in the design" if twice else ""
    took = f"{_duration(standing.seconds)} ({standing.rate:.3g} cases per second)" if standing.done else "no time"
    echo(f"{counts}; {record['computed']} computed in {took}{reused}")
    for one in record["reasons"]:
        echo(f"{one['cases']} {one['status']}: {one['sentence'][:300]}")
    if record["breach"] is not None:
        echo(record["breach"]["sentence"])
    elif record["broken"]:
        echo(f"limits are broken in {record['broken']} of {sum(record['cases'].values())} cases: see limits_broken")
    for folder in record["kept"]:
        echo(f"kept {folder}")
    others = record["others"]
    kept = f"; rows of other designs in it: {others} (case -1), which count nowhere" if others else ""
    echo(f"wrote {record['table']}{kept}")
    if record["csv"]:
        echo(f"wrote {record['csv']}")
