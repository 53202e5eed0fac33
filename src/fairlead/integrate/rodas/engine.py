"""The engine `rodas`, as Python knows it."""

from __future__ import annotations

from fairlead.integrate.engine import Engine

RODAS = Engine("rodas", "fairlead.integrate.rodas.rosenbrock", ("rodas",), works_on_parts=True, keeps_relations=True)
