"""Ctrl-C and SIGTERM while a run goes: both wait until what is at hand is written.

    with Interruption() as interruption, RunDirectory.create(...) as directory:
        interruption.between_blocks = True      from here on a signal waits
        interruption.due()                      raises KeyboardInterrupt if one came meanwhile

After Ctrl-C the program goes on with what was computed. SIGTERM, by which schedulers and `kill` end a process, ends it
still, when run.json says so and the files are closed.
"""

from __future__ import annotations

import os
import signal
import threading
from dataclasses import dataclass, field
from typing import Any

DEFAULTS: dict[signal.Signals, Any] = {signal.SIGINT: signal.default_int_handler, signal.SIGTERM: signal.SIG_DFL}


@dataclass
class Interruption:
    """Handlers of both signals, in force in a `with`; where others have set theirs, or in other threads, none.

    In the middle of a block a signal would lose the rows that the engine has handed over and the disk has not seen. It
    is a twentieth of a second until the block is written. Before the first block, when the engine may be compiling, and
    when a signal comes again, it works at once.
    """

    between_blocks: bool = False
    """True while the engine hands over blocks, so that a signal can wait for one."""
    asked: bool = False
    terminated: bool = False
    """SIGTERM has come."""
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
        if self.terminated:
            os.kill(os.getpid(), signal.SIGTERM)

    def _ask(self, number: int, frame: Any) -> None:
        self.terminated = self.terminated or number == signal.SIGTERM
        if not self.between_blocks or self.asked:
            raise KeyboardInterrupt
        self.asked = True
