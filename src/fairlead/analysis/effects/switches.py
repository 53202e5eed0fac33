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

from fairlead.analysis.cost.timed_run import Load
from fairlead.analysis.statics.laid_route import laid_routes
from fairlead.analysis.statics.on_the_drum import most_paid_out
from fairlead.analysis.treatments.treatments import kinds_of_treatment, treatment, treatment_of
from fairlead.analysis.treatments.written import components, parts
from fairlead.component.base import Declared, Family
from fairlead.component.effects import switch
from fairlead.component.given import Block, Choice, Effect, Parameter, Table
from fairlead.component.scene import FRAMEWORK_EFFECTS
from fairlead.errors import FairleadError, ModelError


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

    A component that goes with one effect takes its own effects with it: the netlist is then not to name them. What the
    scene is refused without, as the last stretch of a line whose motion is given, stays on.
    """
    on = [one for one in found if one.kind == "effect" and one.then == "off"]
    together = {name: word for one in on for name, word in one.settings.items()}
    if len(on) < 2:
        return None
    try:
        load(together).check()
    except ModelError as error:
        gone = {name for name in together for fault in error.faults if fault.what.startswith(f"{name}:")}
        kept = {name: word for name, word in together.items() if name not in gone}
        together = kept if gone else _as_many_as_load(load, on)
    except FairleadError:
        pass  # it is told by the run
    return Switch("all effects", "on", "off", together)


def _as_many_as_load(load: Load, on: list[Switch]) -> dict[str, str]:
    """The settings of those that the scene can do without, taken one after the other."""
    together: dict[str, str] = {}
    for one in on:
        try:
            load(together | dict(one.settings)).check()
        except ModelError:
            continue
        together |= one.settings
    return together


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
    """Exact hold or what creeps, whichever the scene has not, and friction that never sticks."""
    now, kinds = treatment_of(model), kinds_of_treatment(model)
    others = (kinds.creeping if now == kinds.exact else kinds.exact, kinds.never_sticking) if now else ()
    for word in dict.fromkeys(others):
        if word not in (now, ""):
            yield Switch("friction", now, word, treatment(model, word), "treatment")


def _curves(model: Any) -> Iterator[Switch]:
    """Curves of friction without their dependence on speed: all at once, each at its level of steady sliding."""
    levels = {
        path: str(value.entries[level].content)
        for path, member, value in parts(model)
        if member.bare is not None and member.word != member.bare[0]
        if (level := member.answers.level) and level in value.entries
    }
    if levels:
        yield Switch("speed dependence of friction", "on", "off", levels, "curve")


def _words(model: Any) -> Iterator[Switch]:
    """Other options of the choices that components of the netlist have."""
    for entry, declared in _entries(model):
        for name, one in declared.items():
            if not isinstance(one, Choice) or isinstance(one, Effect):
                continue
            given = entry.parameters.get(name)
            now = given.plain() if given is not None else one.default
            if isinstance(now, str):
                for option in one.options:
                    if option != now:
                        yield Switch(f"{entry.name}.{name}", now, option, {f"{entry.name}.{name}": option}, "word")


def _seas(model: Any) -> Iterator[Switch]:
    """Line far out in a sea that moves as one body, or does so no longer; if any line comes so far."""
    for laid in laid_routes(model.flat):
        schedule = laid.schedule()
        outmost = laid.ends(most_paid_out(schedule)[0] if schedule is not None else 0.0)[1]
        for sea in laid.seas:
            choice = sea.station.type.answers.as_one
            if choice is None or outmost <= sea.begin + laid.says.margin(sea.station):
                continue
            name, *forms = choice
            now = sea.station.path(name)
            if now in forms:
                other = next(word for word in forms if word != now)
                number = next(one.number for one in laid.route.line.placed if one.name == sea.name)
                form = {f"{laid.route.path}.stations[{number}].{name}": other}
                yield Switch(f"{laid.route.path}.{sea.name}.{name}", now, other, form, "word")


def _parts(model: Any) -> Iterator[Switch]:
    """What is given and could be left out."""
    for entry, declared in _entries(model):
        for name, one in declared.items():
            optional = isinstance(one, Parameter | Block | Table) and one.default is None
            if optional and name in entry.parameters:
                yield Switch(f"{entry.name}.{name}", "given", "absent", {f"{entry.name}.{name}": "null"}, "part")


def _entries(model: Any) -> Iterator[tuple[Any, Mapping[str, Any]]]:
    """The components of the netlist with what they declare of their physics; contacts have their treatments instead."""
    for entry, kind in components(model):
        if not issubclass(kind, Family):
            declared = kind.declaration.parameters
            yield entry, {name: one for name, one in declared.items() if _is_physics(kind, name, one)}


def _is_physics(kind: type[Declared], name: str, declared: Any) -> bool:
    """False for what says where, how or how finely, what stands for a signal, and what is handed on to contacts."""
    if name in kind.answers.hands_on or any(one.default == name for one in kind.declaration.inputs.values()):
        return False
    if isinstance(declared, Parameter | Table):
        return declared.physics and not declared.mesh
    return declared.physics if isinstance(declared, Choice) else True
