"""`fairlead check`: every mistake of a netlist at once, without running it."""

import json

from fairlead.cli.options import AsJson, Libraries, Netlist, Quiet, Settings, Verbose, parse_settings
from fairlead.cli.terminal import echo


def check(
    netlist: Netlist,
    settings: Settings,
    libraries: Libraries,
    as_json: AsJson = False,
    quiet: Quiet = False,
    verbose: Verbose = False,
) -> None:
    """Find every mistake of a netlist, with file, line and a way out."""
    import fairlead
    from fairlead.cli.verb import fault_record

    remarks = fairlead.load(netlist, set=parse_settings(settings), libraries=libraries).check()
    if as_json:
        warnings = [fault_record(remark) for remark in remarks]
        echo(json.dumps({"ok": True, "faults": [], "warnings": warnings}, indent=2))
        return
    for remark in remarks:
        echo(f"warning: {remark}", err=True)
    if not quiet:
        echo(f"{netlist}: no mistakes found{f', {len(remarks)} warnings' if remarks else ''}.")
