"""One self-contained page about one run or several: what happened, moving, to be mailed or archived.

    write([result, ...])     makes report.html; nothing in it is loaded from elsewhere, and no network is needed

The rooms: `packing` makes signals small. `signals`, `zones`, `line` and `mechanism` say what there is to draw.
`verdict`, `slow`, `ledger` and `scene` put it into words. `write` joins them. `parts/` holds the template, the style
and the script of the page; the plots in it are drawn by the JavaScript that the installed package bokeh ships.
"""

from fairlead.report.page.write import PAGE_FILE, write

__all__ = ["PAGE_FILE", "write"]
