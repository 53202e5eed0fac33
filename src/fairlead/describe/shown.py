"""How the page of a type shows itself: as text it is a string, in a notebook its lines stay lines."""

from __future__ import annotations

from html import escape


class Page(str):
    """Text with lines that a notebook keeps."""

    __slots__ = ()

    def _repr_html_(self) -> str:
        return f'<pre style="text-align:left">{escape(self)}</pre>'
