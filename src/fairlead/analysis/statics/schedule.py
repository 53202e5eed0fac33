"""What a speed given in time implies: stretches of steady speed, the way gone, accelerations."""

from __future__ import annotations

import functools
import itertools
import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from fairlead.brief import in_a_line
from fairlead.component.piecewise import PiecewisePolynomial, Sine, linear_table
from fairlead.component.values import Wave, steady

STILL = 1e-9  # m/s; less is rest
LOOKS = 2001  # instants at which a speed without steady stretches is looked at


@dataclass(frozen=True)
class Stretch:
    """A time in which the speed [m/s] does not change."""

    begin: float
    end: float
    speed: float


@dataclass(frozen=True)
class Schedule:
    """A speed over the time of a run; `by` says who gives it."""

    __repr__ = in_a_line

    wave: Wave
    begin: float
    end: float
    by: str = ""

    def speed(self, t: float) -> float:
        """Speed [m/s]."""
        return self.wave(t)

    def way(self, t: float) -> float:
        """Way since the begin [m]."""
        path, sine = self._path, self.wave.sine
        if not sine.amplitude:
            return path(t)
        swing = [math.cos(sine.omega * at + sine.phase) for at in (self.begin, t)]
        return path(t) + sine.amplitude / sine.omega * (swing[0] - swing[1])

    @functools.cached_property
    def _path(self) -> PiecewisePolynomial:
        return self.wave.polynomial.integral(self.begin)

    def stretches(self) -> list[Stretch]:
        """All of them, in order; a speed that swings has none."""
        found: list[Stretch] = []
        for begin, end, row in self._pieces() if not self.wave.sine.amplitude else ():
            if row[4:].any():
                continue
            if found and found[-1].end == begin and found[-1].speed == row[3]:
                begin = found.pop().begin
            found.append(Stretch(begin, end, float(row[3])))
        return found

    def steady(self, sign: int) -> Stretch | None:
        """The stretch that stands for a direction: the fastest, and the longest of those; 0: rest.

        Without a steady one, the instant at which the speed is greatest.
        """
        here = [one for one in self.stretches() if _sign(one.speed) == sign]
        if here:
            return max(here, key=lambda one: (round(abs(one.speed), 9), one.end - one.begin))
        if sign == 0:
            return Stretch(self.begin, self.begin, 0.0) if abs(self.speed(self.begin)) <= STILL else None
        t, speed = max(self._looks(sign), key=lambda one: sign * one[1])
        return Stretch(t, t, speed) if sign * speed > STILL else None

    def _looks(self, sign: int) -> Iterator[tuple[float, float]]:
        """The instant of every piece at which the speed is greatest in a direction."""
        sine = self.wave.sine
        for begin, end, row in self._pieces():
            t = np.linspace(begin, end, LOOKS if row[5:].any() or sine.amplitude else 2)
            speed = np.polynomial.polynomial.polyval(t - row[2], row[3:]) + sine.amplitude * np.sin(
                sine.omega * t + sine.phase
            )
            k = int((sign * speed).argmax())
            yield float(t[k]), float(speed[k])

    def furthest(self, sign: int) -> float | None:
        """The instant of a steady stretch at which most line is out; None when the speed never has that sign."""
        stretch = self.steady(sign)
        if stretch is None:
            return None
        rests = [one for one in self.stretches() if _sign(one.speed) == sign] if sign == 0 else []
        ends = [t for one in (rests or [stretch]) for t in (one.begin, one.end)]
        if sign == 0 and abs(self.speed(self.begin)) <= STILL:
            ends.append(self.begin)
        return max(ends, key=lambda t: round(self.way(t), 6))

    def accelerations(self) -> Iterator[tuple[float, float, float]]:
        """(t, speed, acceleration) at both ends of every piece in which the speed changes; steps are left out."""
        swing = self.wave.sine.amplitude * self.wave.sine.omega
        for begin, end, row in self._pieces():
            for t in (begin, end) if row[4:].any() or swing else ():
                slope = np.polynomial.polynomial.polyval(t - row[2], row[4:] * np.arange(1, len(row) - 3))
                yield t, self.speed(t), float(slope) + math.copysign(swing, slope or 1.0)

    def _pieces(self) -> Iterator[tuple[float, float, np.ndarray]]:
        for row in self.wave.polynomial.rows:
            begin, end = max(float(row[0]), self.begin), min(float(row[1]), self.end)
            if end > begin:
                yield begin, end, row


def scaled(wave: Wave, factor: float, offset: float = 0.0) -> Wave:
    """The wave factor * wave + offset."""
    rows = wave.polynomial.rows.copy()
    rows[:, 3:] *= factor
    rows[:, 3] += offset
    sine = wave.sine
    return Wave(PiecewisePolynomial(rows), Sine(sine.amplitude * factor, sine.omega, sine.phase))


def followed(wave: Wave, most: float, begin: float, end: float) -> Wave:
    """What follows a wave from zero at `begin`, at a rate of at most `most`: straight lines until `end`."""
    corners = [float(t) for t in wave.polynomial.rows[1:, 0] if begin < t < end]
    straight = not (wave.polynomial.rows[:, 5:].any() or wave.sine.amplitude)
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


def rate(wave: Wave) -> Wave:
    """The derivative of a wave."""
    sine = wave.sine
    swing = Sine(sine.amplitude * sine.omega, sine.omega, sine.phase + math.pi / 2)
    return Wave(wave.polynomial.derivative(), swing)


def _sign(speed: float) -> int:
    return 0 if abs(speed) <= STILL else int(math.copysign(1, speed))
