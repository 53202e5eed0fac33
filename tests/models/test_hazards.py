"""The hazards of the printed binding law (physics 1.9), each shown in `form: literal` and gone in `form: robust`.

H5, the leak of a load, is the price of both forms: `test_binding_creeps.py` has it against its closed form, and
`test_choosing_creep.py` how to say what leak one can bear.
"""

import numpy as np
import pytest

import fairlead
from tests.models.test_binding_zones import CREEP, FORMS, NORMAL, STICTION, V_N, contact, instant

DRAGGED = """
    parameters: {form: literal}
    components:
      ground: {type: Ground}
      block: {type: Mass, mass: 1 kg}
      pad:
        type: Contact
        method: binding
        form: "{form}"
        creep: 1 mm/s
        normal_force: 10 N
        curve: {curve: tustin, stiction: 0.5, coulomb: 0.3, velocity: 5 mm/s}
      spring: {type: Spring, stiffness: 100 N/m}
      pull: {type: MotionSource, velocity: 1 mm/s}
    connections: [[ground.flange, pad.a], [pad.b, block.flange, spring.a], [spring.b, pull.flange]]
    run: {stop: 120 s, accuracy: 1e-5, max_events: 400}
"""

CHAIN = """
    parameters: {mu: 0.6, form: literal, applied_force: aggregate}
    components:
      line:
        type: ArrayModule
        length: 6 m
        element: 0.25 m
        start: 1.5 m
        tension: 800 N
        hose: {mass: 1.6 kg/m, stiffness: 8 kN, damping_ratio: 0.05}
        core: {mass: 4.2 kg/m, stiffness: 500 kN, damping_ratio: 0.05}
        bulkhead_friction: {curve: stribeck, stiction: 0.50, coulomb: 0.40, velocity: 20 mm/s}
      route:
        type: Route
        stations: [{type: Bend, start: 3 m, angle: 90 deg, radius: 1 m, edge: 0.25 m, friction: "{mu}"}]
      haul: {type: MotionSource, velocity: {ramp: {to: -0.3 m/s, over: 1 s}}}
      tow: {type: ForceSource, force: 800 N}
    connections: [[haul.flange, line.inboard], [tow.flange, line.outboard], [line.path, route.path]]
    friction: {method: binding, creep: 0.1 mm/s, form: "{form}", applied_force: "{applied_force}"}
    run: {stop: 3 s, accuracy: 1e-4, max_events: 20000}
    record: {signals: [haul.force, "line.registration[*].d"], every: 10 ms}
"""

SHAKEN = """
    parameters: {form: literal, applied_force: naive}
    components:
      device: {type: MotionSource, position: {sine: {amplitude: 75.99 mm, frequency: 1 Hz}}}
      block: {type: Mass, mass: 1 kg, position: 0 m, velocity: 0.47746 m/s}
      load: {type: ForceSource, force: {sine: {amplitude: -6 N, frequency: 1 Hz}}}
      pad: {type: Contact, normal_force: 10 N, curve: 0.5}
    connections: [[device.flange, pad.a], [pad.b, block.flange, load.flange]]
    friction: {method: binding, creep: 0.01 mm/s, form: "{form}", applied_force: "{applied_force}"}
    run: {stop: 2 s, accuracy: 1e-6, max_events: 2000}
"""


def ran(scene, tmp_path, text, **settings):
    """The result, however the run ended."""
    return scene(text, **settings).run(out=tmp_path / "-".join(["run", *map(str, settings.values())]), check=False)


def test_h1_a_slow_drive_binds_the_printed_law_again_and_again(scene, tmp_path):
    """v_n is 4 mm/s, the drive 1 mm/s: just broken away, friction is at a fifth, the block is soon faster than the
    drive, the load falls below stiction, and it binds before it was ever out of the ramp."""
    literal = ran(scene, tmp_path, DRAGGED, form="literal")
    robust = ran(scene, tmp_path, DRAGGED, form="robust")
    assert literal.status == "budget"
    assert literal["pad.slip"].max() < 4e-3  # never sliding
    assert literal["spring.tension"][-300:].min() > 4.9  # and the load stays at stiction
    assert robust.status == "finished"
    assert robust["pad.slip"].max() > 0.1  # slips, as a rigid contact does
    assert robust["spring.tension"][robust.t > 60.0].min() < 2.5
    assert len(robust.events) < 10


def test_h2_the_printed_law_holds_with_more_than_stiction_and_tears_the_next_contact_loose(bundled, tmp_path):
    """In the sandwich the inner contact holds all the time; the outer one, catching the hose, must not tear it off."""
    held = bundled("sandwich", {"method": "hold", "run.accuracy": 1e-8})
    robust = bundled("sandwich", {"creep": "1e-4 m/s"})
    printed = fairlead.load("sandwich", {"friction.form": "literal", "run.max_events": "20000"})
    literal = printed.run(out=tmp_path / "run", check=False)
    assert not [e for e in held.events if e.component == "inner" and e.t > 0 and e.zone_to != "held"]
    assert np.abs(literal["outer.friction"]).max() > 2.4 * 40  # 2.5 F_s
    assert np.abs(literal["inner.friction"]).max() > 2.4 * 45
    bound = ("plateau", "ramp_forward", "ramp_backward")
    loose = [e for e in literal.events if e.component == "inner" and e.t > 0 and e.zone_to not in bound]
    assert loose
    assert literal.status == "failed"  # a ping-pong without end
    assert "zones did not settle" in literal.run["sentence"]
    assert np.abs(robust["outer.friction"]).max() < 1.001 * 40
    assert not [e for e in robust.events if e.component == "inner" and e.t > 0 and e.zone_to not in bound]


def test_h3_the_ramp_of_the_printed_law_is_negative_damping():
    """Steepest at the end of the ramp: dT/dv = F_s/v_n - f_m v_n/(v_n - v_m) = -1.75 f_m (physics 1.4)."""
    steepest = {}
    for form, world in ((form, contact(form)) for form in FORMS):
        found = []
        for v in np.linspace(0, V_N, 801)[1:-1]:
            at = instant(world, float(v), 0.0, NORMAL)
            end = world.settle(at, "plateau")
            step = end.shifted({"port:b:v": 1.0}, 1e-30j)
            found.append(world.flows(step)["port:b"].imag / 1e-30)
        steepest[form] = min(found)
    assert steepest["literal"] == pytest.approx(-1.75 * STICTION / CREEP, rel=1e-2)  # sampled at 1/800 of v_n
    assert steepest["robust"] == 0.0  # level where it is capped, and nowhere falling


@pytest.mark.parametrize("mu", [0.35, 0.6])
def test_h4_in_a_chain_the_printed_law_undoes_each_break_away(scene, tmp_path, mu: float):
    """25 nodes of hose and core: what one contact lets go another answers at once, so that it binds again."""
    literal = ran(scene, tmp_path, CHAIN, form="literal", mu=mu)
    assert literal.run["end_time"] < 0.1
    if literal.status == "failed":  # within one instant
        assert "zones did not settle" in literal.run["sentence"]
        assert "<->" in literal.run["sentence"]
    else:  # from instant to instant
        assert literal.status == "budget"
        assert literal.run["switches"] > 400 * 46  # contacts that are in the bend for a while


@pytest.mark.parametrize("mu", [0.35, 0.6])
def test_h4_is_gone_in_the_robust_law_whatever_the_applied_force(scene, tmp_path, mu: float):
    ends = {}
    for applied in ("reduced", "aggregate", "naive"):
        robust = ran(scene, tmp_path, CHAIN, form="robust", mu=mu, applied_force=applied)
        assert robust.status == "finished", robust.run["sentence"]
        assert robust.run["switches"] < 1200  # over 46 contacts that are in the bend for a while
        ends[applied] = robust["haul.force"][robust.t > 2.0].mean()
    assert max(ends.values()) == pytest.approx(min(ends.values()), rel=5e-3)


def test_h6_a_force_without_the_acceleration_of_the_surface_lets_go_falsely(scene, tmp_path):
    """Surface and load accelerate together: the contact needs m a = 3 N of its 5 N, but 6 N act on the block.

    Let go, the printed law carries 3 N at 0.6 v_n instead of 0.48 creep, five times as fast.
    """
    creep = 1e-5
    naive = ran(scene, tmp_path, SHAKEN, form="literal", applied_force="naive")
    assert len([event for event in naive.events if event.guard == "lets_go"]) == 4  # once a half period
    assert np.abs(naive["pad.slip"]).max() == pytest.approx(0.6 * 4 * creep, rel=0.01)
    for form in ("literal", "robust"):
        for applied in ("reduced", "aggregate"):
            result = ran(scene, tmp_path, SHAKEN, form=form, applied_force=applied)
            assert not [event for event in result.events if event.t > 0]
            assert np.abs(result["pad.slip"]).max() == pytest.approx(0.6 * 0.8 * creep, rel=0.01), (form, applied)


def test_h7_a_contact_that_loses_its_load_lets_go_in_time(scene, tmp_path):
    """f_m goes with N, so friction never exceeds N mu_s while N goes to zero, and nothing is left when it is zero."""
    text = """
        components:
          ground: {type: Ground}
          block: {type: Mass, mass: 1 kg}
          pull: {type: ForceSource, force: 2 N}
          press: {type: ForceSource, force: {ramp: {from: 10 N, to: 0 N, over: 1 s}}}
          anvil: {type: Mass, mass: 1e9 kg}
          pad: {type: Contact, method: binding, curve: 0.5}
        connections:
          - [ground.flange, pad.a]
          - [pad.b, block.flange, pull.flange]
          - [press.flange, anvil.flange]
          - [press.force, pad.normal]
        run: {stop: 1.5 s, accuracy: 1e-7}
    """
    result = ran(scene, tmp_path, text)
    pressed = np.maximum(10 * (1 - result.t), 0)
    assert (result["pad.friction"] <= 0.5 * pressed * (1 + 1e-9) + 1e-9).all()
    loose = next(event.t for event in result.events if event.zone_to in ("break_forward", "slide_forward"))
    assert loose == pytest.approx(0.6, abs=1e-5)  # N mu = 2 N
    # Then  v' = 2 - 5 (1 - t) until t = 1, and 2 after.
    assert result["block.v"][-1] == pytest.approx(2 * 0.9 - 5 * 0.4**2 / 2, rel=1e-3)
