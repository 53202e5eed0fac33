"""What a study measures against: tight runs by independent engines that must agree, or the spread that they have.

    rodas, at ten or a hundred times that accuracy where it does not finish; then the first of ida, stepping, and
    rodas3p (a second method of rodas, which shares the location of switches) that finishes in its share of the
    budget. They are the reference when they agree to AGREE.

    Otherwise runs of rodas at a hundred and ten times the accuracy tell whether it converges at all. If not, the
    scene is sensitive to everything. If it does, the next engine is asked too, and the two that agree best are
    the reference: the third is said to dissent. A scene that is not studied whole does with two that agree to PASSABLE.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator
from dataclasses import dataclass

from fairlead.analysis.cost.boxed_runs import BoxedRuns
from fairlead.analysis.cost.deviation import OutputError, output_errors, worst
from fairlead.analysis.cost.ladder import Equations, engines_here
from fairlead.analysis.cost.study import AGREE, Reference
from fairlead.analysis.cost.timed_run import Timed

BDF = 0.01  # share of the budget that the scene may take for ida to be tried as a reference: it is slow at switches
CONVERGING = 0.5  # the spread of tight runs over that of less tight ones; with more they do not converge
LOST = 0.1  # rms over the range: so far apart two motions are as good as unrelated, however far looser runs are
PASSABLE = 1e-2  # spread with which a scene must do that the budget does not let be studied whole: no third is asked
ENOUGH = 3  # engines asked when two do not agree
FIRST_TIGHT = 0.06  # share of the budget in which the first tight run must finish: a study needs half a dozen such runs
SLOWER, WORTH_WAITING = 4.0, 2.0  # times rodas, s: an engine that takes longer, and more than that, is no reference
SCATTER = 2.0  # a few runs of a sensitive scene lie nearer to each other than others may
LOOSER, TIMES = 10.0, 2  # what is tried when a tight run does not finish, and how often


@dataclass
class References:
    """Makes references; `remarks` collects what did not work."""

    runs: BoxedRuns
    units: list[str]
    remarks: list[str]
    reached: float = math.nan  # s, simulated, by a first tight run that was cut off

    def of_scene(self, equations: Equations, cap: float = math.inf) -> Reference | None:
        """Tight runs by two engines, or three where two do not agree; None when rodas does not finish in `cap` s."""
        runs = self.finished(equations, cap)
        engine, first = next(runs)
        if first is None:
            return None
        self.tell_ties(first)
        found = {engine: first}
        for engine, timed in runs:
            assert timed is not None
            found[engine] = timed
            apart = self.apart(timed, first)[0]
            if apart <= AGREE or len(found) == ENOUGH:
                break
            if len(found) == 2 and not self.converges(equations, first):
                return self.sensitive(equations, found)
            if apart <= PASSABLE and not (self.runs.whole or self.runs.full):
                break
        if len(found) == 1 and (again := self._again(equations)) is not None:
            spread, name = self.apart(again, first)
            label = f"rodas at accuracy {self.runs.tight:g} and {LOOSER:g} times that, other engines being too slow"
            return Reference(label, first, spread, name)
        return self.best_pair(found)

    def _again(self, equations: Equations) -> Timed | None:
        """A looser run of rodas, where it is all there is: what it says of its own convergence."""
        timed = self.runs.run(self._looser(equations, LOOSER), math.inf)
        return timed if timed is not None and timed.finished else None

    def _looser(self, equations: Equations, times: float) -> dict[str, str]:
        return {**equations.settings, "run.engine": "rodas", "run.accuracy": f"{min(times * self.runs.tight, 1e-2):g}"}

    def finished(self, equations: Equations, most: float = math.inf) -> Iterator[tuple[str, Timed | None]]:
        """Engines with their tight runs: rodas, even if it failed, then the others that finish."""
        first = self._first(equations, most)
        yield "rodas", first
        worth = max(WORTH_WAITING, FIRST_TIGHT * self.runs.budget)
        cap = math.inf if first is None or self.runs.full else max(worth, SLOWER * first.wall)
        here = [e for e in reversed(engines_here()) if e == "stepping" or (e == "ida" and self.brief())]
        for engine in [*here, "rodas3p"]:
            timed = self.runs.tightly(equations, engine, cap)
            if timed is not None and timed.finished:
                yield engine, timed

    def _first(self, equations: Equations, cap: float) -> Timed | None:
        """rodas, at the tightest accuracy at which it finishes; from there on all references are had at that."""
        wanted = self.runs.tight
        for _ in range(TIMES + 1):
            timed = self.runs.tightly(equations, "rodas", cap)
            self.reached = timed.reached if timed is not None and timed.status == "budget" else math.nan
            if timed is not None and timed.finished:
                if self.runs.tight > wanted:
                    self.remarks.append(f"References at {self.runs.tight:g}: at {wanted:g} rodas did not finish.")
                return timed
            if timed is None or timed.status == "budget":
                break  # looser is not much faster; a shorter time is
            self.runs.tight *= LOOSER
        self.runs.tight = wanted
        self.complain("rodas", timed)
        return None

    def brief(self) -> bool:
        """Whether ida can be asked in time."""
        return self.runs.full or (self.runs.whole and self.runs.usual < BDF * self.runs.budget)

    def best_pair(self, found: dict[str, Timed]) -> Reference:
        """The two that are nearest to each other; rodas is the solution if it is one of them."""
        accuracy = f"at accuracy {self.runs.tight:g}"
        if len(found) == 1:
            (name,) = found
            self.remarks.append("Only one tight run finished in its share of the budget: the floor is not known.")
            return Reference(f"{name} {accuracy}", found[name])
        pairs = {(a, b): self.apart(found[b], found[a]) for a, b in itertools.combinations(found, 2)}
        one, two = min(pairs, key=lambda pair: pairs[pair][0])
        spread, name = pairs[one, two]
        odd = [engine for engine in found if engine not in (one, two)]
        dissent = ""
        if odd and spread <= AGREE:
            away, of = self.apart(found[odd[0]], found[one])
            dissent = f"{odd[0]} is {100 * away:.2g} % from them ({of})"
        elif odd:
            apart = (f"{a} and {b} are {100 * gap:.2g} % apart" for (a, b), (gap, _) in pairs.items())
            dissent = f"three engines were asked: {', '.join(apart)}"
        return Reference(f"{one} and {two} {accuracy}", found[one], spread, name, dissent=dissent)

    def sensitive(self, equations: Equations, found: dict[str, Timed]) -> Reference:
        """A reference of which only statistics mean something.

        Its floor is how far statistics of tight runs scatter: of both engines, and of rodas at looser accuracies.
        """
        looser = [self.runs.run(self._looser(equations, times), math.inf) for times in (1e2, 1e1)]
        runs = [*found.values(), *(one for one in looser if one is not None and one.finished)]
        spread, name = 0.0, ""
        for one, other in itertools.combinations(runs, 2):
            most = worst(self.errors(one, other), statistical=True)
            if most is not None and most.statistical > spread:
                spread, name = most.statistical, most.name
        label = f"{' and '.join(found)} at accuracy {self.runs.tight:g}"
        return Reference(label, found["rodas"], SCATTER * spread, name, sensitive=True)

    def converges(self, equations: Equations, first: Timed) -> bool:
        """Whether less tight runs are farther apart than tight ones; of two tight ones of the same engine."""
        runs = [self.runs.run(self._looser(equations, times), math.inf) for times in (1e2, 1e1)]
        if any(one is None or not one.finished for one in runs):
            return True
        far, near = (self.apart(one, first)[0] for one in runs if one is not None)
        return near <= AGREE or near < min(CONVERGING * far, LOST)

    def of_variant(self, equations: Equations, scene: Reference | None) -> Reference | None:
        """One tight run of other equations, known as well as the reference of the scene."""
        tight = self.runs.tightly(equations, "rodas")
        if tight is None or not tight.finished:
            self.complain(equations.label, tight)
            return None
        self.tell_ties(tight)
        spread, sensitive = (None, False) if scene is None else (scene.spread, scene.sensitive)
        return Reference(f"rodas at accuracy {self.runs.tight:g}", tight, spread, sensitive=sensitive)

    def tell_ties(self, timed: Timed) -> None:
        """Say that a reference is one of several solutions, where contacts leave open what follows."""
        said = f"The reference is one of several: {timed.ties}"
        if timed.ties and said not in self.remarks:
            self.remarks.append(said)

    def errors(self, one: Timed, other: Timed) -> list[OutputError]:
        """Every output of a run against another."""
        return output_errors(self.runs.names, self.units, one.values, other.values)

    def apart(self, one: Timed, other: Timed) -> tuple[float, str]:
        """How far two runs are from each other, and in which output."""
        found = worst(self.errors(one, other))
        return (found.relative, found.name) if found else (0.0, "")

    def complain(self, what: str, timed: Timed | None) -> None:
        """Say that a reference is missing, and why."""
        why = "the budget was used up before" if timed is None else timed.reason or timed.status
        said = f"No reference ({what}): {why}"
        if said not in self.remarks:
            self.remarks.append(said)
