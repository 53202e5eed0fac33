"""Threads and teeth that lock themselves, at rest between a brake and a guide, while their load passes through zero.

Their friction follows their own force. As that passes through zero, the friction of before leads to no answer: behind
the corner only forces of the other sign hold the part. Nothing moves in any of these scenes: what holds is stronger
than what pushes.
"""

from __future__ import annotations

import math

import pytest
import yaml

ENGINES = ["rodas", "stepping", "ida"]
SCREW = {"radius": "19.5 mm", "lead": "4.77 mm", "curve": 0.267}
PARTS = {
    "screw": {"type": "LeadScrew", **SCREW},
    "steep screw": {"type": "LeadScrew", "radius": "13.6 mm", "lead": "25.1 mm", "curve": 0.278},
    "worm": {"type": "Worm", **SCREW, "wheel_radius": "50 mm"},
    "gear": {"type": "LossyGear", "ratio": 0.05, "efficiency": 0.4},
}
GUIDES = {
    "screw": ("Mass", {"mass": 9.55}, "Contact", {"curve": 0.2, "normal_force": "5160 N"}, "flange", "ForceSource"),
    "worm": ("Inertia", {"moment": 0.02}, "Brake", {"curve": 0.2, "radius": "1 m", "normal_force": "258 N"},
             "shaft", "TorqueSource"),
}  # fmt: skip


def scene(kind, size=1.0, round_off=1e-3, names=str):
    """A torque that swings on a braked shaft, and a part from it to a body that a guide holds; forces times `size`."""
    body, inertia, guide, pressed, port, pushes = GUIDES["screw" if "screw" in kind else "worm"]
    near, far = {"screw": ("screw", "nut"), "worm": ("worm", "wheel"), "gear": ("a", "b")}[kind.split()[-1]]
    guide_force = float(pressed["normal_force"].split()[0]) * size
    push = {"force": f"{-2.143 * size} N"} if pushes == "ForceSource" else {"torque": f"{-0.107 * size} N*m"}
    unit = "N*m" if kind == "gear" else "N"
    swing = {
        "from": f"{-3.131 * size} N*m", "to": f"{3.191 * size} N*m", "start": "80 ms", "every": "360 ms",
        "wide": "220 ms", "rise": "20 ms", "count": 2,
    }  # fmt: skip
    squeeze = {"amplitude": 20.27 * size, "frequency": "1.62 Hz", "phase": "2.9 rad", "offset": 22.3 * size}
    ground = [names("gu") + ".a", names("floor") + ".flange"] if guide == "Contact" else None
    still = {"position": 0, "velocity": 0} if body == "Mass" else {"angle": 0, "speed": 0}
    components = {
        "tq": {"type": "TorqueSource", "torque": {"pulses": swing}},
        "br": {"type": "Brake", "radius": "0.1 m", "curve": 0.3},
        "squeeze": {"type": "SignalSource", "value": {"sine": squeeze}},
        "ja": {"type": "Inertia", "moment": f"{0.0492 * size} kg*m^2", "angle": 0, "speed": 0},
        "u": PARTS[kind] | {"round_off": f"{round_off * size} {unit}"},
        "mb": {"type": body, **{name: value * size for name, value in inertia.items()}, **still},
        "gu": {"type": guide, **pressed, "normal_force": f"{guide_force} N"},
        "ld": {"type": pushes, **push},
        **({"floor": {"type": "Ground"}} if ground else {}),
    }
    touches = names("gu") + (".b" if ground else ".shaft")
    joints = [
        [names("ja") + ".shaft", names("u") + "." + near, names("tq") + ".shaft", names("br") + ".shaft"],
        [names("u") + "." + far, names("mb") + "." + port, names("ld") + "." + port, touches],
        [names("squeeze") + ".signal", names("br") + ".normal"],
        *([ground] if ground else []),
    ]
    netlist = {
        "components": {names(name): one for name, one in components.items()},
        "connections": joints, "run": {"stop": "0.8 s"}, "record": {"signals": ["**"]},
    }  # fmt: skip
    return yaml.safe_dump(netlist, sort_keys=False)


def check(result, size=1.0, names=str):
    """Nothing moves, and the friction of the brake is within its limit, which the torque passes."""
    assert result.ok, result.sentence
    data = result.to_pandas()
    assert data[names("ja") + ".angle"].abs().max() < 1e-9
    brake, limit = data[names("br") + ".contact.friction"], 0.3 * data[names("br") + ".pressing.pressing"]
    assert (brake.abs() - limit).max() < 1e-3 * limit.max()
    torque = data[names("tq") + ".torque"]
    assert torque.min() < 0.0 < torque.max()


@pytest.mark.parametrize("accuracy", [1e-4, 1e-6])
@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("kind", PARTS)
def test_a_load_that_passes_through_zero_moves_nothing(simulate, kind, engine, accuracy):
    check(simulate(scene(kind), **{"run.engine": engine, "run.accuracy": accuracy}))


@pytest.mark.parametrize("round_off", [1e-6, 1e-1])
@pytest.mark.parametrize("engine", ENGINES)
def test_however_sharp_the_corner_is(simulate, engine, round_off):
    check(simulate(scene("screw", round_off=round_off), **{"run.engine": engine, "run.accuracy": 1e-4}))


@pytest.mark.parametrize("size", [1e-4, 1e4])
def test_sizes_and_names_do_not_matter(simulate, size):
    def other(name):
        return f"z_{name[::-1]}"

    check(simulate(scene("screw", size, names=other)), size, other)


def test_what_the_brake_leaves_is_what_the_thread_asks_for(simulate):
    """T r tan s of the load and the friction along the flank, at r cos s: both turn the shaft, at rest."""
    data = simulate(scene("screw"), **{"run.accuracy": 1e-6}).to_pandas()
    radius, slope = 19.5e-3, math.atan(4.77e-3 / (2 * math.pi * 19.5e-3))
    asked = data["u.friction"] * math.cos(slope) * radius - data["u.pressed.tension"] * math.tan(slope) * radius
    assert (data["tq.torque"] - data["br.torque"] - asked).abs().max() < 1e-5
