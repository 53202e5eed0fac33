"""SymPy expressions printed the way an engineer writes them.

    formula(expression, names)      stiffness*(b.x - a.x - free_length)

SymPy's own printer sorts by the alphabet: `stiffness*(-a.x + b.x - free_length)`. Here what is positive comes
first, parameters before motions in a product and after them in a sum, powers with ^.
"""

from __future__ import annotations

from collections.abc import Mapping

import sympy

from fairlead.component.declaration import Declaration
from fairlead.component.keys import INPUT, OWN, PARAMETER, PORT, TIME, key

KINDS = (PARAMETER, INPUT, OWN, PORT, TIME)  # of symbols, in the order of factors of a product
SUM, PRODUCT, POWER, ATOM = range(4)  # how tightly a text holds together
Names = Mapping[str, str]  # key of a symbol -> what the author called it


def names_of(has: Declaration) -> dict[str, str]:
    """What the author of a class calls its symbols, by their keys: `a.angle` for `port:a:x`."""
    names = {"t": "t"}
    for port, declared in has.ports.items():
        domain = declared.domain
        for kind, (variable, _) in zip(("x", "v"), domain.across, strict=False):
            names[f"port:{port}:{kind}"] = f"{port}.{variable}"
        names[f"port:{port}:a"] = f"{port}.{domain.acceleration}"
        names[f"port:{port}:R"] = f"{port}.{domain.through[0]}"
    return names | {f"p:#{name}": name for name in has.discrete}


def formula(expression: sympy.Expr, names: Names) -> str:
    """An expression as text."""
    return _Writer(names).text(expression, SUM)


class _Writer:
    """Prints expressions recursively; `names` gives symbols whose name is not the last part of their key."""

    def __init__(self, names: Names) -> None:
        self._names = names

    def text(self, e: sympy.Expr, within: int) -> str:
        """An expression, in brackets when it holds together less tightly than what is `within`."""
        said, tightness = self._said(e)
        return said if tightness >= within else f"({said})"

    def _said(self, e: sympy.Expr) -> tuple[str, int]:
        e = _without_minus(e)
        if e.is_Symbol:
            return self._names.get(e.name) or key(e.name).number or e.name, ATOM
        if e.is_Add:
            return self._sum(e), SUM
        if e.is_Mul or (e.is_Rational and not e.is_Integer):
            return self._product(e), SUM if negative(e) else PRODUCT
        if e.is_Pow:
            return self._power(e)
        if e.is_Number:
            return self._number(e), ATOM if e >= 0 else SUM
        if isinstance(e, sympy.Abs):
            return f"|{self.text(e.args[0], SUM)}|", ATOM
        if e is sympy.pi:
            return "pi", ATOM
        word = {"Max": "max", "Min": "min"}.get(e.func.__name__, e.func.__name__)
        return f"{word}({', '.join(self.text(a, SUM) for a in e.args)})", ATOM

    def _number(self, e: sympy.Expr) -> str:
        return str(e) if e.is_Integer else f"{float(e):.12g}"

    def _sum(self, e: sympy.Expr) -> str:
        said = ""
        for term in sorted(map(_without_minus, e.args), key=self._place_in_sum):
            sign, text = "-" if negative(term) else "+", self.text(-term if negative(term) else term, PRODUCT)
            said += f" {sign} {text}" if said else f"{sign.strip('+')}{text}"
        return said

    def _place_in_sum(self, term: sympy.Expr) -> tuple[bool, bool, int, str]:
        """What is positive first; of single symbols motions before parameters."""
        single = term if term.is_Symbol else -term
        kind = -_kind(single) if single.is_Symbol else 0
        return negative(term), not single.is_Symbol, kind, str(term)

    def _product(self, e: sympy.Expr) -> str:
        if negative(e):
            return "-" + self.text(-e, PRODUCT)
        above, below = sympy.fraction(e, exact=True)
        text = "*".join(self.text(f, PRODUCT) for f in sorted(sympy.Mul.make_args(above), key=self._place_in_product))
        if below == 1:
            return text
        return f"{text}/{self.text(below, POWER)}"

    def _place_in_product(self, factor: sympy.Expr) -> tuple[int, str]:
        """Numbers, parameters, other symbols, sums, functions."""
        base = factor.args[0] if factor.is_Pow else factor
        if base.is_Number:
            return -1, ""
        if base.is_Symbol:
            return _kind(base), str(base)
        return len(KINDS) + (1 if base.is_Add else 2), str(base)

    def _power(self, e: sympy.Expr) -> tuple[str, int]:
        base, exponent = e.args
        if exponent == sympy.Rational(1, 2):
            return f"sqrt({self.text(base, SUM)})", ATOM
        if negative(exponent):
            return f"1/{self.text(sympy.Pow(base, -exponent), POWER)}", PRODUCT
        return f"{self.text(base, ATOM)}^{self.text(exponent, ATOM)}", POWER


def _kind(s: sympy.Symbol) -> int:
    kind = key(s.name).kind
    return KINDS.index(kind) if kind in KINDS else len(KINDS)


def _without_minus(term: sympy.Expr) -> sympy.Expr:
    """k*(y - x) for -k*(x - y)."""
    differences = [f for f in sympy.Mul.make_args(term) if f.is_Add and len(f.args) == 2 and any(map(negative, f.args))]
    if not negative(term) or len(differences) != 1:
        return term
    return sympy.Mul(*(-f for f in differences), *(f for f in sympy.Mul.make_args(-term) if f not in differences))


def negative(e: sympy.Expr) -> bool:
    """True for what is written with a minus in front."""
    return bool(e.as_coeff_Mul()[0] < 0)


def is_parameter(e: sympy.Expr) -> bool:
    """True for what does not change during a run: numbers and parameters only."""
    return all(key(s.name).kind == PARAMETER for s in e.free_symbols)
