"""The single bend with constant tension at both ends, and a holder of the speed (variant of physics section 7a).

Instead of its speed the tension inboard is given, that of a capstan, and a damper to a body that moves at the speed
asked for gives what is missing. Sliding steadily all forces are known:

    holder = 800 N exp(mu pi/2) - tension given        speed = 0.3 m/s - holder/damping

At mu = 0.60 the tension that hauls at 0.35 lacks 667 N. A holder that cannot give them lets the line stop.
"""

import math

import numpy as np
import pytest

import fairlead

SPEED, OUTBOARD = 0.3, 800.0
ENOUGH = {mu: OUTBOARD * math.exp(mu * math.pi / 2) for mu in (0.35, 0.60)}  # N, inboard, to slide on
TIED = """
  pull: {{type: ForceSource, force: {{table: {{t: {times}, y: {forces}}}}}}}
  asked: {{type: MotionSource, velocity: {{ramp: {{to: -0.3 m/s, over: 1 s}}}}}}
  holder: {{type: Damper, damping: {damping} N*s/m}}
"""


@pytest.fixture(scope="module")
def hauled(tmp_path_factory):
    """hauled(mu, tension inboard over time, damping of the holder): 12 s of the bundled bend, drawn by a force."""
    made = {}
    text = fairlead_text("single_bend")

    def run(mu, forces, damping):
        key = (mu, *forces.items(), damping)
        if key not in made:
            folder = tmp_path_factory.mktemp("bend")
            tied = TIED.format(
                times=[f"{t} s" for t in forces], forces=[f"{-force} N" for force in forces.values()], damping=damping
            )
            path = folder / "bend.yaml"
            path.write_text(rewired(text, tied), encoding="utf-8")
            settings = {"mu": str(mu), "method": "hold", "run.stop": "12 s"}
            made[key] = fairlead.load(path, set=settings).run(out=folder / "run")
            assert made[key].status == "finished", made[key].run["sentence"]
        return made[key]

    return run


def fairlead_text(name):
    """A bundled netlist as it is written."""
    from importlib.resources import files

    return (files("fairlead.models") / f"{name}.yaml").read_text(encoding="utf-8")


def rewired(text, tied):
    """The netlist with pull and holder in the place of the haul."""
    haul = next(line for line in text.splitlines() if line.startswith("  haul:"))
    assert text.count("[haul.flange, line.inboard]") == 1
    return (
        text.replace(haul, tied.strip("\n"))
        .replace("[haul.flange, line.inboard]", "[pull.flange, holder.b, line.inboard]\n  - [asked.flange, holder.a]")
        .replace("haul.force", "holder.tension")
    )


def given(tension, begun=1.0):
    """From the tension at rest to what is asked for."""
    return {0: OUTBOARD, begun: tension}


def mean(result, name, since=5.0):
    """Mean of a signal from a time on."""
    late = result.t >= since
    return float(np.trapezoid(result[name][late], result.t[late]) / (result.t[-1] - result.t[late][0]))


def registration(result):
    """Greatest de-registration [m]."""
    return float(np.abs(result.columns(result.match("line.registration[*].d"))).max())


def speed(result, since=5.0, until=12.0):
    """Mean speed of the inboard end, by its way [m/s]."""
    x = result["line.hose_node[0].x"]
    begin, end = np.searchsorted(result.t, [since, until - 1e-9])
    return float((x[end] - x[begin]) / (result.t[end] - result.t[begin]))


def test_at_low_friction_the_line_goes_on_by_itself_in_unison(hauled):
    """The holder sets it going and then has nothing to do."""
    result = hauled(0.35, given(ENOUGH[0.35]), 2000)
    assert mean(result, "holder.tension") == pytest.approx(0.0, abs=0.01 * ENOUGH[0.35])
    assert speed(result) == pytest.approx(-SPEED, abs=0.01 * ENOUGH[0.35] / 2000)
    assert registration(result) < 0.010


def test_at_high_friction_it_takes_its_own_tension_and_the_hose_is_left_behind(hauled):
    result = hauled(0.60, given(ENOUGH[0.60]), 2000)
    assert mean(result, "holder.tension") == pytest.approx(0.0, abs=0.02 * ENOUGH[0.60])
    assert speed(result) == pytest.approx(-SPEED, abs=0.02 * ENOUGH[0.60] / 2000)
    assert registration(result) > 0.120


@pytest.mark.parametrize("damping", [5000, 20000])
def test_what_is_lacking_the_holder_gives(hauled, damping):
    lacking = ENOUGH[0.60] - ENOUGH[0.35]
    assert lacking == pytest.approx(667.0, abs=0.5)  # the number of the specification
    result = hauled(0.60, given(ENOUGH[0.35]), damping)
    assert mean(result, "holder.tension") == pytest.approx(lacking, abs=0.02 * ENOUGH[0.60])
    assert speed(result) == pytest.approx(lacking / damping - SPEED, abs=0.02 * ENOUGH[0.60] / damping)


def test_with_too_little_the_line_stops(hauled):
    """A holder that gives 300 N at rest, less than half of what is lacking, when the tension drops at 6 s.

    What slides until then stands afterwards: the spans on both sides of the bend ring, and go nowhere.
    """
    result = hauled(0.60, {0: OUTBOARD, 1: ENOUGH[0.60], 6: ENOUGH[0.60], 6.01: ENOUGH[0.35]}, 1000)
    assert speed(result, 4.0, 5.8) == pytest.approx(-SPEED, abs=0.02 * ENOUGH[0.60] / 1000)
    after, end = np.searchsorted(result.t, [7.0, 12.0 - 1e-9])
    for node in (0, 60):
        x = result[f"line.hose_node[{node}].x"]
        assert abs(x[end] - x[after]) < 0.01 * SPEED * 5.0
    assert mean(result, "holder.tension", since=7.0) == pytest.approx(1000 * SPEED, rel=0.01)
