"""`fairlead view`: a netlist beside the page of its run, in a browser on this machine."""

import signal
import sys
from typing import Annotated, Any

import typer

from fairlead.cli.options import AllowFmu, Libraries, Netlist, Quiet, Settings, Verbose, parse_settings
from fairlead.cli.terminal import echo


def view(
    netlist: Netlist,
    settings: Settings,
    libraries: Libraries,
    port: Annotated[int, typer.Option(metavar="NUMBER", min=0, max=65535, help="Default: any that is free.")] = 0,
    show: Annotated[bool, typer.Option("--open", help="Open the page in the browser of this machine.")] = False,
    allow_fmu: AllowFmu = False,
    quiet: Quiet = False,
    verbose: Verbose = False,
) -> None:
    """Edit a netlist beside the page of its run. Prints an address for a browser on this machine; Ctrl-C ends it.

    The netlist is checked as you type, and runs on Ctrl+Enter without being saved. Results go when this ends,
    unless you keep them.
    """
    from fairlead.view import View

    shown = View(netlist, parse_settings(settings), libraries, allow_fmu=allow_fmu, port=port)
    try:
        signal.signal(signal.SIGTERM, _end)
        echo(f"{shown.address}" if quiet else f"open {shown.address} in a browser; Ctrl-C ends it")
        sys.stdout.flush()
        if show:
            import webbrowser

            webbrowser.open(shown.address)
        shown.serve()
    except KeyboardInterrupt:
        pass  # it is meant to end so, or by SIGTERM
    finally:
        shown.close()


def _end(*_: Any) -> None:
    raise KeyboardInterrupt
