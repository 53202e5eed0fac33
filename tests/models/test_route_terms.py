"""The guidance route term by term: what each drive and each device does in 50 s, and a pulley in place of a bend (7b).

Sliding steadily the tensions are those of capstans, and with a drag q per length that does not know the speed of the
line the work of every part is an integral over the way s of the belts, of which 12.5 m go out and 10 m come back:

    sea       tail s + q L(s)        L = 2 m + s in the water
    winch     -T_winch s
    bend A    T_winch (exp(mu A) - 1) going out, T_winch (1 - exp(-mu A)) coming back, per length
    bend B    T_sea (1 - exp(-mu B)), T_sea (exp(mu B) - 1)
    deployer  what is left, for nothing is stored in the end

The drag of the specification is that: 6.57 N/m, of water that passes at 4 m/s whatever the line does. Here it is made
by water a thousand times as fast with a millionth of the coefficient. A second set of numbers is its own, from an
independent computation.
"""

import math
import shutil
from pathlib import Path

import fairlead.models
import numpy as np
import pytest

import fairlead
from tests.models.along_the_route import BEND_A, BEND_B, SPEED, TAIL, WINCH, closed_form, rows_between, tension_at
from tests.reference.hanging_line import drag_per_length

MU, OUT, BACK, WET = 0.35, 12.5, 10.0, 2.0  # m: ways of the belts, line in the water at the start
DRAG = drag_per_length(1025.0, 0.003, 0.085, 4.0)
NETLIST = """
schema: 1
name: terms
include: [parts/array_route.yaml, parts/ideal_drives.yaml]
run: {stop: 50 s, accuracy: 1e-3, engine: stepping}
record: {every: 20 ms, signals: [%s]}
"""
WORK = [
    "belts.*", "route.winch.speed", "line.hose_node[*].x", "line.hose_node[*].v", "line.drag[*].drag",
    "line.outer*[*].slip", "line.outer*[*].friction", "line.inner[*].slip", "line.inner[*].friction",
]  # fmt: skip


def route(folder, signals, settings, bend_a=None):
    """The ideal route with signals of one's own; `bend_a` replaces the line of that station."""
    shutil.copytree(Path(fairlead.models.__file__).parent / "parts", folder / "parts")
    if bend_a is not None:
        part = folder / "parts" / "array_route.yaml"
        text = part.read_text(encoding="utf-8")
        (old,) = (line for line in text.splitlines() if "name: bend_a" in line)
        part.write_text(text.replace(old, bend_a), encoding="utf-8")
    path = folder / "terms.yaml"
    path.write_text(NETLIST % ", ".join(f'"{name}"' for name in signals), encoding="utf-8")
    result = fairlead.load(path, set=settings).run(out=folder / "run")
    assert result.status == "finished", result.run["sentence"]
    return result


@pytest.fixture(scope="module")
def work(tmp_path_factory):
    """Work of each part in 50 s [J]; the deployer, the winch and the sea give, the others take."""
    steady = {"ship": "4000 m/s", "route.stations.sea.drag_coefficient": "3e-9"}
    result = route(tmp_path_factory.mktemp("work"), WORK, steady)

    def over_time(power):
        return float(np.trapezoid(power, result.t))

    def of(name):
        return result.columns(result.match(name))

    rubbed = of("line.outer[*].friction") * of("line.outer[*].slip")
    at_a = of("line.hose_node[*].x") < 5.0
    pulled = np.sum(of("line.drag[*].drag") * of("line.hose_node[*].v"), axis=1)
    return {
        "deployer": over_time(result["belts.force"] * result["belts.v"]),
        "winch": over_time(-WINCH * 0.65 * result["route.winch.speed"]),
        "sea": over_time(pulled + TAIL * result["line.hose_node[160].v"]),
        "bend A": over_time((rubbed * at_a).sum(axis=1)),
        "bend B": over_time((rubbed * ~at_a).sum(axis=1)),
        "belts": over_time((of("line.outer_deployer[*].friction") * of("line.outer_deployer[*].slip")).sum(axis=1)),
        "bulkheads": over_time((of("line.inner[*].friction") * of("line.inner[*].slip")).sum(axis=1)),
    }


def closed_work():
    """The same by capstans."""

    def pulled(begin, end):
        """Tension of the sea times the way, from one length in the water to another [J]."""
        return TAIL * (end - begin) + DRAG * (end**2 - begin**2) / 2

    out, back = pulled(WET, WET + OUT), -pulled(WET + OUT, WET + OUT - BACK)
    rise_a, rise_b = math.exp(MU * BEND_A), math.exp(MU * BEND_B)
    found = {
        "winch": -WINCH * (OUT - BACK),
        "sea": out - back,
        "bend A": WINCH * ((rise_a - 1) * OUT + (1 - 1 / rise_a) * BACK),
        "bend B": out * (1 - 1 / rise_b) + back * (rise_b - 1),
    }
    return found | {"deployer": found["bend A"] + found["bend B"] - found["winch"] - found["sea"]}


def test_the_drag_is_that_of_the_specification():
    assert pytest.approx(6.57, abs=0.005) == DRAG


@pytest.mark.parametrize("part", ["deployer", "winch", "sea", "bend A", "bend B"])
def test_the_work_of_each_part_is_that_of_sliding_through_capstans(work, part):
    assert work[part] == pytest.approx(closed_work()[part], rel=0.01)


@pytest.mark.parametrize(("part", "published"), [("deployer", 4488.0), ("winch", -499.0), ("sea", 430.0)])
def test_the_work_of_each_drive_is_that_of_an_independent_computation(work, part, published):
    assert work[part] == pytest.approx(published, rel=0.01)


def test_so_is_the_friction_on_the_devices_and_what_the_rest_takes_is_little(work):
    """4413 J on devices; in bulkheads 3.2 J, damping and storage 2 J."""
    assert work["bend A"] + work["bend B"] + work["belts"] == pytest.approx(4413.0, rel=0.01)
    assert 0.0 < work["bulkheads"] < 10.0
    left = work["deployer"] + work["winch"] + work["sea"] - work["bend A"] - work["bend B"] - work["belts"]
    assert left == pytest.approx(work["bulkheads"], abs=0.001 * work["deployer"])


BEARING, BORE, MOMENT = 0.02, 0.03, 5.0
PULLEY = (
    '      - {name: bend_a, type: Pulley, start: 2 m, angle: 90 deg, radius: 1 m, friction: "{mu}", '
    f"moment: {MOMENT} kg*m^2, bearing: {{friction: {BEARING}, radius: {BORE} m}}}}"
)
ON_PULLEY = [
    "belts.*", "line.hose_node[*].x", "line.hose[*].tension", "line.core[*].tension", "line.outer_bend_a[*].friction",
    "route.bend_a.speed", "route.bend_a.bearing.torque",
]  # fmt: skip
TAKEN = BEARING * BORE * 2 * WINCH * math.sin(BEND_A / 2)  # N m; N as well, with a radius of 1 m
DEPLOYING, HAULING = (+1, 18.0, 24.9), (-1, 34.0, 39.9)


@pytest.fixture(scope="module")
def pulley(tmp_path_factory):
    return route(tmp_path_factory.mktemp("pulley"), ON_PULLEY, {"run.stop": "40 s"}, PULLEY)


def on_the_wheel(pulley, begin, end):
    """Mean of the friction of the line on the pulley [N]."""
    rows = (pulley.t >= begin) & (pulley.t <= end)
    friction = pulley.columns(pulley.match("line.outer_bend_a[*].friction")).sum(axis=1)
    return np.trapezoid(friction[rows], pulley.t[rows]) / (pulley.t[rows][-1] - pulley.t[rows][0])


@pytest.mark.parametrize(("way", "begin", "end"), [DEPLOYING, HAULING])
def test_a_pulley_takes_what_its_bearing_takes(pulley, way, begin, end):
    """Q = 2 T sin(angle/2) on the bearing, mu_b r Q over the radius of the wheel: 0.17 N of 200 instead of 147.

    While hauling the wheel swings with the line, and the line shakes it by 1 N to and fro.
    """
    torque = pulley["route.bend_a.bearing.torque"][rows_between(pulley, begin, end)].mean()
    assert torque == pytest.approx(way * TAKEN, rel=0.02)
    assert on_the_wheel(pulley, begin, end) == pytest.approx(way * TAKEN, abs=0.01 if way > 0 else 0.1)


@pytest.mark.parametrize(("way", "begin", "end"), [DEPLOYING, HAULING])
def test_behind_a_pulley_the_tensions_are_those_of_the_route_without_the_bend(pulley, way, begin, end):
    _, _, after, sea = closed_form(pulley, MU, way, begin, end)
    winch, before, behind, wet = tension_at(pulley, [1.0, 4.2, 7.2, 9.7], begin, end)
    assert [winch, before] == pytest.approx([WINCH, WINCH], rel=0.01)
    assert [behind, wet] == pytest.approx([after, sea], rel=0.02)
    force = pulley["belts.force"][rows_between(pulley, begin, end)].mean()
    assert force == pytest.approx(WINCH - after, abs=0.02 * WINCH)


@pytest.mark.parametrize(("way", "begin", "end"), [DEPLOYING, HAULING])
def test_a_pulley_turns_with_the_line(pulley, way, begin, end):
    rows = rows_between(pulley, begin, end)
    np.testing.assert_allclose(pulley["route.bend_a.speed"][rows].mean(), way * SPEED / 1.0, rtol=0.01)


def test_to_set_a_pulley_going_takes_its_moment_times_the_acceleration(pulley):
    """0.5 m/s^2 for a second: J a/R^2 = 2.5 N beside the bearing."""
    assert on_the_wheel(pulley, 0.2, 0.9) == pytest.approx(MOMENT * SPEED + TAKEN, rel=0.05)
