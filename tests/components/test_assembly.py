"""The assembled system of every bundled model: its Jacobian against differences, M against its definition."""

import numpy as np
import pytest

import fairlead
from fairlead.netlist.files import bundled_models
from fairlead.system.compiled.build import HOLD_TIME
from tests.callbacks import Called, differences

SIZES = {"m": 1e-2, "m/s": 0.1, "N": 10.0, "Pa": 1e5}  # of the random states; as large as what moves in these scenes
STEP = 1e-6  # of the sizes above: truncation and rounding of a central difference are then alike, about 1e-9
AGREES = 1e-6  # of the largest entry in the row: a misplaced or missing entry is off by all of it


def close_by_rows(have, want):
    scale = np.maximum(np.abs(want).max(axis=-1, keepdims=True), np.abs(have).max(axis=-1, keepdims=True))
    return np.abs(have - want) <= AGREES * np.maximum(scale, 1.0)


# The guidance route with more or other numbers, or with simpler drives.
TOO_LONG = {"long_deployment", "long_route", "slack_start", "weak_clamp", "guidance_route_ideal"}


@pytest.fixture(scope="module", params=sorted(set(bundled_models()) - TOO_LONG))
def system(request):
    return fairlead.load(request.param).system.instance()


def random_points(system, count):
    """Random zones of every machine, random unknowns near the start, random times."""
    rng = np.random.default_rng(20240607)
    sizes = np.array([SIZES.get(unknown.unit, 1.0) for unknown in system.numbering.unknowns])
    zones = [len(names) for names in system.machine_zones]
    for _ in range(count):
        system.zones[: len(zones)] = [rng.integers(k) for k in zones]
        yield float(rng.uniform(0, 5)), system.initial + sizes * rng.uniform(-1, 1, system.n), STEP * sizes


def test_the_jacobian_equals_differences_in_random_zone_patterns(system):
    called = Called(system)
    for t, y, steps in random_points(system, 5):
        have, ft = called.jacobian(t, y)
        want = differences(lambda at, t=t: called.rhs(t, at), y, steps)
        rounding = np.outer(np.abs(called.rhs(t, y)), np.finfo(float).eps / steps)  # of the differences
        wrong = np.argwhere(~close_by_rows(have, want) & (np.abs(have - want) > 2 * rounding))
        names = system.unknown_names
        assert [(names[i], names[j], have[i, j], want[i, j]) for i, j in wrong[:5]] == []
        h = 1e-6
        slope = (called.rhs(t + h, y) - called.rhs(t - h, y)) / (2 * h)
        rounding = np.abs(called.rhs(t, y)) * np.finfo(float).eps / h  # of the difference: some powers are 1e11 W here
        assert (close_by_rows(ft, slope) | (np.abs(ft - slope) <= 2 * rounding)).all()


def held_rows(system):
    """Rows of the contacts that hold in the zones in force; relations of positions are rows of accelerations."""
    for block in system.blocks:
        s = block.kernel.structure
        for unknown, zones in s.holds.items():
            for i, instance in enumerate(block.instances):
                zone = s.zones[system.zones[block.machines[i, 0]] if len(s.zones) > 1 else 0]
                if zone in zones and unknown not in s.positions:
                    yield system.numbering.own[instance.path, unknown]


def test_the_mass_matrix_holds_inertias_and_the_slip_of_held_contacts(system):
    """M v' is the inertia of a balance and, where f says -slip/tau, the rate of that slip."""
    called = Called(system)
    masses = np.array([unknown.mass if unknown.differential else 0.0 for unknown in system.numbering.unknowns])
    for t, y, steps in random_points(system, 5):
        want, held = np.diag(masses), list(held_rows(system))
        slopes = differences(lambda at, t=t: called.rhs(t, at), y, steps)
        want[held] = -HOLD_TIME * slopes[held] * system.differential  # contacts of a circle share forces beside
        assert np.allclose(called.mass(), want, atol=1e-7)


def test_only_unknowns_with_a_rate_have_a_column_in_the_mass_matrix(system):
    for _ in random_points(system, 3):
        columns = np.abs(Called(system).mass()).max(axis=0) > 0
        assert not columns[~system.differential].any()
        assert columns[system.differential].all()
