"""`fairlead doctor`: look at the installation, try a tiny run, and say what to mend."""

import json

import typer

from fairlead.cli.exit_codes import MODEL_ERROR, OK
from fairlead.cli.options import AsJson, Quiet, Verbose
from fairlead.cli.terminal import echo


def doctor(as_json: AsJson = False, quiet: Quiet = False, verbose: Verbose = False) -> None:
    """Look at the installation, the kernel cache and a tiny run; say what to mend."""
    from fairlead.cli.health import examine

    findings = []
    for finding in examine():
        findings.append(finding)
        if not as_json and not (quiet and finding.well):
            echo(str(finding))
    well = all(finding.well for finding in findings)
    if as_json:
        echo(json.dumps({"ok": well, "findings": [finding.record() for finding in findings]}, indent=2))
    elif not quiet:
        echo("All is well." if well else "Mend what is marked with x; the rest is well.")
    raise typer.Exit(OK if well else MODEL_ERROR)
