"""Progress with an estimate of the time left: on standard error, and only on a terminal."""

import contextlib
import sys
from collections.abc import Callable, Iterator
from typing import Any

from fairlead.cli.terminal import console
from fairlead.errors import printable

ReportProgress = Callable[[float, float, Any], None]
"""Called with (fraction done, simulated time in s, counters)."""


@contextlib.contextmanager
def progress_bar(label: str, quiet: bool) -> Iterator[ReportProgress | None]:
    """Give the callback of a live bar; None when nobody watches (a file, a pipe, -q)."""
    if quiet or not sys.stderr.isatty():
        yield None
        return
    from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeRemainingColumn

    columns = (
        TextColumn("{task.description}", markup=False),
        BarColumn(),
        TaskProgressColumn(),
        TimeRemainingColumn(),
        TextColumn("t = {task.fields[time]:.4g} s"),
    )
    with Progress(*columns, console=console(stderr=True), transient=True) as bar:
        # Without a total the bar pulses: before the first step there is nothing to extrapolate from.
        label = printable(label)
        task = bar.add_task(f"{label}: preparing, a first run compiles", total=None, time=0.0)

        def report(fraction: float, time: float, counters: Any) -> None:
            bar.update(task, description=label, total=1.0, completed=fraction, time=time)

        yield report
