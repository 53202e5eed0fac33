"""Mistakes that are not answered well yet, by name, with what is wrong with the answer. What is mended leaves."""

_NETLIST: dict[str, str] = {}

_COMMAND: dict[str, str] = {}

_COMPONENT: dict[str, str] = {}

_PYTHON: dict[str, str] = {}

KNOWN = {
    f"{kind}: {name}": reason
    for kind, of_kind in (("netlist", _NETLIST), ("command", _COMMAND), ("component", _COMPONENT), ("python", _PYTHON))
    for name, reason in of_kind.items()
}
