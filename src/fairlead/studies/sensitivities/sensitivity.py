"""Sensitivities of a model: what is asked, the runs, and the table.

fairlead.sensitivity(model, of="peak(block.x)", to=["pad.normal_force", "pad.curve.stiction"])
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING

import numpy as np

from fairlead.arguments import Arguments, keywords_told
from fairlead.cases.cases import Cases
from fairlead.cases.figures import Function
from fairlead.errors import FairleadError, Fault, Location, ModelError
from fairlead.quantities import quotient
from fairlead.studies.differences.steps import LADDER, NEAR, near, noise_of
from fairlead.studies.sensitivities.derivative import derivative
from fairlead.studies.sensitivities.parameters import PLACE, Varied, asked_parameters, defaults
from fairlead.studies.sensitivities.runs import Floats, Runs, Told
from fairlead.studies.sensitivities.table import Sensitivities

if TYPE_CHECKING:
    from fairlead.model import Model

Figures = str | Function | Iterable[str] | Mapping[str, str | Function]
FIGURES = Location("of")
Parameters = str | Iterable[str] | Mapping[str, str | float | None]


@keywords_told
def sensitivity(
    model: Model, of: Figures | None = None, to: Parameters | None = None, *, max_steps: int | None = None,
    told: Told | None = None,
) -> Sensitivities:  # fmt: skip
    """Derivatives of figures (`of`) to parameters (`to`), each with its error, or the reason why it has none.

    `of`: a figure as text (docs/studies.md), a function of the result, several of them, or a map of names; None stands
    for the figures of the netlist. `to`: names as after `--set`, or a map of names to the size in which changes of each
    are counted, which a parameter that is 0 needs; the size None is its own value. Without `to` the parameters are the
    numbers among those of the scene.
    `max_steps` bounds each run. `told` is called with a line before each run.

    Raises ModelError with every mistake in what is asked, FairleadError when the run of the model as it is fails.
    """
    asked = Arguments("sensitivity")
    asked.model(model)
    _sound(asked, of, to)
    if max_steps is not None:
        asked.whole("max_steps", max_steps, 1)
    asked.function("told", told, ("a line of text",))
    asked.refuse()
    cases, varied = _asked(model, of, to, max_steps)
    runs = Runs(cases, varied, told)
    begun = np.zeros(len(varied))
    first = runs.at(begun).row
    if not first.ok:
        raise FairleadError(f"The run of {cases.name} as it is is {first.status}: {first.sentence}")
    bounds = _bounds(runs)
    noise = _noise(runs, bounds)
    units = {one.name: one.unit for one in varied}
    rows = tuple(
        derivative(runs, name, index, bounds, noise[name], quotient(cases.units[name], units[one.name]))
        for name in cases.units for index, one in enumerate(varied)
    )  # fmt: skip
    return Sensitivities(cases.name, rows, first.figures, cases.units, noise, {one.name: one.value for one in varied},
                         len(runs.made))  # fmt: skip


def _asked(
    model: Model, of: Figures | None, to: Parameters | None, max_steps: int | None
) -> tuple[Cases, list[Varied]]:
    faults: list[Fault] = []
    varied = asked_parameters(model, _parameters(model, to), faults)
    try:
        cases = Cases(model, _figures(of), max_steps=max_steps)
    except ModelError as error:
        raise ModelError([*error.faults, *faults]) from None
    if not varied and not faults and to is not None:
        faults.append(Fault(PLACE, "no parameter is named", "Leave it out: then all numbers of the scene are taken."))
    elif not varied and not faults:
        known = f"Name one of its components, as in {next(iter(model.netlist.components), 'pad')}.NAME."
        faults.append(Fault(PLACE, f"{cases.name} has no numbers among its parameters", known))
    if not cases.figures and of is not None:
        faults.append(Fault(FIGURES, "no figure is named", "Leave it out: then those of the netlist are taken."))
    elif not cases.figures:
        faults.append(Fault(PLACE, f"{cases.name} records nothing by name", "Name a figure, such as peak(block.x)."))
    if faults:
        raise ModelError(faults)
    return cases, varied


def _sound(asked: Arguments, of: object, to: object) -> None:
    """Figures and parameters that are of no kind that can be meant; their names are looked up later."""
    if isinstance(of, Mapping):
        asked.map_of("of", of, '{"peak": "peak(block.x)"}', (str, Callable), "is neither a text nor a function")
    elif of is not None and not callable(of):
        asked.names("of", of, '["peak(block.x)"]', functions=True)
    if isinstance(to, Mapping):
        asked.map_of("to", to, '{"pad.normal_force": "1 N"}', (str, int, float, type(None)), "is no size of changes")
    elif to is not None:
        asked.names("to", to, '["pad.normal_force"]')


def _figures(of: Figures | None) -> dict[str, str | Function] | None:
    if of is None:
        return None
    if isinstance(of, Mapping):
        return dict(of)
    several = [of] if isinstance(of, str) or callable(of) else list(of)
    return {one if isinstance(one, str) else getattr(one, "__name__", str(one)): one for one in several}


def _parameters(model: Model, to: Parameters | None) -> dict[str, str | float | None]:
    if to is None:
        return dict.fromkeys(defaults(model))
    if isinstance(to, Mapping):
        return dict(to)
    return dict.fromkeys([to] if isinstance(to, str) else to)


def _bounds(runs: Runs) -> tuple[Floats, Floats]:
    """Of each parameter how far it may go: to the largest step that the model takes."""
    count = range(len(runs.varied))
    low, high = (np.array([side * runs.reach(k, LADDER, side) for k in count]) for side in (-1.0, 1.0))
    return low, high


def _noise(runs: Runs, bounds: tuple[Floats, Floats]) -> dict[str, float]:
    """The noise of every figure, near the model as it is but not there: a jump may lie exactly at its values."""
    aside = np.where(bounds[1] > 0, NEAR, -NEAR)
    found = {}
    for name in runs.cases.units:
        table = near(runs.figure(name), aside, bounds)
        found[name] = noise_of(table) if np.isfinite(table).all() else 0.0
    return found
