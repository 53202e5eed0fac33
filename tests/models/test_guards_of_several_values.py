"""Guards of several values, of which all must have risen, that have only inside a step (integrate/events/edges.py)."""

from math import sqrt

import pytest

import fairlead

PARTS = '''
from fairlead.component import *

SPRUNG = Zones("waits", "trips")


class Gate(Component):
    """Pushes once the body has passed a place before a time."""

    a = Translational()
    place = Parameter("m", "where")
    until = Parameter("s", "when at the latest")
    push = Parameter("N", "with what")
    zones = SPRUNG

    @zone("waits")
    def waits(p, a, t):
        return Law(a=0)

    @zone("trips")
    def trips(p, a, t):
        return Law(a=-p.push, supplied=p.push * a.v)

    @guard("waits", to="trips", unit="m")
    def passed(p, a, t):
        return a.x - p.place, (p.until - t) * 1


class Window(Component):
    """Pushes once the body has been between two places."""

    a = Translational()
    low = Parameter("m", "from")
    high = Parameter("m", "to")
    push = Parameter("N", "with what")
    zones = SPRUNG
    exempt = {"settles": "a detector that remembers"}

    @zone("waits")
    def waits(p, a):
        return Law(a=0)

    @zone("trips")
    def trips(p, a):
        return Law(a=-p.push, supplied=p.push * a.v)

    @guard("waits", to="trips", unit="m")
    def inside(p, a):
        return a.x - p.low, p.high - a.x
'''


def end_of(tmp_path, part, more=(), *, engine, scale=1.0, name="part", beside=0):
    """Position and speed of a body of 1 kg at 3 m/s (times `scale`) after 3 s."""
    library, netlist = tmp_path / "parts.py", tmp_path / "scene.yaml"
    library.write_text(PARTS.replace("(p.until - t) * 1", "(p.until - t) * p.place / p.until"), encoding="utf-8")
    parts = [f"  {name}: {{{part}}}", f"  block: {{type: Mass, mass: 1 kg, velocity: {3 * scale} m/s}}", *more]
    joins = [f"{name}.a, block.flange" + "".join(f", {one.split(':')[0].strip()}.flange" for one in more)]
    for k in range(beside):
        parts += [f"  m{k}: {{type: Mass, mass: 1 kg}}", f"  g{k}: {{type: Ground}}"]
        parts += [f"  c{k}: {{type: Contact, normal_force: 10 N, curve: 0.3}}"]
        joins += [f"m{k}.flange, c{k}.a", f"g{k}.flange, c{k}.b"]
    text = ["schema: 1", "components:", *parts, "connections:", *(f"  - [{join}]" for join in joins)]
    netlist.write_text("\n".join([*text, f"run: {{stop: 3 s, engine: {engine}}}"]), encoding="utf-8")
    result = fairlead.load(netlist, libraries=[library]).run(out=None)
    return result["block.x"][-1], result["block.v"][-1]


@pytest.mark.parametrize("scale", [1.0, 1e-3, 1e3])
@pytest.mark.parametrize("engine", ["rodas", "stepping", "ida"])
def test_a_place_that_is_passed_in_time_counts_however_soon_after_that_the_time_is_over(tmp_path, engine, scale):
    """x = 3 t - t^2 passes 2.2 m at 1.2764 s, before 1.3 s; from there on it is pushed as much as it is pulled."""
    hand = [f"  hand: {{type: ForceSource, force: {-2 * scale} N}}"]
    part = f"type: Gate, place: {2.2 * scale} m, until: 1.3 s, push: {2 * scale} N"
    _x, v = end_of(tmp_path, part, hand, engine=engine, scale=scale, name="zz")
    assert v == pytest.approx(sqrt(9 - 4 * 2.2) * scale, rel=2e-4, abs=1e-5)  # the accuracy, of 0.1 m/s


@pytest.mark.parametrize("engine", ["rodas", "stepping", "ida"])
def test_a_place_that_is_passed_too_late_does_not_count(tmp_path, engine):
    hand = ["  hand: {type: ForceSource, force: -2 N}"]
    _x, v = end_of(tmp_path, "type: Gate, place: 2.2 m, until: 1.27 s, push: 2 N", hand, engine=engine)
    assert v == pytest.approx(-3.0, rel=1e-4)


@pytest.mark.parametrize("beside", [0, 60])
@pytest.mark.parametrize("engine", ["rodas", "stepping"])
def test_a_window_that_is_passed_at_full_speed_is_seen(tmp_path, engine, beside):
    """10 mm at 3 m/s, in steps as long as the run; then 2 m/s^2 from 1 m on."""
    x, v = end_of(tmp_path, "type: Window, low: 1 m, high: 1.01 m, push: 2 N", engine=engine, beside=beside)
    left = 3.0 - 1.0 / 3.0
    assert v == pytest.approx(3.0 + 2.0 * left, rel=1e-3)
    assert x == pytest.approx(1.0 + 3.0 * left + left**2, rel=1e-3)
