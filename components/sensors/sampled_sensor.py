"""A sensor with a sampler: noise and a step of its numbers, as a converter gives them."""

import math

from fairlead.components.sensors.signal_lag import PerfectSignal

from fairlead.component import Controller, Count, Effect, Input, Output, Parameter

MASK = (1 << 64) - 1


class SampledSensor(Controller):
    """A sensor that measures once every `period`, with noise and a limited resolution, and holds its reading.

    signal = the multiple of `resolution` nearest to (value + noise xi_k),  halves upward

    xi_k is normal with mean 0 and variance 1, and depends on `seed` and the number k of the sample alone: the same
    seed gives the same noise, bit by bit, whatever engine and steps are taken. All sensors have the same seed unless
    you give another one, and then the same noise: give each sensor its own. Without `noise` there is no noise, without
    `resolution` no rounding. The first sample is taken at the start.

    Source of the numbers: two outputs of SplitMix64 (Steele, Lea and Flood 2014, OOPSLA, DOI 10.1145/2660193.2660195)
    through the transform of Box and Muller (1958), DOI 10.1214/aoms/1177706645.

    Limits: no lag (put a SignalLag before it), and no jitter of the samples.
    """

    passes = "value"
    value = Input("1", "Measured quantity.", signed=True)
    sampling = Effect("The sensor works in samples; off: its signal is the value at every time.", off=PerfectSignal)
    noise = Parameter("1", "Standard deviation of the noise.", default=None, above=0, like="value")
    resolution = Parameter("1", "Smallest step of the reading.", default=None, above=0, like="value")
    seed = Count("Seed of the noise.", default=1, least=0)
    signal = Output("1", "Reading of the sensor.", like="value")

    def begin(self):
        """No sample is taken yet."""
        self.taken = 0

    def sample(self, value):
        """One sample."""
        told = value
        if self.noise is not None:
            told += self.noise * normal(self.seed, self.taken)
        if self.resolution is not None:
            told = self.resolution * math.floor(told / self.resolution + 0.5)
        self.taken += 1
        return told


def normal(seed: int, number: int) -> float:
    """Sample `number` of the normal noise of a seed; mean 0, variance 1."""
    start = mixed(seed)
    one, two = (mixed(start + 2 * number + k) >> 11 for k in (0, 1))  # 53 bits each
    radius = math.sqrt(-2.0 * math.log((one + 1) * 2.0**-53))
    return radius * math.cos(2.0 * math.pi * two * 2.0**-53)


def mixed(number: int) -> int:
    """The output of SplitMix64 after `number` + 1 steps from zero: 64 bits."""
    z = (number + 1) * 0x9E3779B97F4A7C15 & MASK
    z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9 & MASK
    z = (z ^ z >> 27) * 0x94D049BB133111EB & MASK
    return z ^ z >> 31
