"""A page can be followed from the top: its files, commands and Python, in the order of the page and in one folder.

Not played are commands that do not end by themselves, that need a cluster or records of the reader's own, and
studies that take minutes (`tests/studies` plays those on fewer cases).
"""

import json
import math
import pathlib
import re
import shlex
import sys
import warnings

import numpy as np
import pytest
from typer.testing import CliRunner

import fairlead
from fairlead.cli import app
from tests.invariance.known import KNOWN
from tests.unit.test_docs import DOCS, blocks, files

QUICK = ["tutorial/first", "tutorial/parts", "howto/friction", "howto/start", "howto/drive", "modes"]
LONG = ["start", "studies", "howto/accuracy", "howto/slow", "report"]
LEFT_OUT = (
    "fairlead view", "--cluster", "fairlead fit", "sweep single_bend", "route_study", "guidance_route_ideal-sweep",
    "--paper",
)  # fmt: skip
BEFORE = {"start": "run single_bend --set run.stop=0.2s -q"}  # what `make demo` has done, but shorter


def play(line: str) -> str:
    """What a command line prints; it must end well."""
    words = shlex.split(line, comments=True)
    kept = words[: words.index(">")] if ">" in words else words
    said = CliRunner().invoke(app, kept[1:])
    assert said.exit_code == 0, (line, said.output)
    return said.output


def read(page: str) -> str:
    """The text of a page."""
    return (DOCS / f"{page}.md").read_text(encoding="utf-8")


def lines(page: str, words: str) -> list[str]:
    """The lines of the blocks of a page that contain some words."""
    return [line for _, _, text in blocks(page) for line in text.splitlines() if words in line]


@pytest.mark.parametrize("page", [*QUICK, *(pytest.param(page, marks=pytest.mark.slow) for page in LONG)])
def test_a_page_can_be_followed_from_the_top(
    page: str, tmp_path: pathlib.Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.syspath_prepend(tmp_path)
    if page in BEFORE:
        play(f"fairlead {BEFORE[page]}".replace("0.2s", "'0.2 s'"))
    known, space, played = set(sys.modules), {"__name__": "page"}, 0
    for name, language, text in blocks(page):
        if name:
            (tmp_path / name).write_text(text, encoding="utf-8")
        elif language == "python":
            with warnings.catch_warnings():
                exec(text, space)
            played += 1
        elif language in ("", "sh"):
            for line in (one.strip() for one in text.splitlines() if one.strip().startswith("fairlead ")):
                if not any(one in line for one in LEFT_OUT):
                    play(line)
                    played += 1
    for name in set(sys.modules) - known:
        if str(getattr(sys.modules[name], "__file__", "")).startswith(str(tmp_path)):
            del sys.modules[name]
    assert played


def test_files_that_commands_of_a_page_write_are_where_the_page_says(
    tmp_path: pathlib.Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (line,) = lines("howto/friction", "fairlead friction")
    play(line)
    (told,) = re.findall(r"The picture is `(\S+)`", read("howto/friction"))
    assert (tmp_path / told).is_file()


def test_the_tutorial_counts_the_switches_of_its_crate(tmp_path: pathlib.Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """And without damping it sticks at every speed: nothing takes the energy out of its oscillation."""
    monkeypatch.chdir(tmp_path)
    (crate,) = files("tutorial/first", tmp_path)
    (line,) = lines("tutorial/first", "fairlead compare")
    rows = json.loads(play(f"{line} --json"))["rows"]
    text = read("tutorial/first")
    (shown,) = re.findall(r"100 mm/s there are (\d+), (\d+) and (\d+)", text)
    assert [row["switches"] for row in rows] == [*map(int, shown), 1]
    crate.write_text(crate.read_text(encoding="utf-8").replace("damping: 80", "damping: 0"), encoding="utf-8")
    undamped = json.loads(play(f"{line.replace('results/speeds', 'results/undamped')} --json"))["rows"]
    assert min(row["switches"] for row in undamped) > 5


def test_a_spring_that_breaks_misses_what_it_had_stored_until_its_law_keeps_it(
    tmp_path: pathlib.Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """strength^2/(2 stiffness) = 50^2/2000 J = 1.25 J."""
    monkeypatch.chdir(tmp_path)
    library, scene = files("tutorial/parts", tmp_path)
    lost = fairlead.load(scene, libraries=[str(library)]).run(out=None).run["energy"]
    assert lost["closure"] * lost["throughput"] == pytest.approx(50**2 / (2 * 1000), rel=1e-3)
    (correction,) = [text for _, _, text in blocks("tutorial/parts") if "strength**2" in text and "class" not in text]
    mended = tmp_path / "mended.py"
    text = library.read_text(encoding="utf-8")
    old = "        return Law(a=0.0, b=0.0, tension=0.0)\n"
    assert text.count(old) == 1
    mended.write_text(text.replace(old, correction), encoding="utf-8")
    kept = fairlead.load(scene, libraries=[str(mended)]).run(out=None).run["energy"]
    assert kept["closure"] < 1e-7


HERTZ = '''
from fairlead.component import Component, Law, Parameter, Translational, Zones, guard, zone

def near(p, a, b): return a.x - b.x

class Hertz(Component):
    """push = k d**1.5 while d = a.x - b.x is positive, written so that it is finite beyond its guard."""

    a, b = Translational(), Translational()
    k = Parameter("1", above=0)
    exempt = {"units": "half powers"}
    zones = Zones("off", "on")
    off = zone("off")(lambda p, a, b: (0, 0))
    meets = guard("off", to="on", unit="m")(near)
    parts = guard("on", to="off", unit="m")(lambda p, a, b: -near(p, a, b))

    @zone("on")
    def on(p, a, b):
        d = near(p, a, b)
        push = p.k * (d**2 + 1e-24) ** 0.75
        return Law(a=push, b=-push, stored=0.4 * p.k * (d**2 + 1e-24) ** 1.25)
'''
BOUNCES = """
components:
  floor: {type: Ground}
  ball: {type: Mass, mass: 1 kg, position: 0.5 m}
  contact: {type: Hertz, k: 100000}
  weight: {type: ForceSource, force: -9 N}
connections: [[floor.flange, contact.a], [ball.flange, contact.b, weight.flange]]
run: {stop: 3 s, accuracy: 1e-6}
"""


@pytest.mark.parametrize("engine", ["rodas", "stepping", "ida"])
def test_a_power_that_the_page_on_components_writes_as_one_of_a_square_passes_its_guard(
    simulate, library, engine
) -> None:
    """It falls 0.5 m at 9 m/s^2, so it meets the floor at sqrt(2 0.5/9) s, and no energy is lost."""
    assert "(d**2 + 1e-24)**0.75" in read("components")
    result = simulate(BOUNCES.replace("1e-6}", f"1e-6, engine: {engine}}}"), (library(HERTZ),))
    assert result.status == "finished"
    first = next(event for event in result.events if event.component == "contact" and event.zone_to == "on")
    assert first.t == pytest.approx(math.sqrt(2 * 0.5 / 9), abs=1e-4)
    assert result.run["energy"]["closure"] < 1e-3


FADES = '''
from fairlead.component import Component, Law, Parameter, State, Translational, Zones, guard, zone

FADES = 1e-3  # s

class Fading(Component):
    """A spring that breaks, and whose energy fades as the page on components describes."""

    a, b = Translational(), Translational()
    stiffness, strength = Parameter("N/m", above=0), Parameter("N", above=0)
    energy = State("J", "Of the spring, and of what rings in its ends.", least=0)
    zones = Zones("whole", "broken")

    @zone("whole")
    def whole(p, a, b, energy):
        pull = p.stiffness * (b.x - a.x)
        return Law(a=-pull, b=+pull, energy=pull * (b.v - a.v), stored=energy)

    @zone("broken")
    def broken(p, a, b, energy):
        return Law(a=0.0, b=0.0, energy=-energy / FADES, stored=energy, dissipated=energy / FADES)

    @guard("whole", to="broken", unit="N")
    def breaks(p, a, b):
        return p.stiffness * (b.x - a.x) - p.strength
'''
BREAKS = """
components:
  wall: {type: Ground}
  part: {type: Fading, stiffness: 1 kN/m, strength: 50 N}
  mass: {type: Mass, mass: 1 kg}
  pull: {type: ForceSource, force: {ramp: {to: 100 N, over: 1 s}}}
connections: [[wall.flange, part.a], [part.b, mass.flange, pull.flange]]
run: {stop: 1 s}
"""


def test_an_energy_that_fades_as_the_page_on_components_describes_is_dissipated(simulate, library) -> None:
    energy = simulate(BREAKS, (library(FADES),)).run["energy"]
    assert energy["dissipated"] == pytest.approx(50**2 / (2 * 1000), rel=1e-3)
    assert energy["closure"] < 1e-6


ROCKER = '''
from fairlead.component import Component, Law, Parameter, Translational, Unknown, hold_position

class Rocker(Component):
    """c.x = a.x + b.x**2/(2 r)."""

    a, b, c = Translational(), Translational(), Translational()
    r = Parameter("m", above=0)
    push = Unknown("N", "Force in it.")

    def law(p, a, b, c, push):
        return Law(push=hold_position(c.x - a.x - b.x**2 / (2 * p.r)))
'''
LINKED = """
components:
  ma: {type: Mass, mass: 1 kg}
  mb: {type: Mass, mass: 2 kg, position: 0.2 m}
  mc: {type: Mass, mass: 3 kg}
  link: {type: Rocker, r: 0.5 m}
connections: [[ma.flange, link.a], [mb.flange, link.b], [mc.flange, link.c]]
run: {stop: 1 ms}
record: {signals: [ma.x, mc.x]}
"""


def test_positions_that_nobody_gave_meet_a_relation_each_by_its_slope_over_its_mass(simulate, library) -> None:
    """c - a must be 0.2^2/(2 0.5) = 0.04 m: 1 kg moves three quarters of it, 3 kg one quarter."""
    result = simulate(LINKED, (library(ROCKER),))
    assert result["ma.x"][0] == pytest.approx(-0.03, abs=1e-9)
    assert result["mc.x"][0] == pytest.approx(0.01, abs=1e-9)


def test_the_frequencies_of_a_pair_are_those_that_the_page_on_modes_works_out(
    tmp_path: pathlib.Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    files("modes", tmp_path)
    told = re.findall(r"= ([\d.]+) Hz", read("modes"))
    found = []
    for zone in ("held", "sliding"):
        said = play(f"fairlead modes pair.yaml --zones pad={zone} --json")
        found += sorted(mode["frequency"] for mode in json.loads(said)["modes"] if mode["frequency"])
    assert [f"{one:.2f}" for one in found] == told[:3]
    exact = [math.sqrt(1300 / 4), math.sqrt(100), math.sqrt(400)]
    assert found == pytest.approx([one / (2 * math.pi) for one in exact], rel=1e-9)


def shown(page: str, name: str, folder: pathlib.Path) -> pathlib.Path:
    """A file that a page shows."""
    return next(path for path in files(page, folder) if path.name == name)


def test_a_lead_in_and_an_array_on_two_routes_need_the_force_of_one_bend(tmp_path: pathlib.Path) -> None:
    """The capstan of the bend, whichever line is in it: 400 N exp(0.3 pi/2)."""
    result = fairlead.load(shown("routes", "lead.yaml", tmp_path)).run(out=None)
    pull = -result["drive.force"]
    for begin, end in [(4, 8), (18, 21)]:  # s: the lead-in is in the bend; the array is
        mean = pull[(result.t > begin) & (result.t < end)].mean()
        assert mean == pytest.approx(400 * math.exp(0.3 * math.pi / 2), rel=2e-3)
    assert result["array.hose_node[0].x"][result.t < 20.4].min() > 0  # the array has no winch: it must not come to it


WHEEL = (
    "      - {name: wheel, type: Pulley, start: 6 m, angle: 45 deg, radius: 1 m, friction: 0.5, moment: 2.5 kg*m^2,\n"
    "         bearing: {friction: 0.1, radius: 40 mm}}\n"
)


def test_a_pulley_on_both_routes_takes_the_friction_of_one_bearing(tmp_path: pathlib.Path) -> None:
    """T_in - T_out = mu r/R 2 sin(22.5 deg) (T_in + T_out)/2, whichever line is on it."""
    scene = shown("routes", "lead.yaml", tmp_path)
    text = scene.read_text(encoding="utf-8")
    bend = '      - {type: Bend, start: 3 m, angle: 90 deg, radius: 1 m, friction: "{mu}"}\n'
    assert text.count(bend) == 2
    text = text.replace(bend, bend + WHEEL)
    scene.write_text(
        text.replace("  - [lead.outboard", "  - [deck.wheel.shaft, same.wheel.shaft]\n  - [lead.outboard"),
        encoding="utf-8",
    )
    result = fairlead.load(scene).run(out=None)
    half = 0.1 * 0.04 * math.sin(math.radians(22.5))
    pull = 400 * (1 + half) / (1 - half) * math.exp(0.3 * math.pi / 2)
    for begin, end in [(4, 8), (18, 21)]:  # s: the lead-in is in both; the array is
        mean = -result["drive.force"][(result.t > begin) & (result.t < end)].mean()
        assert mean == pytest.approx(pull, rel=2e-3)


def test_a_hydraulic_winch_on_a_route_hauls_at_its_speed_against_the_capstan(tmp_path: pathlib.Path) -> None:
    result = fairlead.load(shown("routes", "hydraulic_haul.yaml", tmp_path)).run(out=None)
    late = result.t > 3.5
    assert result["rim.signal"][late].mean() == pytest.approx(-0.3, rel=5e-3)
    places = np.array([result[name][late] for name in result.match("rope.node[*].x")])
    inside = int(np.argmax((places > 0.3).all(axis=1) & (places < 1.8).all(axis=1)))  # between winch and bend
    tension = result[f"rope.line[{inside}].tension"][late].mean()
    assert tension == pytest.approx(300 * math.exp(0.35 * math.pi / 2), rel=5e-3)


DEVICES = """
components:
  line: {type: Cable, length: 60 m, element: 0.25 m, start: -20 m, tension: 600 N, mass: 1 kg/m, stiffness: 500 kN}
  route:
    type: Route
    stations:
      - {type: Winch, radius: 0.65 m, layers: on}
      - {type: Tensiometer, start: 0.75 m}
      - {type: Deployer, start: 6.5 m, length: 1.5 m, friction: 0.6, clamp: 1.5 kN/m}
      - {type: Pulley, start: 9 m, angle: 45 deg, radius: 1 m, friction: 0.5, bearing: {friction: 0.1, radius: 40 mm}}
      - {type: Sea, start: 13 m, speed: 2 m/s, tail: 100 N}
connections: [[line.path, route.path]]
run: {stop: 1 ms, accuracy: 1e-3}
record: {signals: ["route.*"]}
"""


def test_the_outputs_of_devices_that_the_page_on_routes_lists_are_there_with_their_units(simulate) -> None:
    result = simulate(DEVICES)
    text = read("routes").partition("| Device | Outputs, after")[2].partition("\n\n")[0]
    found = []
    for row in text.splitlines()[2:]:
        _, device, said, _ = (cell.strip() for cell in row.split("|"))
        for names, unit in re.findall(r"((?:`[\w.]+`(?: and )?)+) \[([^\]]+)\]", said):
            for name in re.findall(r"`([\w.]+)`", names):
                assert result.unit(f"route.{device.strip('`').lower()}.{name}") == unit, (device, name)
                found.append(name)
    assert len(found) >= 9


def test_what_has_a_sign_is_said_alike_in_the_glossary_and_in_the_class() -> None:
    (row,) = [line for line in read("glossary").splitlines() if line.startswith("| de-registration")]
    assert "positive where the core is further outboard" in row
    assert "positive when the core is further outboard" in fairlead.describe_type("Registration")


def test_scenes_that_depend_on_an_order_are_named_on_the_page_on_invariance() -> None:
    text = read("invariance")
    scenes = {scene for of_change in KNOWN.values() for scene in of_change}
    assert {f"network {number}" for number in re.findall(r"network (\d+) (?:a|two)", text)} == scenes
