"""Results that cannot be read: which file, what is wrong in it, and a way out.

    with reading(path / "series.nc"):        whatever a damaged file makes a reader raise becomes DamagedResultsError
        ...
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from fairlead.errors import FairleadError, shown

WAY_OUT = "Take the file from a copy if there is one, or run the netlist again."


class DamagedResultsError(FairleadError):
    """A file of a run directory that is not what a run has written."""

    exit_code = 1

    def __init__(self, file: Path, what: str, way_out: str = WAY_OUT) -> None:
        self.file = file
        super().__init__(f"{file}: {what}\n    {way_out}")


@contextmanager
def reading(file: Path) -> Iterator[None]:
    """Tell what goes wrong with a file. Raises DamagedResultsError."""
    try:
        yield
    except FairleadError:
        raise
    except FileNotFoundError as error:
        raise DamagedResultsError(file, "the file is missing.") from error
    except PermissionError as error:
        raise DamagedResultsError(file, "the file may not be read.", "Ask its owner for the right to.") from error
    except MemoryError as error:
        raise DamagedResultsError(file, "what it says it holds does not fit into memory.") from error
    except Exception as error:  # HDF5 and decoders raise what they like for damaged bytes
        why = shown(str(error) or type(error).__name__)
        raise DamagedResultsError(file, f"the file is damaged ({why}).") from error
