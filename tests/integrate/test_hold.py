"""Held contacts: capture, hold, breakaway, networks; against closed forms."""

from __future__ import annotations

import numpy as np
import pytest

from fairlead.integrate import Run, Status, integrate
from fairlead.integrate.textbook import textbook
from tests.integrate.problems import belt_block, pulled_block, stick_slip_times


def expected_switches(count, **scene):
    first, slip, stick = stick_slip_times(**scene)
    return np.array([first + (k // 2) * (slip + stick) + (k % 2) * slip for k in range(count)])


@pytest.mark.parametrize(("method", "accuracy"), [("rodas5p", 1e-8), ("rodas3p", 1e-7)])
def test_a_block_on_a_belt_sticks_and_slips_at_the_times_of_the_closed_form(method, accuracy):
    problem = belt_block(absolute=[accuracy * 0.01, accuracy * 0.1, accuracy], relative=accuracy)
    outcome = integrate(problem, Run(stop=5.0, method=method))
    assert outcome.ok, outcome.sentence
    times = outcome.events["t"]
    np.testing.assert_allclose(times, expected_switches(len(times)), rtol=1e-6)
    assert len(times) == 12
    zones = outcome.events["after"].tolist()
    assert zones == [2, 0] * 6  # breaks backward relative to the belt, is caught again


def test_a_switch_costs_about_one_settling_pass_and_few_steps():
    problem = belt_block(absolute=[1e-6, 1e-5, 1e-4], relative=1e-4, guard_tolerance=1e-7)
    outcome = integrate(problem, Run(stop=20.0))
    assert outcome.counters.settling_passes == len(outcome.events)
    assert outcome.counters.steps <= 5 * len(outcome.events)


def test_a_held_block_does_not_creep():
    problem = belt_block(belt=0.0, start=(0.05, 0.0))
    outcome = integrate(problem, Run(stop=3600.0))
    assert outcome.ok, outcome.sentence
    assert np.abs(outcome.values[:, 1]).max() < 1e-12
    assert outcome.values[:, 0] == pytest.approx(0.05, abs=1e-12)
    assert outcome.y[2] == pytest.approx(5.0, rel=1e-12)  # the force of the spring, carried


def test_a_block_breaks_away_when_the_pull_reaches_stiction():
    problem, exact, breaks = pulled_block(absolute=1e-9, relative=1e-9)
    outcome = integrate(problem, Run(stop=2.0))
    np.testing.assert_allclose(outcome.events["t"], [breaks], rtol=1e-7)
    assert outcome.y[0] == pytest.approx(exact(2.0), rel=1e-6)


def test_a_capture_projects_the_speeds_and_conserves_momentum():
    problem = two_blocks(speeds=(3.0, 0.0), masses=(1.0, 2.0))
    outcome = integrate(problem, Run(stop=0.1))
    assert outcome.ok, outcome.sentence
    # The contact is given as held from the start: one impulse makes the speeds equal.
    assert outcome.values[0] == pytest.approx([1.0, 1.0, 0.0], abs=1e-14)


def two_blocks(speeds, masses):
    """Two free blocks held together: y = v1, v2, lambda."""

    def rhs(t, y, z, f):
        f[0], f[1], f[2] = -y[2], y[2], -1e3 * (y[1] - y[0])

    def jacobian(t, y, z, J, ft):
        J[0, 2], J[1, 2], J[2, 0], J[2, 1] = -1.0, 1.0, 1e3, -1e3

    def mass(z, M):
        M[0, 0], M[1, 1], M[2, 0], M[2, 1] = *masses, -1.0, 1.0

    def slip(t, y, z, r):
        r[2] = -(y[1] - y[0])
        return 1

    return textbook([*speeds, 0.0], rhs, jacobian, mass, slip=slip, algebraic=[2])


def chain_of_three(pull, stiction=(4.0, 2.0), sliding=(3.0, 1.5)):  # noqa: C901, one problem, all its laws
    """Blocks 1, 2, 3 of mass 1: contact a between 1 and 2, b between 2 and 3; 3 is pulled by `pull(t)`.

    y = v1, v2, v3, a, b; lambda_a pushes 2 back and 1 on. The friction of each contact opposes slip.
    """

    def rhs(t, y, z, f):
        f[0], f[1], f[2] = y[3], y[4] - y[3], pull(t) - y[4]
        for k in (0, 1):
            rate = y[k + 1] - y[k]
            f[3 + k] = -1e3 * rate if z[k] == 0 else y[3 + k] - (sliding[k] if z[k] == 1 else -sliding[k])

    def jacobian(t, y, z, J, ft):
        J[0, 3] = J[1, 4] = 1.0
        J[1, 3] = J[2, 4] = -1.0
        ft[2] = (pull(t + 1e-6) - pull(t - 1e-6)) / 2e-6
        for k in (0, 1):
            if z[k] == 0:
                J[3 + k, k + 1], J[3 + k, k] = -1e3, 1e3
            else:
                J[3 + k, 3 + k] = 1.0

    def mass(z, M):
        M[0, 0] = M[1, 1] = M[2, 2] = 1.0
        for k in (0, 1):
            if z[k] == 0:
                M[3 + k, k + 1], M[3 + k, k] = 1.0, -1.0

    def guards(t, y, z, g):
        for k in (0, 1):
            rate = y[k + 1] - y[k]
            g[3 * k : 3 * k + 3] = -1.0
            if z[k] == 0:
                g[3 * k], g[3 * k + 1] = y[3 + k] - stiction[k], -y[3 + k] - stiction[k]
            else:
                g[3 * k + 2] = -rate if z[k] == 1 else rate

    def switch(t, y, z, fired):
        for guard in fired:
            k, which = divmod(int(guard), 3)
            z[k] = (1, 2, 0)[which]

    def slip(t, y, z, r):
        for k in (0, 1):
            if z[k] == 0:
                r[3 + k] = -(y[k + 1] - y[k])
        return int((z == 0).sum())

    return textbook(
        np.zeros(5), rhs, jacobian, mass, guards=guards, switch=switch, slip=slip, zones=[0, 0],
        guard_machine=[0, 0, 0, 1, 1, 1], algebraic=[3, 4], machine_names=["a", "b"],
        zone_names={0: ("held", "forward", "backward"), 1: ("held", "forward", "backward")},
        absolute=1e-9, relative=1e-9, guard_tolerance=1e-10,
    )  # fmt: skip


def test_two_held_contacts_share_a_pull_by_the_masses_they_drag():
    outcome = integrate(chain_of_three(lambda t: t), Run(stop=1.0))
    # All move together: a = t/3; contact b drags two masses, contact a one.
    assert outcome.y == pytest.approx([1 / 6, 1 / 6, 1 / 6, 1 / 3, 2 / 3], abs=1e-9)


def test_the_weaker_of_two_held_contacts_breaks_at_its_own_limit_and_the_other_holds_on():
    outcome = integrate(chain_of_three(lambda t: t), Run(stop=4.0))
    # b carries 2 t/3 and breaks at 2 N, t = 3; then 1 and 2 go on with its sliding force 1.5 N.
    assert outcome.events["machine"].tolist() == [1]
    np.testing.assert_allclose(outcome.events["t"], [3.0], rtol=1e-9)
    assert outcome.y[3] == pytest.approx(0.75, rel=1e-9)
    assert outcome.y[0] == pytest.approx(1.5 + 0.75, rel=1e-8)
    assert outcome.y[2] == pytest.approx(1.5 + (16 - 9) / 2 - 1.5, rel=1e-8)


@pytest.mark.slow
def test_contacts_that_both_slip_are_captured_one_after_the_other():
    # Pulled for 4 s (both slip), then let go: momentum 1 is kept and all end at one speed.
    outcome = integrate(chain_of_three(lambda t: 30.0 if t < 1 else 0.0), Run(stop=30.0, max_step=0.01))
    assert outcome.ok, outcome.sentence
    total = outcome.values[:, :3].sum(axis=1)[-1]
    assert outcome.y[:3] == pytest.approx([total / 3] * 3, rel=1e-9)
    assert outcome.events["after"][-1] == 0


def test_zones_without_a_consistent_choice_are_reported_as_a_cycle():
    def rhs(t, y, z, f):
        f[0] = 1.0

    def guards(t, y, z, g):
        g[0] = y[0] - 0.5

    def switch(t, y, z, fired):
        z[0] = 1 - z[0]

    problem = textbook(
        [0.0], rhs, lambda *_: None, guards=guards, switch=switch, zones=[0], guard_machine=[0],
        machine_names=["pad_1"], zone_names={0: ("stuck", "forward")}, guard_tolerance=0.0,
    )  # fmt: skip
    outcome = integrate(problem, Run(stop=1.0, max_passes=20))
    assert outcome.status == Status.NOT_SETTLED
    assert outcome.t == pytest.approx(0.5)
    assert outcome.culprits == ("pad_1",)
    assert "did not settle in 20 passes" in outcome.sentence
    assert "pad_1 (stuck <-> forward)" in outcome.sentence or "pad_1 (forward <-> stuck)" in outcome.sentence


def test_two_runs_give_bitwise_the_same_result():
    runs = [integrate(belt_block(), Run(stop=5.0, every=0.01)) for _ in range(2)]
    assert runs[0].values.tobytes() == runs[1].values.tobytes()
    assert runs[0].events.tobytes() == runs[1].events.tobytes()
