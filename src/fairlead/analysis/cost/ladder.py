"""What a study of cost varies: accuracy, engine, treatment of friction, creep, elements; and in which order.

The ladder is a star and not a product. The scene as it is goes through every engine at every accuracy; each other
treatment, creep and mesh goes through every accuracy on the engine that `auto` takes, the scene's own accuracy first.
What matters most comes first, since the time is boxed.
"""

from __future__ import annotations

import importlib.util
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from fairlead.analysis.cost.meshes import Mesh, meshes
from fairlead.analysis.treatments.treatments import creep, creep_of, kinds_of_treatment, treatment, treatment_of
from fairlead.errors import UsageError, did_you_mean

ENGINES = ("rodas", "stepping", "ida")
ACCURACIES = (1e-2, 1e-3, 1e-4, 1e-5)
CREEPS = (10.0, 0.1)  # times that of the scene
FINER = (0.5, 2.0)  # elements of twice and of half the size; the finest is what the others are measured against


@dataclass(frozen=True)
class Ladder:
    """What the user chose; None means the sensible set: what is above, exact hold, and what creeps."""

    accuracies: Sequence[float] = ACCURACIES
    engines: Sequence[str] | None = None
    treatments: Sequence[str] | None = None
    creeps: Sequence[float] | None = None  # m/s
    finer: Sequence[float] | None = None


@dataclass(frozen=True)
class Equations:
    """A scene with a treatment, a creep and a mesh: what an accuracy and an engine then solve."""

    label: str
    settings: Mapping[str, str] = field(default_factory=dict, hash=False)
    axis: str = "scene"  # or treatment, creep, mesh
    exact: bool = False  # contacts hold exactly


@dataclass(frozen=True)
class Rung:
    """One line of the table."""

    equations: Equations
    engine: str
    accuracy: float

    @property
    def settings(self) -> dict[str, str]:
        """What `--set` would be given."""
        return {**self.equations.settings, "run.engine": self.engine, "run.accuracy": f"{self.accuracy:g}"}

    @property
    def label(self) -> str:
        """How tables and sentences call it."""
        return f"accuracy {self.accuracy:.0e} with {self.engine}".replace("e-0", "e-") + (
            f", {self.equations.label}" if self.equations.label else ""
        )


def engines_here() -> list[str]:
    """The engines that this installation has."""
    return [name for name in ENGINES if name != "ida" or importlib.util.find_spec("sksundae") is not None]


def checked(ladder: Ladder) -> Ladder:
    """The ladder itself. Raises UsageError for what cannot be run."""
    for name in ladder.engines or ():
        if name not in ENGINES:
            raise UsageError(f"--engine {name}: there is no such engine. {did_you_mean(name, ENGINES)}\n"
                             f"    There are {', '.join(ENGINES)}.")  # fmt: skip
        if name not in engines_here():
            raise UsageError('--engine ida: it is not installed.\n    pip install "fairlead[ida]"')
    for value in ladder.accuracies:
        if not 1e-10 <= value <= 0.1:
            raise UsageError(f"--accuracy {value:g} is not between 1e-10 and 0.1.\n    Write 1e-3, for example.")
    for value in ladder.creeps or ():
        if not value > 0:
            raise UsageError(f"--creep {value:g} m/s is not above zero.\n    Write '0.1 mm/s', for example.")
    for value in ladder.finer or ():
        if not 0 < value <= 100:
            raise UsageError(f"--finer {value:g} is not above 0 and up to 100.\n    2 halves the elements.")
    return ladder


def own_equations(model: Any) -> Equations:
    """The scene as it is."""
    word = treatment_of(model)
    return Equations("", exact=word in (kinds_of_treatment(model).exact, ""))


def other_equations(model: Any, ladder: Ladder) -> list[Equations]:
    """Other treatments and creeps, those that say most first; meshes are apart."""
    now, tolerated, found = treatment_of(model), creep_of(model), []
    if not now:
        return []
    kinds = kinds_of_treatment(model)
    exact, creeping = kinds.exact, kinds.creeping
    wanted = ladder.treatments if ladder.treatments is not None else [word for word in (exact, creeping) if word]
    found += [Equations(w, treatment(model, w), "treatment", exact=w == exact) for w in wanted if w != now]
    chosen = ladder.creeps
    if chosen is None:
        chosen = [factor * tolerated for factor in CREEPS] if tolerated and now != exact else []
    within = {} if tolerated else treatment(model, creeping)
    label = "creep" if tolerated else f"{creeping}, creep"
    found += [Equations(f"{label} {1e3 * one:.3g} mm/s", {**within, **creep(model, one)}, "creep") for one in chosen]
    return found


def exact_equations(model: Any) -> Equations:
    """The scene with contacts that hold exactly."""
    word = kinds_of_treatment(model).exact
    return Equations(word, treatment(model, word), "treatment", exact=True)


def other_meshes(model: Any, ladder: Ladder) -> list[Mesh]:
    """Other meshes, from coarse to fine; the last is the finest, if it is finer than the scene's."""
    return meshes(model, sorted(ladder.finer if ladder.finer is not None else FINER))


def rungs(equations: Equations, ladder: Ladder, model: Any) -> Iterator[Rung]:
    """The lines of one set of equations, the most useful first."""
    engines = list(ladder.engines or engines_here())
    own = model.netlist.run.accuracy
    accuracies = sorted(ladder.accuracies, key=lambda one: (abs(one / own - 1) > 1e-9, -one))
    first = [engine for engine in engines if engine != "ida"] or engines
    for engine in [*first[:1], *[e for e in engines if e != first[0]]] if equations.axis == "scene" else first[:2]:
        for accuracy in accuracies:
            yield Rung(equations, engine, accuracy)
