"""What a run leaves behind: the directory it writes and the result read back from it."""

from fairlead.results.events import Event
from fairlead.results.recorder import RunDirectory
from fairlead.results.signal import Signal, matching
from fairlead.results.trajectory import Result, UnknownSignalError

__all__ = ["Event", "Result", "RunDirectory", "Signal", "UnknownSignalError", "matching"]
