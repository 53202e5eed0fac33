"""What a run leaves behind: the directory it writes, or what it keeps in memory, and the result read from it."""

from fairlead.results.events import Event
from fairlead.results.in_memory import MemoryRun
from fairlead.results.named import UnknownSignalError
from fairlead.results.recorder import RunDirectory
from fairlead.results.signal import Signal, matching
from fairlead.results.sink import Sink
from fairlead.results.trajectory import Result

__all__ = ["Event", "MemoryRun", "Result", "RunDirectory", "Signal", "Sink", "UnknownSignalError", "matching"]
