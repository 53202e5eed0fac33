"""The classes of random scenes: what a seed of each makes, and what is known of it beside its netlist."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

from tests.scenes.blows import Blow, blow
from tests.scenes.catches import catch
from tests.scenes.jumps import jump
from tests.scenes.networks import network
from tests.scenes.ratios import LIBRARY, ratio
from tests.scenes.rebounds import rebound
from tests.scenes.routes import route
from tests.scenes.starts import start
from tests.scenes.ties import Twins, tie
from tests.scenes.varying import varying

VERSION = 1
"""Of the generators. Whoever changes what a seed gives raises it and plays all scenes again."""

SCENES = 225
"""Seeds of each class that count, from 0."""


@dataclass(frozen=True)
class Scene:
    """A netlist, and what is known of it beside."""

    kind: str
    seed: int
    text: str
    libraries: tuple[str, ...] = ()
    twins: Twins = field(default_factory=dict)
    """Bodies that move alike or as mirror images."""
    blow: Blow | None = None
    """What decides its impacts."""
    restitution: float = 0.0
    accuracies: tuple[float, float, float] = (1e-4, 1e-6, 1e-7)
    """What it is played at: loosely, as most netlists are; to be judged; and to see whether that is enough."""
    engines: bool = True
    """Whether another engine is asked; it would take minutes of a line on a route."""
    ramps: tuple[str, ...] = ()
    """The same with loads that go over in a short time instead of jumping, the slower first."""

    @property
    def name(self) -> str:
        """Class and seed."""
        return f"{self.kind} {self.seed}"


def _impacts(seed: int) -> Scene:
    """Without and with restitution by turns."""
    if seed % 2 == 0:
        one = blow(seed // 2)
        return Scene("impacts", seed, one.text, blow=one)
    one, share = rebound(seed // 2)
    return Scene("impacts", seed, one.text, blow=one, restitution=share)


def _ties(seed: int) -> Scene:
    text, twins = tie(seed)
    return Scene("ties", seed, text, twins=twins)


def _jumps(seed: int) -> Scene:
    text, *ramps = (jump(seed, how, "rodas") for how in ("step", "10 us", "1 us"))
    return Scene("jumps", seed, text, ramps=tuple(ramps))


CLASSES: dict[str, Callable[[int], Scene]] = {
    "networks": lambda seed: Scene("networks", seed, network(seed)),
    "impacts": _impacts,
    "catches": lambda seed: Scene("catches", seed, catch(seed)),
    "ties": _ties,
    "limits": lambda seed: Scene("limits", seed, varying(seed)),
    "ratios": lambda seed: Scene("ratios", seed, ratio(seed), libraries=(LIBRARY,)),
    "routes": lambda seed: Scene("routes", seed, route(seed), accuracies=(1e-3, 1e-5, 1e-6), engines=False),
    "jumps": _jumps,
    "starts": lambda seed: Scene("starts", seed, start(seed)),
}
