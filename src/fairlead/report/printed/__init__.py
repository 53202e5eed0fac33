"""Figures of a run for print: PNG, SVG or PDF.

    printed(result, what, file, ...)     one of `WHATS`, written to a file by the ending of its name
    paper                                Figures 3, 5 and 6 of the source paper

Each figure is a function that returns a matplotlib Figure; nothing here opens a window.
"""

from fairlead.report.printed.write import WHATS, printed, save

__all__ = ["WHATS", "printed", "save"]
