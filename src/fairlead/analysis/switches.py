"""What a scene can switch: effects, treatments of friction, and what it gives that may be left out.

    for switch in switches(model): load(switch.settings)

    an effect          declared by a component (`effects: {valve_dynamics: off}`) or by the framework (`energy`)
    a word             another option of a choice that a component of the netlist has (`compression: carried`), or a sea
    an optional part   a parameter or block that the netlist gives and its class can do without (`ruck_force`)
    a treatment        of friction: exact hold, binding, or no sticking at all
    a curve            of friction that is its constant level instead (`pad.curve: 0.4`)
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from fairlead.analysis.laid_route import laid_routes
from fairlead.analysis.on_the_drum import most_paid_out
from fairlead.analysis.timed_run import Load
from fairlead.analysis.treatments import EXACT, treatment, treatment_of
from fairlead.component.base import Family
from fairlead.component.declare import Block, Choice, Effect, Parameter, Table
from fairlead.component.effects import switch
from fairlead.component.scene import FRAMEWORK_EFFECTS
from fairlead.errors import FairleadError, ModelError

NO_STICKING = "tanh"
NOT_PHYSICS = ("name", "start", "width", "bend_radius", "position", "velocity", "angle", "speed", "method", "creep",
               "normal_force", "graded")  # fmt: skip
"""Optional parameters that say where or how, not what is modelled."""


@dataclass(frozen=True)
class Switch:
    """One thing that can be otherwise than the scene has it: how it is called, and the settings that do it."""

    name: str
    now: str  # as the scene has it
    then: str  # with the settings
    settings: Mapping[str, str]
    kind: str = "effect"  # or word, part, treatment, curve

    @property
    def label(self) -> str:
        """What stands in tables: `valve_dynamics off`."""
        return f"{self.name} {self.then}"


def switches(model: Any) -> list[Switch]:
    """All switches of a scene, the declared effects first."""
    return [*_effects(model), *_treatments(model), *_curves(model), *_words(model), *_seas(model), *_parts(model)]


def all_off(load: Load, found: list[Switch]) -> Switch | None:
    """Every effect that is on switched off together; None when there are fewer than two.

    A component that goes with one effect takes its own effects with it: the netlist is then not to name them.
    """
    on = [one for one in found if one.kind == "effect" and one.then == "off"]
    together = {name: word for one in on for name, word in one.settings.items()}
    if len(on) < 2:
        return None
    try:
        load(together).check()
    except ModelError as error:
        gone = {name for name in together for fault in error.faults if fault.what.startswith(f"{name}:")}
        together = {name: word for name, word in together.items() if name not in gone}
    except FairleadError:
        pass  # it is told by the run
    return Switch("all effects", "on", "off", together)


def _effects(model: Any) -> Iterator[Switch]:
    """The scene's switch, and those of the components that have their own word."""
    declared = model.assembly.effects
    for name in sorted({name for words in declared.values() for name in words}):
        words = [words[name] for words in declared.values() if name in words]
        now = "on" if "on" in words else "off"
        yield _effect(model, name, now)
    for name in FRAMEWORK_EFFECTS:
        given = model.netlist.effects.get(name)
        now = "off" if given is not None and switch(given.plain()) == "off" else "on"
        yield _effect(model, name, now)


def _effect(model: Any, name: str, now: str) -> Switch:
    then = "off" if now == "on" else "on"
    settings = {f"effects.{name}": then}
    for entry in model.netlist.components.values():
        own = entry.parameters.get("effects")
        if own is not None and name in own.entries:
            settings[f"{entry.name}.effects.{name}"] = then
    return Switch(name, now, then, settings)


def _treatments(model: Any) -> Iterator[Switch]:
    """Exact hold or binding, whichever the scene has not, and friction that never sticks."""
    now = treatment_of(model)
    for word in dict.fromkeys(("binding" if now == EXACT else EXACT, NO_STICKING)) if now else ():
        if word != now:
            yield Switch("friction", now, word, treatment(model, word), "treatment")


def _curves(model: Any) -> Iterator[Switch]:
    """Curves of friction without their dependence on speed: all at once, each at its level of steady sliding."""
    levels = {
        path: str(value.entries["coulomb"].content)
        for entry in model.netlist.components.values()
        for name, one in entry.parameters.items()
        for path, value in _maps(f"{entry.name}.{name}", one)
        if "coulomb" in value.entries and "curve" in value.entries and value.entries["curve"].content != "coulomb"
    }
    if levels:
        yield Switch("speed dependence of friction", "on", "off", levels, "curve")


def _maps(path: str, value: Any) -> Iterator[tuple[str, Any]]:
    """All maps in a value, with the path that overrides them."""
    if isinstance(value.content, dict):
        yield path, value
        for name, one in value.content.items():
            yield from _maps(f"{path}.{name}", one)
    elif isinstance(value.content, list):
        for number, one in enumerate(value.content):
            yield from _maps(f"{path}.{number}", one)


def _words(model: Any) -> Iterator[Switch]:
    """Other options of the choices that components of the netlist have."""
    for entry, declared in _entries(model):
        for name, one in declared.items():
            if not isinstance(one, Choice) or isinstance(one, Effect) or name in NOT_PHYSICS:
                continue
            given = entry.parameters.get(name)
            now = given.plain() if given is not None else one.default
            if isinstance(now, str):
                for option in one.options:
                    if option != now:
                        yield Switch(f"{entry.name}.{name}", now, option, {f"{entry.name}.{name}": option}, "word")


def _seas(model: Any) -> Iterator[Switch]:
    """Line far out in a sea that moves as one body, or does so no longer; if any line comes so far."""
    other = {"distributed": "rigid", "rigid": "distributed"}
    for laid in laid_routes(model.flat):
        schedule = laid.schedule()
        outmost = laid.ends(most_paid_out(schedule)[0] if schedule is not None else 0.0)[1]
        for sea in laid.seas:
            now = sea.station.form
            if now in other and outmost > sea.begin + laid.line.line.margin(sea.station):
                number = next(one.number for one in laid.route.line.placed if one.name == sea.name)
                form = {f"{laid.route.path}.stations[{number}].form": other[now]}
                yield Switch(f"{laid.route.path}.{sea.name}.form", now, other[now], form, "word")


def _parts(model: Any) -> Iterator[Switch]:
    """What is given and could be left out."""
    for entry, declared in _entries(model):
        for name, one in declared.items():
            optional = isinstance(one, Parameter | Block | Table) and one.default is None
            if optional and name in entry.parameters and name not in NOT_PHYSICS:
                yield Switch(f"{entry.name}.{name}", "given", "absent", {f"{entry.name}.{name}": "null"}, "part")


def _entries(model: Any) -> Iterator[tuple[Any, Mapping[str, Any]]]:
    """The components of the netlist with what their classes declare; contacts have their treatments instead."""
    from fairlead.component.registry import known_types

    types = known_types(getattr(model, "libraries", ()))
    for entry in model.netlist.components.values():
        kind = types[entry.type]
        if not issubclass(kind, Family):
            yield entry, kind.declaration.parameters
