"""Every treatment of friction against closed forms, published figures and solutions of its own equations.

The block of the stick-slip table is that of physics section 1.8: 1 kg pulled over the floor at 0.05 m/s through
100 N/m, 10 N of normal force, friction that falls from 5 N to 3 N exponentially (Tustin) within 5 mm/s.
The LuGre numbers are those of Canudas de Wit, Olsson, Astrom, Lischinsky (1995).
"""

import itertools
import json
import math
import textwrap

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from typer.testing import CliRunner

import fairlead
from fairlead.cli import app
from fairlead.component.registry import known_types

NORMAL, STATIC, KINETIC, FALL = 10.0, 0.5, 0.3, 5e-3
STIFFNESS, DRIVE = 100.0, 0.05

PULLED = """
    parameters: {method: hold}
    components:
      ground: {type: Ground}
      block: {type: Mass, mass: 1 kg}
      pad:
        type: Contact
        method: "{method}"
        normal_force: 10 N
        curve: {curve: tustin, stiction: 0.5, coulomb: 0.3, velocity: 5 mm/s}
      spring: {type: Spring, stiffness: 100 N/m}
      pull: {type: MotionSource, velocity: 0.05 m/s}
    connections: [[ground.flange, pad.a], [pad.b, block.flange, spring.a], [spring.b, pull.flange]]
    run: {stop: 6 s, accuracy: 1e-6}
"""

PUSHED = """
    parameters: {method: hold, load: 4.95 N, speed: 0 m/s}
    components:
      ground: {type: Ground}
      block: {type: Mass, mass: 1 kg, velocity: "{speed}"}
      pad: {type: Contact, method: "{method}", normal_force: 10 N, curve: 0.5}
      push: {type: ForceSource, force: {ramp: {to: "{load}", over: 1 s}}}
    connections: [[ground.flange, pad.a], [pad.b, block.flange, push.flange]]
    run: {stop: 3600 s, accuracy: 1e-6}
"""

LUGRE = """
    parameters: {stop: 1 s, presliding: 15 um, relaxation: 3.16227766 ms}
    components:
      ground: {type: Ground}
      block: {type: Mass, mass: 1 kg}
      pad:
        type: Contact
        method: lugre
        presliding: "{presliding}"
        relaxation: "{relaxation}"
        viscous: 0.4 N*s/m
        normal_force: 1 N
        curve: {curve: stribeck, stiction: 1.5, coulomb: 1.0, velocity: 1 mm/s}
      push: {type: ForceSource, force: FORCE}
    connections: [[ground.flange, pad.a], [pad.b, block.flange, push.flange]]
    run: {stop: "{stop}", accuracy: 1e-7}
"""


@pytest.fixture
def simulate(tmp_path):
    """simulate(text, **{"pad.creep": ...}) -> Result."""

    def run(text, **settings):
        path = tmp_path / "scene.yaml"
        path.write_text("schema: 1\nname: scene\n" + textwrap.dedent(text), encoding="utf-8")
        chosen = {name.replace("__", "."): str(value) for name, value in settings.items()}
        return fairlead.load(path, set=chosen).run(out=tmp_path / "run", force=True, check=False)

    return run


def settings(method, **given):
    """Settings for `simulate`: the method, and parameters of the pad."""
    return {"method": method, **{f"pad.{name}": value for name, value in given.items()}}


# Stick-slip


def exact_period():
    """The set-valued law: slip by a tight integration until the block stands again, stick in closed form."""

    def slipping(t, y):
        v, pull = y
        friction = NORMAL * (KINETIC + (STATIC - KINETIC) * np.exp(-v / FALL))
        return [pull - friction, STIFFNESS * (DRIVE - v)]

    def stands(t, y):
        return y[0] if t > 1e-2 else 1.0

    stands.terminal, stands.direction = True, -1
    # At rest the curve falls faster than any damping: a slip of 1e-12 m/s grows by itself.
    end = solve_ivp(slipping, (0, 2), [1e-12, NORMAL * STATIC], rtol=1e-11, atol=1e-14, events=stands, method="LSODA")
    (time,), (state,) = end.t_events[0], end.y_events[0]
    return time + (NORMAL * STATIC - state[1]) / (STIFFNESS * DRIVE)


def reset_period(presliding, relaxation):
    """The two laws of the reset integrator, from event to event by another library; the mean of later periods."""
    stiffness = NORMAL * STATIC / presliding

    def rates(t, y, slides):
        v, z, pull = y
        spring = stiffness * (z + relaxation * v)
        friction = NORMAL * (KINETIC + (STATIC - KINETIC) * np.exp(-abs(v) / FALL)) if slides else spring
        return [pull - friction, 0.0 if slides else v, STIFFNESS * (DRIVE - v)]

    def slopes(t, y, slides):
        falling = NORMAL * (KINETIC - STATIC) / FALL * np.sign(y[0]) * np.exp(-abs(y[0]) / FALL)
        by_speed, by_deflection = (falling, 0.0) if slides else (stiffness * relaxation, stiffness)
        return [[-by_speed, -by_deflection, 1.0], [0.0 if slides else 1.0, 0.0, 0.0], [-STIFFNESS, 0.0, 0.0]]

    def breaks(t, y, slides):
        return y[1] - presliding

    def stops(t, y, slides):
        return y[0]

    breaks.terminal, breaks.direction, stops.terminal, stops.direction = True, 1, True, -1
    t, y, slides, breakaways = 0.0, [0.0, 0.0, 0.0], False, []
    while len(breakaways) < 5:
        ends = (stops if slides else breaks,)
        how = {"method": "Radau", "jac": slopes, "rtol": 1e-9, "atol": 1e-13}
        run = solve_ivp(rates, (t, t + 5), y, args=(slides,), events=ends, **how)
        t, y = run.t[-1], run.y[:, -1]
        breakaways += [] if slides else [t]
        slides = not slides
    return float(np.diff(breakaways[1:]).mean())


def period(result):
    """Mean time between break-aways: the slip rises through two fifths of the drive speed, interpolated."""
    level, v, t = 0.4 * DRIVE, result["pad.slip"], result.t
    k = np.flatnonzero((v[:-1] < level) & (v[1:] >= level))
    times = t[k] + (level - v[k]) / (v[k + 1] - v[k]) * (t[k + 1] - t[k])
    assert len(times) >= 4
    return float(np.diff(times[1:]).mean())


# The table of physics section 2, from computations apart from fairlead; 1 % is what was asked for.
PERIODS = [
    ("hold", {}, 1.1863),
    ("karnopp", {"band": "1e-4 m/s"}, 1.189),
    ("tanh", {"creep": "1e-4 m/s"}, 1.1398),
    ("tanh", {"creep": "1e-5 m/s"}, 1.1804),
    ("arctan", {"creep": "1e-5 m/s"}, 1.1141),
    ("lugre", {"presliding": "50 um", "relaxation": "3.16227766 ms"}, 1.036),
    ("binding", {"creep": "1e-5 m/s"}, 1.1827),
]


@pytest.mark.parametrize(("method", "given", "published"), PERIODS, ids=lambda x: str(x))
def test_the_period_of_stick_slip_is_the_published_one(simulate, method, given, published):
    assert period(simulate(PULLED, **settings(method, **given))) == pytest.approx(published, rel=0.01)


def test_exact_hold_has_the_period_of_the_set_valued_law(simulate):
    assert period(simulate(PULLED)) == pytest.approx(exact_period(), rel=1e-5)


@pytest.mark.parametrize(("presliding", "relaxation"), [(500e-6, 10e-3), (100e-6, 2e-3), (300e-6, 10e-3)])
def test_the_reset_integrator_has_the_period_of_its_own_equations(simulate, presliding, relaxation):
    given = {"presliding": f"{presliding} m", "relaxation": f"{relaxation} s"}
    result = simulate(PULLED, **settings("reset_integrator", **given))
    assert period(result) == pytest.approx(reset_period(presliding, relaxation), rel=1e-3)


@pytest.mark.parametrize(
    ("method", "coarse", "fine"),
    [
        ("karnopp", {"band": "1e-4 m/s"}, {"band": "1e-6 m/s"}),
        ("saturation", {"creep": "1e-4 m/s"}, {"creep": "1e-6 m/s"}),
        ("root", {"creep": "1e-4 m/s"}, {"creep": "1e-6 m/s"}),
        ("reset_integrator", {"presliding": "500 um"}, {"presliding": "5 um"}),
    ],
)
def test_a_treatment_tends_to_the_set_valued_law_as_its_tolerance_goes_to_zero(simulate, method, coarse, fine):
    far, near = (abs(period(simulate(PULLED, **settings(method, **g))) - exact_period()) for g in (coarse, fine))
    assert near < 0.5 * far
    assert near < 0.01 * exact_period()


# Holding

SECONDS = 3600.0
# (method, its own number, creep at 99 % of its holding capacity; each capacity is F_s = N mu = 5 N here)
HOLDING = [
    ("tanh", {"creep": "1e-5 m/s"}, 1e-5 * math.atanh(0.99)),
    ("arctan", {"creep": "1e-6 m/s"}, 1e-6 * math.tan(math.pi / 2 * 0.99)),
    ("root", {"creep": "1e-5 m/s"}, 1e-5 * 0.99 / math.sqrt(1 - 0.99**2)),
    ("saturation", {"creep": "1e-5 m/s"}, 1e-5 * 0.99),
    ("binding", {"creep": "1e-5 m/s"}, 0.99e-5 / 1.25),
    ("hold", {}, 0.0),
    ("karnopp", {}, 0.0),
    ("reset_integrator", {}, 0.0),
    ("dahl", {}, 0.0),
    ("lugre", {}, 0.0),
    ("elastoplastic", {}, 0.0),
    ("bristle", {"viscous": "500 N*s/m"}, 0.0),  # or it rings
]


@pytest.mark.parametrize(("method", "given", "creep"), HOLDING, ids=lambda x: x if isinstance(x, str) else "")
def test_a_block_held_at_99_percent_for_an_hour_creeps_as_the_formula_says(simulate, method, given, creep):
    result = simulate(PUSHED, **settings(method, **given))
    assert result.status == "finished", result.run["sentence"]
    # Zero means rounding of 5 N on 1 kg; the rest is solved to 1e-6, with a steep inverse near the capacity.
    assert result["pad.slip"][-1] == pytest.approx(creep, rel=2e-3, abs=1e-10)
    if creep:
        moved = result["block.x"][-1] - result["block.x"][0]
        assert moved == pytest.approx(creep * SECONDS, rel=3e-3)
        assert result.run["worst_creep"]["value"] == pytest.approx(creep, rel=1e-2)


def test_the_table_and_the_report_of_a_run_tell_the_creep(tmp_path):
    """An hour at 99 % of binding's capacity: 0.99 creep/1.25, in the closing table, in run.json and in report.html."""
    scene, out = tmp_path / "scene.yaml", tmp_path / "out"
    scene.write_text("schema: 1\nname: scene\n" + textwrap.dedent(PUSHED), encoding="utf-8")
    given = ["--set", "method=binding", "--set", "pad.creep=1e-5 m/s"]
    said = CliRunner().invoke(app, ["run", str(scene), "--out", str(out), "--report", *given])
    assert said.exit_code == 0, said.output
    assert "7.92e-06 m/s in pad" in said.output
    assert "7.92" in (out / "report.html").read_text(encoding="utf-8")
    assert json.loads((out / "run.json").read_text())["worst_creep"]["value"] == pytest.approx(7.92e-6, rel=1e-3)


@pytest.mark.parametrize("method", ["naive_sign", "naive_zone"])
def test_a_treatment_that_holds_nothing_says_so(method, tmp_path):
    """Those without a holding capacity are not asked to hold for an hour: `fairlead friction` says that they do not."""
    said = CliRunner().invoke(app, ["friction", "0.5", "--method", method, "--out", str(tmp_path)])
    assert said.exit_code == 0, said.output
    assert f"none: method {method} has no sticking" in said.output
    assert "creep" not in said.output


@pytest.mark.parametrize("method", ["dahl", "lugre"])
def test_bristles_under_a_slow_load_bend_by_a_logarithm(simulate, method):
    """dz/dx = 1 - z/presliding, so x = -presliding ln(1 - load/F_s)."""
    damped = settings(method, presliding="20 um", viscous="500 N*s/m")  # or it rings, and drifts with every ring
    result = simulate(PUSHED, **damped, load="4 N", **{"run.stop": "3 s"})
    assert result["block.x"][-1] == pytest.approx(-20e-6 * math.log(1 - 0.8), rel=1e-3)


def test_elastoplastic_bristles_give_back_all_displacement_below_the_elastic_limit(simulate):
    text = PUSHED.replace(
        '{ramp: {to: "{load}", over: 1 s}}', "{trapezoid: {to: 3.4 N, rise: 1 s, stay: 1 s, fall: 1 s}}"
    )
    for method, permanent in (("elastoplastic", 0.0), ("lugre", 1.0)):
        result = simulate(text, **settings(method, presliding="20 um"), **{"run.stop": "4 s"})
        bent, left = result["block.x"].max(), abs(result["block.x"][-1])
        assert bent > 13e-6  # 3.4 N of 5 N bend elastic bristles by 13.6 um
        assert (left > 1e-6) == bool(permanent), (method, left)


# Sliding

SLIDING = [method for method, _, _ in HOLDING if method != "bristle"]  # its noise: test_bristle.py


@pytest.mark.parametrize("method", SLIDING)
def test_a_sliding_block_stops_at_the_closed_form_distance(simulate, method):
    small = {"creep": "1e-6 m/s"} if method in ("tanh", "arctan", "root", "saturation", "binding") else {}
    bristles = method in ("dahl", "lugre", "elastoplastic", "reset_integrator")
    text = PUSHED + ("    initial: {pad.z: 20 um}\n" if bristles else "")  # bent as sliding bends them
    result = simulate(text, **settings(method, **small), load="0 N", speed="0.3 m/s", **{"run.stop": "0.5 s"})
    distance = 0.3**2 / (2 * 5.0)
    # Bristles stop within 20 um of it. Arctan lacks 2/pi creep/v of its force.
    allowed = 20e-6 if bristles else 2e-6
    assert result["block.x"].max() == pytest.approx(distance, abs=allowed)
    assert abs(result["pad.slip"][-1]) < (2e-2 if method == "dahl" else 1e-5)  # Dahl's bristles have no damping


@pytest.mark.parametrize("method", ["hold", "karnopp", "lugre", "elastoplastic", "reset_integrator", "binding"])
def test_a_block_stays_on_an_incline_below_the_angle_of_repose_and_slides_above(simulate, method):
    repose = math.atan(0.5)
    for angle, slides in ((repose - 0.01, False), (repose + 0.01, True)):
        weight = {"load": f"{9.81 * math.sin(angle)} N", "pad.normal_force": f"{9.81 * math.cos(angle)} N"}
        result = simulate(PUSHED, **settings(method), **weight, **{"run.stop": "3 s"})
        assert (result["block.x"][-1] > 5e-3) == slides, (method, angle)
    # Once sliding: a = g (sin - mu cos).
    excess = 9.81 * (math.sin(angle) - 0.5 * math.cos(angle))
    v, t = result["block.v"], result.t
    gained = (v[-1] - np.interp(2.0, t, v)) / (t[-1] - 2.0)
    assert gained == pytest.approx(excess, rel=1e-3)


# Bristles


def test_dahl_follows_its_exponential_through_a_reversal(simulate):
    """F = F_c - (F_c - F_0) exp(-s0 x/F_c) forward, mirrored backward (Dahl 1968), at any speed of the motion."""
    scene = """
        components:
          ground: {type: Ground}
          pad: {type: Contact, method: dahl, presliding: 1 mm, normal_force: 10 N, curve: 0.5}
          move: {type: MotionSource, position: {table: {t: [0, 1, 3], y: [0, 2 mm, -2 mm]}}}
        connections: [[ground.flange, pad.a], [pad.b, move.flange]]
        run: {stop: 3 s, accuracy: 1e-8}
    """
    result = simulate(scene)
    t, friction = result.t, result["pad.friction"]
    top = 5.0 * (1 - math.exp(-2.0))
    there = 5.0 * (1 - np.exp(-2.0 * t))
    back = -5.0 + (5.0 + top) * np.exp(-2.0 * (t - 1.0))
    np.testing.assert_allclose(friction, np.where(t <= 1.0, there, back), atol=1e-5)


def lugre_reference(force, stop, points):
    """The equations of 1995 by an implicit method of another library at tight tolerance: x, friction."""
    s0, s1, s2, coulomb, stiction, stribeck = 1e5, math.sqrt(1e5), 0.4, 1.0, 1.5, 1e-3

    def rates(t, y):
        _, v, z = y
        g = coulomb + (stiction - coulomb) * math.exp(-((v / stribeck) ** 2))
        dz = v - s0 * abs(v) * z / g
        return [v, force(t) - s0 * z - s1 * dz - s2 * v, dz]

    def slopes(t, y):
        _, v, z = y
        bell = (stiction - coulomb) * math.exp(-((v / stribeck) ** 2))
        g, falling = coulomb + bell, -2 * v / stribeck**2 * bell
        by_speed, by_bristle = 1.0 - s0 * z * (np.sign(v) * g - abs(v) * falling) / g**2, -s0 * abs(v) / g
        return [[0, 1, 0], [0, -s1 * by_speed - s2, -s0 - s1 * by_bristle], [0, by_speed, by_bristle]]

    t = np.linspace(0, stop, points)
    how = {"method": "Radau", "jac": slopes, "rtol": 1e-9, "atol": 1e-13, "max_step": stop / 400}
    y = solve_ivp(rates, (0, stop), [0, 0, 0], t_eval=t, **how).y
    g = coulomb + (stiction - coulomb) * np.exp(-((y[1] / stribeck) ** 2))
    return t, y[0], y[1], s0 * y[2] + s1 * (y[1] - s0 * np.abs(y[1]) * y[2] / g) + s2 * y[1]


def test_the_presliding_loop_of_lugre(simulate):
    """A slow force up to 95 % of break-away and back gives a closed loop within micrometres (1995, Fig. 3)."""
    corners, heights = [0.0, 1.0, 3.0, 5.0], [0.0, 1.425, -1.425, 1.425]
    force = "{table: {t: [0, 1, 3, 5], y: [0, 1.425 N, -1.425 N, 1.425 N]}}"
    result = simulate(LUGRE.replace("FORCE", force), stop="5 s")
    t, x, _, _ = lugre_reference(lambda s: float(np.interp(s, corners, heights)), 5.0, 101)
    np.testing.assert_allclose(np.interp(t, result.t, result["block.x"]), x, atol=0.01 * np.abs(x).max())
    width = np.interp(3.0 - 1.0, result.t, result["block.x"]) - np.interp(5.0 - 1.0, result.t, result["block.x"])
    assert width > 1e-6  # at zero force: the loop is open, and less than the presliding displacement wide
    assert width < 1e-4


@pytest.mark.slow
def test_the_break_away_force_of_lugre_falls_with_the_rate_of_loading(simulate):
    """1995, Fig. 4: near the stiction force when loaded slowly, towards the Coulomb force when fast."""
    forces = []
    for rate in (1.0, 5.0, 20.0, 50.0):
        stop = 3.0 / rate
        result = simulate(LUGRE.replace("FORCE", f"{{ramp: {{to: 3 N, over: {stop} s}}}}"), stop=f"{stop} s")
        _, _, v, friction = lugre_reference(lambda s, r=rate: r * s, stop, 4001)
        # Later the viscous part passes the peak of the break-away.
        forces.append(result["pad.friction"][result["pad.slip"] < 0.1].max())
        assert forces[-1] == pytest.approx(friction[v < 0.1].max(), rel=0.01)
    assert all(slow > fast for slow, fast in itertools.pairwise(forces))
    assert 1.0 < forces[-1] < forces[0] < 1.5


@pytest.mark.slow
def test_lugre_sticks_and_slips_on_a_spring_as_in_1995(simulate):
    """1995, section 4D, Fig. 6: 1 kg pulled through 2 N/m at 0.1 m/s; against the equations by another library."""
    text = LUGRE.replace("push: {type: ForceSource, force: FORCE}", """spring: {type: Spring, stiffness: 2 N/m}
      pull: {type: MotionSource, velocity: 0.1 m/s}""").replace("push.flange", "spring.a").replace(
        "]]\n", "], [spring.b, pull.flange]]\n", 1
    )
    result = simulate(text, stop="12 s", **{"run.accuracy": "1e-8"})

    def rates(t, y):
        x, v, z = y
        g = 1.0 + 0.5 * math.exp(-((v / 1e-3) ** 2))
        dz = v - 1e5 * abs(v) * z / g
        return [v, 2.0 * (0.1 * t - x) - 1e5 * z - math.sqrt(1e5) * dz - 0.4 * v, dz]

    t = np.linspace(0, 12, 241)
    x = solve_ivp(rates, (0, 12), [0, 0, 0], "Radau", t, rtol=1e-8, atol=1e-13).y[0]
    assert np.abs(np.diff(x)).max() > 20 * np.abs(np.diff(x)).min()  # it sticks and slips
    np.testing.assert_allclose(np.interp(t, result.t, result["block.x"]), x, atol=2e-3 * x.max())


# The naive ones


def test_the_naive_zones_do_not_settle_at_rest_and_the_sentence_says_why_and_what_to_use(simulate):
    result = simulate(PULLED, method="naive_zone", **{"run.accuracy": "1e-4"})  # finer, a budget ends it
    assert result.status == "failed"
    assert "pad (forward <-> backward)" in result.run["sentence"]
    assert "no zone for sticking" in result.run["sentence"]
    assert "use method hold, or binding" in result.run["sentence"]


def test_the_naive_sign_is_ended_by_a_budget_of_its_own_and_says_why_and_what_to_use(simulate):
    result = simulate(PULLED, method="naive_sign")
    assert result.status == "budget"
    assert result.run["end_time"] < 2.0  # the first slip is not over
    assert len(result.t) > 100  # and what was computed is there
    assert "budget of 100000 steps" in result.run["sentence"]
    assert "pad: method naive_sign lets the sign of the slip jump" in result.run["sentence"]
    assert "use method hold, or binding" in result.run["sentence"]


def test_a_budget_of_the_netlist_goes_before_that_of_a_naive_law(simulate):
    result = simulate(PULLED, method="naive_sign", **{"run.max_steps": 2_000})
    assert "budget of 2000 steps" in result.run["sentence"]


@pytest.mark.parametrize("method", ["naive_sign", "naive_zone"])
def test_the_page_of_a_naive_law_says_why_it_fails_and_what_to_use(method):
    page = known_types()["Contact"].members[method].__doc__
    assert "Use `hold`" in page
    assert "binding" in page
