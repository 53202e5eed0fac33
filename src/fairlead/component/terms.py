"""A law's answer by name, and what of it is missing or unasked."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from fairlead.component.class_checks import DeclarationError
from fairlead.component.declaration import Declaration
from fairlead.component.declare import Law
from fairlead.component.holding import HoldPosition
from fairlead.errors import did_you_mean

if TYPE_CHECKING:
    from fairlead.component.base import Declared

LEDGER = ("dissipated", "supplied", "stored")
"""What a law may give beside what its declarations ask for: power lost and fed in, and energy kept."""


def terms_of(cls: type[Declared], said: Any) -> dict[str, Any]:
    """A law's answer by name; a bare value or tuple gives the flows of the ports in their order."""
    if isinstance(said, Law):
        terms = dict(said.terms)
    else:
        flows = said if isinstance(said, tuple) else (said,)
        ports = list(cls.declaration.ports)
        if said is None or isinstance(said, list | Mapping | str):
            gave = "None" if said is None else f"a {type(said).__name__}"
            by_name = ", ".join(f"{port}=..." for port in ports)
            what = f"the law returns {gave}; it returns what {', '.join(ports) or 'its ports'} take in"
            raise DeclarationError(f"{what}, in a tuple or as Law({by_name})")
        if len(flows) != len(ports):
            raise DeclarationError(f"the law returns {len(flows)} flows for {len(ports)} ports {ports}")
        terms = dict(zip(ports, flows, strict=True))
    has = cls.declaration
    known = {*has.ports, *has.states, *has.unknowns, *has.outputs, *LEDGER}
    unknown = set(terms) - known
    missing = {*has.ports, *has.states, *has.unknowns} - set(terms) - _passive(cls)
    if any(isinstance(term, HoldPosition) for term in terms.values()):  # it puts its force on its ports itself
        missing -= set(has.ports)
    if unknown:
        near = " ".join(filter(None, (did_you_mean(name, known) for name in sorted(unknown))))
        left = f" and leaves out {sorted(missing)}" if missing else ""
        raise DeclarationError(f"the law gives {sorted(unknown)} unasked{left}. {near}".rstrip())
    if missing:
        raise DeclarationError(f"the law leaves out {', '.join(_wanted(has, name) for name in sorted(missing))}")
    return terms


def _wanted(has: Declaration, name: str) -> str:
    """What a law has to give for a name, as it is written."""
    if name in has.states:
        return f"the rate of the state {name}: Law(..., {name}=...) in {has.states[name].unit}/s"
    if name in has.unknowns:
        return f"what must be zero for the unknown {name}: Law(..., {name}=...)"
    return f"what the port {name} takes in: Law(..., {name}=...)"


def _passive(cls: type[Declared]) -> set[str]:
    """Ports whose flow is settled elsewhere: prescribed motion takes whatever comes, ties pass it on.

    A controller in plain Python only looks at its ports.
    """
    answers, has = cls.answers, cls.declaration
    settled = set(answers.prescribes()) if answers.prescribes is not None else set()
    settled |= {answers.bears} - {""}
    return settled | (set(has.ports) if answers.ties is not None or has.python else set())
