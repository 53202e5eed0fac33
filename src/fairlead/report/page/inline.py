"""The moving picture of a run in a cell of a notebook: the page of the run, of which one section shows."""

from __future__ import annotations

from dataclasses import dataclass
from html import escape
from typing import TYPE_CHECKING

from fairlead.report.page.write import page

if TYPE_CHECKING:
    from fairlead.results import Result

HEIGHT = 640
"""Of the frame [px]: player, picture and legend of a line at the width of a notebook."""


@dataclass(frozen=True)
class Animation:
    """A page in a frame of its own, so that neither its style nor its script meets those of the notebook."""

    text: str
    height: int = HEIGHT

    @classmethod
    def of(cls, result: Result, height: int = HEIGHT) -> Animation:
        """The moving picture of a run, in a frame so many px high."""
        return cls(page([result], only="moving"), height)

    def __repr__(self) -> str:
        return f"Animation of {len(self.text) / 1e6:.1f} MB; a notebook plays it"

    def _repr_html_(self) -> str:
        frame = f'width="100%" height="{self.height}" style="border:0" sandbox="allow-scripts"'
        return f'<iframe title="Moving picture" {frame} srcdoc="{escape(self.text)}"></iframe>'
