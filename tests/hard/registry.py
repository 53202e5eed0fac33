"""The hard cases: a name, a sentence, an oracle, and the engines and treatments that must come through.

A case is a function that plays scenes and compares what comes out with physics:

    @case(variants={"10": {"blocks": 10}, "1000": {"blocks": 1000}}, cost={"1000": "slow"})
    def blocks_let_go_together(play, blocks):
        \"\"\"Equal blocks under equal loads let go in one instant.

        Oracle: each moves as one alone would, to the last digit that matters.
        \"\"\"
        result = play.run(blocks_under_a_load(blocks))
        play.near("position", result["block[0].x"][-1], exact, within=1e-6)

The name of the case is that of the function and its variant. Both the tests and the scoreboard read this table.
"""

from __future__ import annotations

import functools
import inspect
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Literal

if TYPE_CHECKING:
    from tests.hard.play import Play

ENGINES = ("rodas", "rodas3p", "stepping", "ida")
TREATMENTS = ("hold", "binding", "lugre")
NO_FRICTION = ("none",)
Cost = Literal["cheap", "fair", "slow"]
"""What a row takes: less than a second, some seconds, more."""


@dataclass(frozen=True)
class Case:
    """One hard case; `theme` is the file it is in."""

    name: str
    theme: str
    what: str
    oracle: str
    function: Callable[..., None]
    arguments: Mapping[str, Any]
    engines: Sequence[str]
    treatments: Sequence[str]
    cost: Cost
    budget: float
    """Wall time [s] of a row; more is counted as stuck."""

    def play(self, play: Play) -> None:
        """Play it. Raises Broken with the reason when it does not come through."""
        self.function(play, **self.arguments)

    @property
    def title(self) -> str:
        """The name without the variant."""
        return self.function.__name__.replace("_", " ")

    @property
    def source(self) -> str:
        """What decides the outcome beside fairlead itself: the text of the file the case is in."""
        return _source(self.function.__module__)


@functools.cache
def _source(module: str) -> str:
    return inspect.getsource(sys.modules[module])


@dataclass(frozen=True)
class Row:
    """A case on one engine with one treatment."""

    case: Case = field(repr=False)
    engine: str
    treatment: str

    @property
    def name(self) -> str:
        """How it is called in tests and on the scoreboard."""
        return f"{self.case.name} / {self.engine} / {self.treatment}"


CASES: dict[str, Case] = {}


def case(
    variants: Mapping[str, Mapping[str, Any]] | None = None, *, engines: Sequence[str] = ENGINES,
    treatments: Sequence[str] = TREATMENTS, cost: Cost | Mapping[str, Cost] = "cheap", budget: float = 30.0,
) -> Callable[[Callable[..., None]], Callable[..., None]]:  # fmt: skip
    """Enter a function into the table, once for each variant; `cost` may be told by variant, else it is cheap."""

    def enter(function: Callable[..., None]) -> Callable[..., None]:
        what, _, oracle = inspect.cleandoc(function.__doc__ or "").partition("Oracle:")
        title = function.__name__.replace("_", " ")
        for word, arguments in (variants or {"": {}}).items():
            name = f"{title}, {word}" if word else title
            price = cost if isinstance(cost, str) else cost.get(word, "cheap")
            theme = function.__module__.rpartition(".")[2]
            CASES[name] = Case(
                name, theme, " ".join(what.split()), " ".join(oracle.split()), function, dict(arguments),
                tuple(engines), tuple(treatments), price, budget,
            )  # fmt: skip
        return function

    return enter


def rows() -> Iterator[Row]:
    """All there is to play."""
    import tests.hard.cases  # noqa: F401  fills the table

    for one in CASES.values():
        for engine in one.engines:
            for treatment in one.treatments:
                yield Row(one, engine, treatment)
