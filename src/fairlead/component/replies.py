"""What the methods of a class give back, held against what was asked for.

    mine.py:12: Bob.inertia(p) gives 'heavy'.
        It gives a map from ports to numbers [kg, kg*m^2, ...], such as {"flange": p.mass}.

Methods of `Answers` are wrapped when a class is created (`held_to`). A method that fails is told with the line at
which it does. The bundled library is not wrapped: what fails there is a mistake in fairlead, and is to look like one.
"""

from __future__ import annotations

import functools
import inspect
import math
import traceback
from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from numbers import Number, Real
from typing import Any

from fairlead.component.answers import Answers
from fairlead.component.declaration import Declaration
from fairlead.errors import Fault, Location, ModelError, did_you_mean, listing, shown

BUNDLED = "fairlead."
"""Where the modules of the library lie."""


EXPANSION = "It gives an Expansion(children, connections, ports)."


class AnswerError(ModelError):
    """A method of a user's class that fails, or gives what it should not: its file and line, and what it should give.

    `faults` say nothing of the netlist yet; who asked adds that (`at`).
    """

    def at(self, where: Location, path: str) -> list[Fault]:
        """The same, of a component of a netlist."""
        return [Fault(where, f"{path}: {fault.what}", fault.way_out) for fault in self.faults]


class Wrong(Exception):
    """What is wrong with a reply, as a sentence without its subject: "has no port 'c'. ..."."""


def is_bundled(kind: type) -> bool:
    """Whether a class is of fairlead's own library."""
    return kind.__module__.startswith(BUNDLED)


def held_to(answers: Answers, kind: Any) -> Answers:
    """The answers of a class, with methods that look at what they give back."""
    if is_bundled(kind):
        return answers
    methods = {name: getattr(answers, name) for name in REPLIES}
    held: dict[str, Any] = {name: _asking(kind, name, method) for name, method in methods.items() if method is not None}
    return replace(answers, **held)


def asked(kind: Any, name: str, function: Callable[..., Any], *given: Any) -> Any:
    """What a function of a user's class gives. Raises AnswerError at the author's line when it fails."""
    try:
        return function(*given)
    except AnswerError:
        raise
    except TypeError as error:
        if type(error).__name__ == "TraceError":  # it has its place already
            raise
        raise _failing(error, kind, name, function) from error
    except ModelError as error:  # of `scene.make`, which knows what is wrong but not who wanted it
        place = f"{_line(error, function)}: {kind.__name__}.{name}: "
        raise AnswerError(
            fault if fault.where and fault.where.line else Fault(None, place + fault.what, fault.way_out)
            for fault in error.faults
        ) from error
    except Exception as error:
        raise _failing(error, kind, name, function) from error


def _failing(error: Exception, kind: Any, name: str, function: Callable[..., Any]) -> AnswerError:
    said = f"{_line(error, function)}: {kind.__name__}.{name} fails: {type(error).__name__}: {error}".rstrip(": .")
    way_out = "" if isinstance(error, AttributeError) else REPLIES.get(name, ("", None))[0]
    return AnswerError([Fault(None, f"{said}.", way_out)])


def helper(
    kind: Any, name: str, function: Callable[..., Any], p: Any, *, traced: bool = False
) -> Callable[..., Any]:
    """A method of a part, such as the `coefficient` of a curve, that looks at what it gives if its family says what.

    `p` is the symbolic or the plain one; of one that is `traced` the tracer tells what fails. Numbers, complex ones and
    expressions are numbers here.
    """
    wanted = getattr(kind, "gives", {}).get(name)
    if wanted is None or is_bundled(kind):
        return functools.partial(function, p)

    def call(*given: Any) -> Any:
        said = function(p, *given) if traced else asked(kind, name, function, p, *given)
        number = isinstance(said, Number) and not isinstance(said, bool)
        if not (number or hasattr(said, "free_symbols") or (said is None and wanted.endswith("None"))):
            what = f"{place_of(function)}: {kind.__name__}.{name} gives {_said(said)}."
            raise AnswerError([Fault(None, what, f"It gives {wanted}.")])
        return said

    return call


def _asking(kind: Any, name: str, method: Callable[..., Any]) -> Callable[..., Any]:
    wanted, look = REPLIES[name]
    arguments = ", ".join(inspect.signature(method).parameters)

    @functools.wraps(method)
    def call(*given: Any) -> Any:
        said = asked(kind, name, _all_of(method), *given)
        try:
            return look(said, kind.declaration)
        except Wrong as error:
            what = f"{place_of(method)}: {kind.__name__}.{name}({arguments}) {error}"
            raise AnswerError([Fault(None, what, wanted)]) from None

    return call


def _all_of(method: Callable[..., Any]) -> Callable[..., Any]:
    """The method, with a generator run to its end, so that it fails here and not later."""

    @functools.wraps(method)
    def call(*given: Any) -> Any:
        said = method(*given)
        return tuple(said) if inspect.isgenerator(said) else said

    return call


def place_of(function: Callable[..., Any]) -> str:
    """file:line of a function."""
    code = inspect.unwrap(function).__code__
    return f"{code.co_filename}:{code.co_firstlineno}"


def _line(error: BaseException, function: Callable[..., Any]) -> str:
    """file:line at which a function fails: the deepest frame in its own file."""
    code = inspect.unwrap(function).__code__
    frames = [f for f in traceback.extract_tb(error.__traceback__) if f.filename == code.co_filename]
    return f"{code.co_filename}:{frames[-1].lineno if frames else code.co_firstlineno}"


def _gives(value: Any) -> Wrong:
    return Wrong(f"gives {_said(value)}.")


def _said(value: Any) -> str:
    """A value of Python as it may stand in a message."""
    if isinstance(value, str):
        return repr(shown(value))
    text = repr(value)
    return text if len(text) <= 60 else f"{shown(value)} of type {type(value).__name__}"


def _is_number(value: Any) -> bool:
    return isinstance(value, Real) and not isinstance(value, bool) and not math.isnan(float(value))


def _is_finite(value: Any) -> bool:
    return _is_number(value) and math.isfinite(float(value))


def _map(value: Any, ports: Iterable[str]) -> Mapping[str, Any]:
    """A map whose names are ports."""
    if not isinstance(value, Mapping):
        raise _gives(value)
    for name in value:
        if name not in ports:
            near = did_you_mean(name, ports) if isinstance(name, str) else ""
            have = f"the ports are {listing(ports)}" if ports else "there are no ports"
            raise Wrong(f"names the port {name!r}; {have}. {near}".rstrip())
    return value


def _inertia(value: Any, has: Declaration) -> Any:
    for name, amount in _map(value, has.ports).items():
        if not _is_finite(amount) or amount < 0:
            raise Wrong(f"gives {_said(amount)} for {name}, which is no amount of inertia.")
    return value


def _start(value: Any, has: Declaration) -> Any:
    for name, given in _map(value, has.ports).items():
        if has.ports[name].domain.mechanical:
            fits = given is None or (isinstance(given, tuple) and len(given) == 2)
            wanted, parts = "the pair (position, speed)", given if fits and given is not None else ()
        else:
            fits, wanted, parts = True, "a number", (given,)
        if not fits or not all(part is None or _is_finite(part) for part in parts):
            raise Wrong(f"gives {_said(given)} for {name}; that is {wanted}.")
    return value


def _prescribes(value: Any, has: Declaration) -> Any:
    for name, outputs in _map(value, has.ports).items():
        count = 3 if has.ports[name].domain.mechanical else 1
        if outputs is None:
            continue
        if not isinstance(outputs, tuple) or len(outputs) != count:
            raise Wrong(f"gives {_said(outputs)} for {name}; that is {count} output{'s' if count > 1 else ''} or None.")
        for output in outputs:
            if output not in has.outputs:
                near = did_you_mean(str(output), has.outputs)
                have = f"the outputs are {listing(has.outputs)}" if has.outputs else "there are no outputs"
                raise Wrong(f"names the output {output!r}; {have}. {near}".rstrip())
    return value


def _ties(value: Any, has: Declaration) -> Any:
    for tie in _rows(value):
        if not isinstance(tie, tuple) or len(tie) != 4:
            raise Wrong(f"gives {_said(tie)}, which is no tie.")
        one, other, ratio, offset = tie
        _map({one: 0, other: 0}, has.ports)
        if one == other:
            raise Wrong(f"ties {one} to itself.")
        if not _is_finite(ratio) or ratio == 0 or not _is_finite(offset):
            raise Wrong(f"gives the ratio {_said(ratio)} and the offset {_said(offset)} for {one} and {other}.")
    return value


def _rows(value: Any) -> Any:
    if not isinstance(value, tuple | list):
        raise _gives(value)
    return value


def _check(value: Any, has: Declaration) -> Any:
    for row in _rows(() if value is None else value):
        if not isinstance(row, tuple) or len(row) != 3 or not all(isinstance(word, str) for word in row):
            raise _gives(row)
        _known(row[0].partition("[")[0].partition(".")[0], has)
    return () if value is None else value


def _known(name: str, has: Declaration) -> None:
    known = {*has.parameters, *has.effects, ""}
    if name not in known:
        near = did_you_mean(name, known)
        raise Wrong(f"names the parameter {name!r}; there are {listing(sorted(known - {''}))}. {near}".rstrip())


def _prepare(value: Any, has: Declaration) -> Any:
    if not isinstance(value, dict):
        raise _gives(value)
    for name in value:
        _known(name, has)
    missing = [name for name in has.parameters if name not in value and name != "effects"]
    if missing:
        raise Wrong(f"leaves out {listing(missing)}.")
    return value


def _two_numbers(value: Any, has: Declaration) -> Any:
    if not isinstance(value, tuple) or len(value) != 2 or not all(map(_is_number, value)):
        raise _gives(value)
    return value


def _number(value: Any, has: Declaration) -> Any:
    if not _is_number(value):
        raise _gives(value)
    return value


def _number_or_none(value: Any, has: Declaration) -> Any:
    return value if value is None else _number(value, has)


def _numbers(value: Any, has: Declaration) -> Any:
    for row in _rows(value):
        fits = isinstance(row, tuple) and len(row) == 3 and isinstance(row[0], str) and isinstance(row[2], str)
        if not fits or not _is_number(row[1]):
            raise _gives(row)
    return value


def _nothing(value: Any, has: Declaration) -> Any:
    return value


def _zone(value: Any, has: Declaration) -> Any:
    if value not in has.zones:
        raise _gives(value)
    return value


REPLIES: dict[str, tuple[str, Callable[[Any, Declaration], Any]]] = {
    "inertia": (
        'It gives a map from ports to finite numbers from 0 on (in SI), such as {"flange": p.mass}; {} for none.',
        _inertia,
    ),
    "start": (
        'It gives a map from ports to a potential, or to (position, speed), with None for what is not given: '
        '{"flange": (p.position, None)}.',
        _start,
    ),
    "prescribes": (
        'It gives a map from ports to the names of their outputs, {"flange": ("x", "v", "a")}, or to None: at rest.',
        _prescribes,
    ),
    "starts_at": ("It gives nothing; it is told where the body is.", _nothing),
    "ties": (
        'It gives ties (a, b, ratio, offset) in a tuple, with ratios that are not zero: (("a", "b", p.ratio, 0.0),).',
        _ties,
    ),
    "expand": (EXPANSION, _nothing),  # composition.py looks at it
    "check": ("It yields three texts: the parameter (or ''), what is wrong, and a way out.", _check),
    "doubts": ("It yields three texts: the parameter (or ''), what is odd, and a way out.", _check),
    "prepare": ("It gives a map of all parameters by name: {**given, 'creep': 1e-4}.", _prepare),
    "fastest": ("It gives two numbers: speed without load [rad/s], and torque at rest [N*m].", _two_numbers),
    "begins_in": ("It gives the name of one of its zones.", _zone),
    "breaks_away_at": ("It gives a number: friction over normal force.", _number),
    "narrowest": ("It gives a slip speed [m/s], or None.", _number_or_none),
    "changes_over": ("It gives a range of slip speeds [m/s], or None.", _number_or_none),
    "numbers": ("It gives rows of a name, a number and a unit: (('v_m', p.creep, 'm/s'),).", _numbers),
}
"""What each method gives, in words, and what looks at it."""
