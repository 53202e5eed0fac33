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
from tests.scenes.oracles.agreement import FACTOR, Compared, agreement, away
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
METHOD: dict[str, Any] = {"method": OTHER}
"""The method of `rodas` that stands in where the rival refuses a scene: other stages, other order."""
RIVAL_STEPS = 60_000
"""Steps after which a rival takes no part; what it takes is no matter of how busy the machine is."""
FINER = (1.0, 0.1, 0.01)
"""A rival that does not agree is asked for more of its accuracy: what counts is the best that it has to say, and how
far that is from what it said before, which is its own estimate of its error."""
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
    for accuracy, estimate in ((loose, loose), (fine, judged)):
        other = _finished(observed(model, accuracy, engine))
        if said := energy(other):
            return Verdict("wrong", f"accuracy {accuracy:g}: {said}")
        comparison.ask(Compared(other), f"accuracy {accuracy:g}", estimate)
    rival = _beside_rival(scene, comparison, engine)
    if image := mirrored(every_step(scene.text)):
        other = _finished(observed(loaded(scene, image), judged, engine))
        comparison.ask(Compared(other, -1.0, SHOWN), "mirrored", judged)
    return Verdict("right", "", comparison.horizon, rival)


def _beside_rival(scene: Scene, comparison: _Comparison, engine: str) -> str:
    """Compare with another engine, and with another method where that does not; why no rival took part, if none did."""
    model, judged, why = comparison.model, scene.accuracies[1], ""
    for what, settings in ((f"engine {RIVALS[engine]}", {"engine": RIVALS[engine]}), (f"method {OTHER}", METHOD)):
        if not scene.engines and engine == "rodas" and settings is not METHOD:
            continue
        last, own = None, None  # a rival that does not agree and knows nothing of its own error says nothing
        try:
            for finer in FINER:
                other = observed(model, finer * judged, max_steps=RIVAL_STEPS, **settings)
                if other.status != "finished":
                    why = f"{what}: {other.said}"
                    break
                before, last = last, Compared(other)
                own = None if before is None else np.maximum.accumulate(away(last, before)) / FACTOR
                if not agreement(comparison.main, last, what, own):
                    return ""
        except FairleadError:
            why = f"{what}: refused"
            continue
        if own is not None:
            comparison.ask(last, what, judged, own)
            return ""
        if engine != "rodas":
            break
    return why


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

    def ask(self, other: Compared, what: str, accuracy: float, own: np.ndarray | None = None) -> None:
        """Compare. `own` is the error that the other run is known to have. Raises _Left where they differ by more."""
        if not agreement(self.main, other, what, own):
            return
        grown, horizon = sensitivity(self.model, self.main, accuracy)
        stop = float(self.main.grid[-1])
        if horizon < SOON * stop and accuracy > self.main.run.accuracy:
            return  # so loose an accuracy foretells nothing of it
        if horizon < SOON * stop:
            raise _Left("aside", f"{what}: moved by {accuracy:g} at the start it parts from itself at {horizon:.3g} s")
        if own is not None:
            grown = grown + own
        if said := agreement(self.main, other, what, grown, horizon):
            raise _Left("wrong", said)
        self.horizon = min(self.horizon, horizon)
