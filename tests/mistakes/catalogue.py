"""All mistakes by kind."""

from tests.mistakes import (
    command_mistakes,
    component_mistakes,
    fourth_look,
    netlist_mistakes,
    python_mistakes,
    second_look,
    third_look,
)
from tests.mistakes.entry import Mistake

CATALOGUE: dict[str, tuple[Mistake, ...]] = {
    "netlist": (*netlist_mistakes.MISTAKES, *second_look.NETLISTS, *third_look.NETLISTS, *fourth_look.NETLISTS),
    "command": (*command_mistakes.MISTAKES, *second_look.COMMANDS),
    "component": component_mistakes.MISTAKES,
    "python": (*python_mistakes.MISTAKES, *second_look.PYTHON, *third_look.PYTHON, *fourth_look.PYTHON),
}

ALL = {f"{kind}: {mistake.name}": mistake for kind, mistakes in CATALOGUE.items() for mistake in mistakes}
