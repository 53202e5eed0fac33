"""What a law is given when it is traced: parameters, tables and ports that hand out symbols."""

from __future__ import annotations

from typing import Any

import sympy

from fairlead.component.declare import Port
from fairlead.component.given import Choice, Count, Part, Table, Waveform
from fairlead.component.piecewise import DEGREE
from fairlead.component.replies import helper
from fairlead.component.symbols import TraceError, inverse_mass, sine, symbol
from fairlead.component.values import Variant
from fairlead.component.wave import SWING
from fairlead.errors import did_you_mean


class Recorder:
    """The symbolic `p`: hands out symbols by name and notes which tables are read where."""

    def __init__(self, variant: Variant, prefix: str, reads: dict[str, sympy.Expr]) -> None:
        self._variant, self._prefix, self._reads = variant, prefix, reads
        self.type = variant.type

    def __getattr__(self, name: str) -> Any:
        variant, has = self._variant, self._variant.type.declaration
        path = self._prefix + name
        words, parts = dict(variant.words), dict(variant.parts)
        if name in variant.absent:
            return None
        if name in words:
            return words[name]
        if name in parts:
            return Recorder(parts[name], path + ".", self._reads)
        declared = has.parameters.get(name)
        if isinstance(declared, Table | Waveform) or (name in has.derived and has.derived[name].wave):
            return TableReader(path, self._reads, dict(variant.swings).get(name, 0))
        if isinstance(declared, Choice | Count | Part):
            raise TraceError(f"{name!r} shapes the component and is not a number in its law")
        if declared is not None or name in has.derived:
            return symbol(f"p:{path}")
        function = getattr(variant.type, name, None)
        if callable(function):
            return helper(variant.type, name, function, self, traced=True)
        known = [*has.parameters, *has.derived]
        raise TraceError(f"{variant.type.__name__} has no parameter {name!r}; it has {known}")


class TableReader:
    """A table or a waveform inside a law: the polynomial of the interval in force."""

    def __init__(self, path: str, reads: dict[str, sympy.Expr], swings: int = 0) -> None:
        self._path, self._reads, self._swings = path, reads, swings

    def __call__(self, x: Any) -> sympy.Expr:
        """Value at x."""
        return self._derivative(x, 0)

    def rate(self, x: Any) -> sympy.Expr:
        """First derivative at x."""
        return self._derivative(x, 1)

    def second(self, x: Any) -> sympy.Expr:
        """Second derivative at x."""
        return self._derivative(x, 2)

    def _derivative(self, x: Any, order: int) -> sympy.Expr:
        at = sympy.Dummy("x")
        value = self._pieces(self._path, x, at)
        if x == symbol("t"):
            value += _sine(self._path, at)
            for path in (f"{self._path}.{SWING}{k}" for k in range(self._swings)):
                value += self._pieces(path, x, at) * _sine(path, at)
        return sympy.diff(value, at, order).subs(at, x)

    def _pieces(self, path: str, x: Any, at: sympy.Symbol) -> sympy.Expr:
        """The piece in force of a table, as a polynomial of `at`."""
        read = self._reads.setdefault(path, sympy.sympify(x))
        if read != x:
            raise TraceError(f"table {path!r} is read at two places in one zone: {read} and {x}")
        s = symbol(f"T:{path}:0")
        return sum(symbol(f"T:{path}:{k + 1}") * (at - s) ** k for k in range(DEGREE + 1))


def _sine(path: str, at: sympy.Symbol) -> sympy.Expr:
    """What a quantity in time swings with."""
    amplitude, omega, phase = (symbol(sine(path, part)) for part in ("amplitude", "omega", "phase"))
    return amplitude * sympy.sin(omega * at + phase)


class PortReader:
    """The symbolic view of a port: across variables, acceleration (guards, outputs), reaction, mass."""

    def __init__(self, name: str, declared: Port) -> None:
        domain = declared.domain
        self.port, self.such_as = name, f"{name}.{domain.across[0][0]}" if domain.across else name
        for (attribute, _), kind in zip(domain.across, ("x", "v"), strict=False):
            setattr(self, attribute, symbol(f"port:{name}:{kind}"))
        if domain.acceleration:
            setattr(self, domain.acceleration, symbol(f"port:{name}:a"))
        setattr(self, domain.through[0] or "_", symbol(f"port:{name}:R"))
        self.inverse_mass = symbol(inverse_mass(name))
        self._has = [*(one for one, _ in domain.across), domain.acceleration, domain.through[0]]

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        has = ", ".join(filter(None, self._has))
        raise TraceError(f"the port {self.port!r} has {has}, and no {name!r}. {did_you_mean(name, self._has)}".rstrip())
