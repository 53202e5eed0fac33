"""`fairlead schema`: the JSON Schema of netlists, for completion and checks in an editor."""

import json

from fairlead.cli.options import Libraries, Quiet, Verbose
from fairlead.cli.terminal import echo


def schema(
    libraries: Libraries,
    quiet: Quiet = False,
    verbose: Verbose = False,
) -> None:
    """Print the JSON Schema (draft-07) of netlists, made from the component classes.

    An editor with a YAML language server uses it after this first line of a netlist:
    # yaml-language-server: $schema=fairlead.schema.json
    """
    import fairlead

    echo(json.dumps(fairlead.json_schema(libraries), indent=2))
