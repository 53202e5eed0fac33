"""The verdict on a scene: played on an engine at several accuracies, on a rival, mirrored, every oracle asked.

    right     it finished, and every oracle that applies says so; of a sensitive scene up to its horizon
    aside     it cannot be foretold from its first tenth on, or its budget of time ran out
    refused   it is refused by name before it begins
    ended     it ended before its stop with a sentence
    wrong     it finished, and an oracle says that something shown is not so
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from fairlead.errors import FairleadError
from tests.scenes.classes import Scene
from tests.scenes.machine import Machine
from tests.scenes.mirrored import SHOWN, mirrored
from tests.scenes.observed import Observed, every_step, loaded, observed
from tests.scenes.oracles.agreement import Compared, agreement
from tests.scenes.oracles.beginning import beginning
from tests.scenes.oracles.energy import energy
from tests.scenes.oracles.impulses import impulses
from tests.scenes.oracles.laws import laws
from tests.scenes.oracles.momentum import isolated, momentum
from tests.scenes.oracles.ramps import ramps
from tests.scenes.oracles.sensitive import sensitivity
from tests.scenes.oracles.symmetry import symmetry

Word = Literal["right", "aside", "refused", "ended", "wrong"]
SOON = 0.1
"""Share of its time for which a scene must be foretold."""
OTHER = "rodas3p"
"""The method of `rodas` that stands in where the rival refuses a scene: other stages, other order."""
RIVAL_WALL = 5.0
"""Time [s] after which a rival takes no part."""
RIVALS = {"rodas": "ida", "ida": "rodas", "stepping": "rodas"}


@dataclass(frozen=True)
class Verdict:
    """What came of a scene, why, and until when it was judged [s]."""

    word: Word
    why: str = ""
    horizon: float = np.inf
    rival: str = ""
    """What came of the rival, where it did not take part."""


class _Left(Exception):
    def __init__(self, word: Word, why: str) -> None:
        super().__init__(why)
        self.verdict = Verdict(word, re.sub(r"\s+", " ", why))


def judge(scene: Scene, engine: str = "rodas") -> Verdict:
    """Play a scene and ask every oracle."""
    try:
        return _judged(scene, engine)
    except _Left as left:
        return left.verdict
    except FairleadError as error:
        return Verdict("refused", re.sub(r"\s+", " ", str(error)))


def _judged(scene: Scene, engine: str) -> Verdict:
    model, (loose, judged, fine) = loaded(scene), scene.accuracies
    model.check()
    main = _finished(observed(model, judged, engine))
    if said := shown_wrong(scene, main) or _unlike_ramps(scene, main, engine):
        return Verdict("wrong", said)
    comparison = _Comparison(model, Compared(main), engine)
    rival = ""
    for what, run, accuracy in (
        (f"accuracy {loose:g}", lambda: observed(model, loose, engine), loose),
        (f"accuracy {fine:g}", lambda: observed(model, fine, engine), judged),
        (f"engine {RIVALS[engine]}", lambda: observed(model, judged, RIVALS[engine], max_wall=RIVAL_WALL), judged),
    ):
        try:
            other = run()
        except FairleadError:
            rival = f"{what}: refused"
            if what.startswith("engine") and engine == "rodas":
                comparison.ask(Compared(_finished(observed(model, judged, method=OTHER))), f"method {OTHER}", judged)
            continue
        if other.status != "finished":
            if not what.startswith("engine"):
                _finished(other)
            rival = f"{what}: {other.said}"
            continue
        if accuracy == loose and (said := energy(other)):
            return Verdict("wrong", f"{what}: {said}")
        comparison.ask(Compared(other), what, accuracy)
    if image := mirrored(every_step(scene.text)):
        other = _finished(observed(loaded(scene, image), judged, engine))
        comparison.ask(Compared(other, -1.0, SHOWN), "mirrored", judged)
    return Verdict("right", "", comparison.horizon, rival)


def shown_wrong(scene: Scene, run: Observed) -> str:
    """What the oracles that need nothing but one run find wrong with it; nothing if all is right."""
    if not all(np.isfinite(column).all() for column in run.columns.values()):
        return "a recorded number is not finite"
    machine = Machine(scene.text)
    return (
        energy(run) or beginning(run, machine) or momentum(run, machine) or isolated(run, machine)
        or laws(run, machine) or (scene.blow is not None and impulses(run, scene.blow, scene.restitution))
        or symmetry(run, scene.twins)
    )  # fmt: skip


def _finished(run: Observed) -> Observed:
    if run.status == "finished":
        return run
    raise _Left("aside" if run.status == "budget" else "ended", run.said)


def _unlike_ramps(scene: Scene, main: Observed, engine: str) -> str:
    if not scene.ramps:
        return ""
    slow, fast = (_finished(observed(loaded(scene, text), main.accuracy, engine)) for text in scene.ramps)
    said = ramps(main, slow, fast)
    if said is None:
        raise _Left("aside", "ramps of 10 and 1 us do not agree")
    return said


@dataclass
class _Comparison:
    """Runs beside the main one; how sensitive the scene is, is asked for when two of them differ."""

    model: Any
    main: Compared
    engine: str
    horizon: float = np.inf

    def ask(self, other: Compared, what: str, accuracy: float) -> None:
        """Compare. Raises _Left where the runs differ by more than their errors."""
        if not agreement(self.main, other, what):
            return
        grown, horizon = sensitivity(self.model, self.main, accuracy)
        stop = float(self.main.grid[-1])
        if horizon < SOON * stop:
            raise _Left("aside", f"{what}: moved by {accuracy:g} at the start it parts from itself at {horizon:.3g} s")
        if said := agreement(self.main, other, what, grown, horizon):
            raise _Left("wrong", said)
        self.horizon = min(self.horizon, horizon)
