"""Ctrl-C, SIGTERM and SIGHUP while a run goes: all wait until what is at hand is written.

    with Interruption() as interruption, RunDirectory.create(...) as directory:
        interruption.between_blocks = True      from here on a signal waits
        interruption.due()                      raises KeyboardInterrupt if one came meanwhile: after each block, and
                                                when the files of the run are closed

After Ctrl-C the program goes on with what was computed. SIGTERM, by which schedulers and `kill` end a process, and
SIGHUP, by which a terminal that is closed does, end it still, when run.json says so and the files are closed.
"""

from __future__ import annotations

import os
import signal
import threading
from dataclasses import dataclass, field
from typing import Any

DEFAULTS: dict[signal.Signals, Any] = {
    signal.SIGINT: signal.default_int_handler,
    **{one: signal.SIG_DFL for one in signal.Signals if one.name in ("SIGTERM", "SIGHUP")},  # no SIGHUP on Windows
}


@dataclass
class Interruption:
    """Handlers of these signals, in force in a `with`; where others have set theirs, or in other threads, none.

    In the middle of a block a signal would lose the rows that the engine has handed over and the disk has not seen. It
    is a twentieth of a second until the block is written. Before the first block, when the engine may be compiling, and
    when a signal comes again, it works at once.
    """

    between_blocks: bool = False
    """True from the first block until the files are closed, so that a signal can wait for what is being written."""
    asked: bool = False
    ended_by: signal.Signals | None = None
    """The first signal that has come to end the process."""
    _taken: list[signal.Signals] = field(default_factory=list)

    def due(self) -> None:
        """Raise KeyboardInterrupt if a signal has come since."""
        if self.asked:
            self.asked = False
            raise KeyboardInterrupt

    def __enter__(self) -> Interruption:
        """Set the handlers."""
        if threading.current_thread() is threading.main_thread():
            for number, usual in DEFAULTS.items():
                if signal.getsignal(number) is usual:
                    signal.signal(number, self._ask)
                    self._taken.append(number)
        return self

    def __exit__(self, *_: object) -> None:
        """Set the usual handlers again, and end the process if that was asked for."""
        for number in self._taken:
            signal.signal(number, DEFAULTS[number])
        if self.ended_by is not None:
            os.kill(os.getpid(), self.ended_by)

    def _ask(self, number: int, frame: Any) -> None:
        if self.ended_by is None and number != signal.SIGINT:
            self.ended_by = signal.Signals(number)
        if not self.between_blocks or self.asked:
            raise KeyboardInterrupt
        self.asked = True
