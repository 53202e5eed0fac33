"""A netlist beside the page of its run, in a browser on this machine: `fairlead view MODEL`.

Given a netlist, and a person who edits it.
Does  `draft` keeps the text and the file apart until it is saved; `completion` says what may stand at the cursor;
      `work` checks and runs in processes of their own, which `workers` starts and stops; `server` answers the page, to
      nobody but who has the address with its token; `parts/` holds the page.
Says  the messages of `fairlead check` at their lines, and the page of `fairlead report`.
"""

from fairlead.view.server import View

__all__ = ["View"]
