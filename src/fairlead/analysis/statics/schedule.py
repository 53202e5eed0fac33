"""What a speed given in time implies: stretches of steady speed, the way gone, accelerations."""

from __future__ import annotations

import functools
import itertools
import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from fairlead.brief import in_a_line
from fairlead.component.piecewise import FAR, horner, linear_table
from fairlead.component.values import Wave, steady

STILL = 1e-9  # m/s; less is rest
INSIDE = 1e-6  # share of a piece by which an instant beside its end is inside
LOOKS = 2001  # instants at which a speed without steady stretches is looked at


@dataclass(frozen=True)
class Stretch:
    """A time in which the speed [m/s] does not change."""

    begin: float
    end: float
    speed: float


@dataclass(frozen=True)
class Schedule:
    """A speed over the time of a run; `by` says who gives it, and `drum` how fast that turns if its layers change."""

    __repr__ = in_a_line

    wave: Wave
    begin: float
    end: float
    by: str = ""
    drum: Wave | None = None

    def speed(self, t: float) -> float:
        """Speed [m/s]."""
        return self.wave(t)

    def way(self, t: float) -> float:
        """Way since the begin [m]."""
        return self._path(t)

    @functools.cached_property
    def _path(self) -> Wave:
        return self.wave.integral(self.begin)

    def stretches(self) -> list[Stretch]:
        """All of them, in order; a speed that swings has none."""
        found: list[Stretch] = []
        for begin, end, row in self._pieces() if not self.wave.is_swinging else ():
            if row[4:].any():
                continue
            if found and found[-1].end == begin and found[-1].speed == row[3]:
                begin = found.pop().begin
            found.append(Stretch(begin, end, float(row[3])))
        return found

    def steady(self, sign: int) -> Stretch | None:
        """The stretch that stands for a direction: the fastest, and the longest of those; 0: rest.

        Without a steady stretch, the instant at which the speed is greatest.
        """
        here = [one for one in self.stretches() if _sign(one.speed) == sign]
        if here:
            return max(here, key=lambda one: (round(abs(one.speed), 9), one.end - one.begin))
        if sign == 0:
            return Stretch(self.begin, self.begin, 0.0) if abs(self.speed(self.begin)) <= STILL else None
        t, speed = max(self._looks(sign), key=lambda one: sign * one[1])
        return Stretch(t, t, speed) if sign * speed > STILL else None

    def layers(self, sign: int) -> list[Stretch]:
        """Stretches in which a drum turns fastest in a direction, one for each layer that it pays out or takes up."""
        if self.drum is None:
            return []
        here = [one for one in self.stretches() if _sign(one.speed) == sign]
        turns = [round(abs(self.drum((one.begin + one.end) / 2)), 9) for one in here]
        return [one for one, turn in zip(here, turns, strict=True) if turn == max(turns)]

    def _looks(self, sign: int) -> Iterator[tuple[float, float]]:
        """The instant of every piece at which the speed is greatest in a direction."""
        for begin, end, row in self._pieces():
            t = np.linspace(begin, end, LOOKS if row[5:].any() or self.wave.is_swinging else 2)
            speed = horner(row[3:], t - row[2])
            for part in self.wave.parts:
                k = part.polynomial.piece_at((begin + end) / 2)
                size = horner(part.polynomial.rows[k, 3:], t - part.polynomial.rows[k, 2])
                speed = speed + size * np.sin(part.omega * t + part.phase)
            k = int((sign * speed).argmax())
            yield float(t[k]), float(speed[k])

    def furthest(self, sign: int) -> float | None:
        """The instant of a steady stretch at which most line is out; None when the speed never has that sign."""
        stretch = self.steady(sign)
        if stretch is None:
            return None
        rests = [one for one in self.stretches() if _sign(one.speed) == sign] if sign == 0 else []
        return self.most_out(sign, *(rests or [stretch]))

    def most_out(self, sign: int, *stretches: Stretch) -> float:
        """The instant at an end of some stretches at which most line is out."""
        ends = [t for one in stretches for t in (one.begin, one.end)]
        if sign == 0 and abs(self.speed(self.begin)) <= STILL:
            ends.append(self.begin)
        return max(ends, key=lambda t: round(self.way(t), 6))

    def accelerations(self) -> Iterator[tuple[float, float, float]]:
        """(t, speed, acceleration) at both ends of every piece in which the speed changes; steps are left out.

        Where the piece comes to rest, or begins at rest, the least speed in the direction in which it moves there. Of a
        speed that swings the largest acceleration of each sense, in each direction of the speed.
        """
        if self.wave.is_swinging:
            yield from self._largest()
            return
        for begin, end, row in self._pieces():
            inside = INSIDE * (end - begin)
            for t, near in ((begin, begin + inside), (end, end - inside)) if row[4:].any() else ():
                rate = float(horner(row[4:] * np.arange(1, len(row) - 3), t - row[2]))
                yield t, _moving(self.speed(t), self.speed(near)), rate

    def _largest(self) -> Iterator[tuple[float, float, float]]:
        change, times = self.wave.derivative(), np.linspace(self.begin, self.end, LOOKS).tolist()
        looks = [(t, self.speed(t), change(t)) for t in times]
        for sense, way in itertools.product((1, -1), (1, -1)):
            here = [one for one in looks if sense * one[2] > 0 and way * one[1] >= 0]
            if here:
                t, speed, rate = max(here, key=lambda one: round(abs(one[2]), 12))
                yield t, _moving(speed, way), rate

    def _pieces(self) -> Iterator[tuple[float, float, np.ndarray]]:
        """Times between two borders, with the row of the pieces that do not swing."""
        path = self.wave.polynomial
        borders = [-FAR, *self.wave.borders, FAR]
        for left, right in itertools.pairwise(borders):
            begin, end = max(left, self.begin), min(right, self.end)
            if end > begin:
                yield begin, end, path.rows[path.piece_at((begin + end) / 2)]


def followed(wave: Wave, most: float, begin: float, end: float) -> Wave:
    """What follows a wave from zero at `begin`, at a rate of at most `most`: straight lines until `end`."""
    corners = [t for t in wave.borders if begin < t < end]
    straight = not (wave.polynomial.rows[:, 5:].any() or wave.is_swinging)
    looks = [] if straight else np.linspace(begin, end, LOOKS).tolist()
    borders = sorted({begin, end, *corners, *looks})
    times, values = [begin], [0.0]
    for left, right in itertools.pairwise(borders):
        first, last = _just(wave, left, right)
        slope, t, y = (last - first) / (right - left), left, values[-1]
        sense = math.copysign(most, first - y if first != y else slope)
        closing = sense - slope
        meets = left + (first - y) / closing if closing else math.inf
        if y != first or abs(slope) > most:  # it is behind, or is left behind
            t = right if not left < meets < right else meets
            y += sense * (t - left)
            times, values = [*times, t], [*values, y]
        if t < right:
            y = last if abs(slope) <= most else y + math.copysign(most, slope) * (right - t)
            times, values = [*times, right], [*values, y]
    return Wave(linear_table(times, values)) if len(times) > 1 else steady(0.0)


def _just(wave: Wave, left: float, right: float) -> tuple[float, float]:
    """Values just right of one border and just left of the next."""
    tiny = 1e-9 * (right - left)
    return wave(left + tiny), wave(right - tiny)


def _moving(speed: float, way: float) -> float:
    """The speed, or the least one that is no rest, in the direction of `way`."""
    return speed if abs(speed) > STILL else math.copysign(2 * STILL, way)


def _sign(speed: float) -> int:
    return 0 if abs(speed) <= STILL else int(math.copysign(1, speed))
