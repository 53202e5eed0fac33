"""The cases by theme; importing this package fills the table."""

from tests.hard.cases import accuracy, simultaneous, stiction

__all__ = ["accuracy", "simultaneous", "stiction"]
