"""Why a hose rucks: what the page says of the cause is what the tensions of the run and closed forms say."""

import math
import re

import numpy as np
import pytest

import fairlead
from fairlead.analysis.margins.ruck import verdicts
from fairlead.analysis.margins.ruck_cause import why
from fairlead.report.page.verdict import verdict

MU, TOW = 0.6, 800.0


@pytest.fixture(scope="module")
def rucking(bundled):
    return bundled("single_bend", {"mu": MU, "run.stop": "8 s"})


def test_the_cause_is_the_bend_whose_friction_the_core_cannot_take(rucking):
    """Tensions beside the bend, read from the recorded rows; the capstan ratio; the limit of bulkheads by strain."""
    (found,) = verdicts(rucking)
    one = found["cause"]
    row = int(np.searchsorted(rucking.t, found["t"], side="right")) - 1
    nodes = [float(rucking[f"line.hose_node[{k}].x"][row]) for k in range(61)]
    inner = max(k for k in range(60) if nodes[k + 1] <= 3.0)
    outer = min(k for k in range(60) if nodes[k] >= 3.0 + math.pi / 2)
    for side, k in (("inboard", inner), ("outboard", outer)):
        recorded = [float(rucking[f"line.{layer}[{k}].tension"][row]) for layer in ("hose", "core")]
        assert one[side] == pytest.approx(recorded, abs=0.05 * TOW)  # a row is up to 10 ms away
    assert sum(one["inboard"]) / sum(one["outboard"]) == pytest.approx(math.exp(MU * math.pi / 2), rel=0.1)  # it swings
    assert one["critical"] == pytest.approx(0.5 * 500 / 508)  # stiction of bulkheads, EA of core and hose
    assert 3.0 < found["place"] < 3.0 + math.pi / 2
    assert one["sum"] == pytest.approx(MU * (3.0 + math.pi / 2 - found["place"]))  # from the place on, over 1 m
    told = dict(why(found))
    assert told["Why"].startswith("Friction on the bend. At t = ")
    assert "s the line slides over it with mu = 0.6" in told["Why"]
    assert f"exp({one['sum']:.3g}) = {math.exp(one['sum']):.3g}" in told["Capstan"]
    assert told["Way out"].startswith("Below mu = 0.492 on the bend")


@pytest.mark.slow
def test_a_line_that_does_not_ruck_is_told_what_holds_it(bundled):
    (found,) = verdicts(bundled("single_bend", {"run.stop": "4 s"}))
    assert dict(why(found))["Why"].startswith("On the bend mu = 0.35 is below 0.492, up to which the bulkheads hold")


def test_the_verdict_names_when_where_why_and_the_contact_that_changed_most(rucking):
    told = {one.about: one for one in verdict(rucking)}
    assert [about for about, _ in told["The hose rucks"].points][:4] == ["When", "Where", "How much", "Why"]
    changes, kinds = {}, {}
    for event in rucking.events:
        kind = event.component.partition("[")[0]
        kinds[kind] = kinds.get(kind, 0) + 1
        if event.component.startswith(("line.inner[", "line.outer[")):
            changes[event.component] = changes.get(event.component, 0) + 1
    most = max(changes.values())
    said = told["What made it slow"].text
    kind, total = max(kinds, key=kinds.get), len(rucking.events)
    assert f"{100 * kinds[kind] / total:.0f} % of {total} changes" in said
    assert f": {most} times, {100 * most / total:.2g} %; no contact stands out" in said
    named = [name for name, n in changes.items() if n == most and re.search(rf"it is {re.escape(name)}[ :]", said)]
    assert named
    assert said.index(f"{kind}[*]") < said.index(named[0])  # the kind first: one of sixty contacts tells little
    assert "In a zone change a part begins or ceases to stick, slide, touch or ruck." in said


def cause_of(rucking, **changes):
    """The verdict with a cause of which some is different."""
    (found,) = verdicts(rucking)
    return found | {"cause": found["cause"] | changes}


def test_a_cause_that_the_numbers_do_not_bear_is_not_told(rucking):
    (alike,) = why(cause_of(rucking, inboard=[-170.0, 900.0], outboard=[-160.0, 800.0]))
    assert alike[1].startswith("Not told: ")
    assert why(cause_of(rucking, moves=True)) == []
    below = dict(why(cause_of(rucking, friction=[0.4, 0.4])))
    assert "cannot pass on all" not in below["Why"]
    assert "Way out" not in below
    (found,) = verdicts(rucking)
    assert why(found | {"cause": None}) == []


@pytest.mark.parametrize(
    ("inboard", "outboard"),
    [
        ([369.1108, 1802.3843], [-99.7667, 948.9211]),
        ([3691.46, 18023.46], [-997.46, 9489.46]),
        ([0.46149, 1.80149], [-200.09949, 0.94949]),
        ([300.4, 700.4], [-99.6, 800.4]),  # the core loses tension as well
    ],
)
def test_figures_of_the_cause_agree_when_a_reader_adds_them(rucking, inboard, outboard):
    text = dict(why(cause_of(rucking, inboard=inboard, outboard=outboard)))["Why"]
    number = r"(-?[0-9]+(?:\.[0-9]+)?)"
    goes = rf"tension goes from {number} N inboard of the bend to {number} N"
    inner, outer = map(float, re.search(goes, text).groups())
    (acts,) = map(float, re.search(rf"These {number} N act", text).groups())
    stay, all_of_it = rf"The other {number} N stay in the hose", rf"as well: {number} N in all"
    left = float((re.search(stay, text) or re.search(all_of_it, text))[1])
    assert inner - outer == pytest.approx(left, abs=1e-9)
    if passed := re.search(rf"pass {number} N of them", text):
        assert acts - float(passed[1]) == pytest.approx(left, abs=1e-9)
    else:
        assert acts + float(re.search(rf"falls by {number} N", text)[1]) == pytest.approx(left, abs=1e-9)
    if grows := re.search(rf"grows from {number} to {number} N", text):
        assert float(grows[2]) - float(grows[1]) == pytest.approx(acts, abs=1e-9)


def test_the_verdict_names_the_greatest_compression_and_the_longest_time_of_rucking(rucking):
    """From the recorded zones of the elements: rows in which none rucks lie outside of that time."""
    told = dict({one.about: one for one in verdict(rucking)}["The hose rucks"].points)
    begin, end = re.search(r"From ([0-9.]+) s to (the end of the run|[0-9.]+)", told["When"]).groups()
    end = rucking.run["end_time"] if end.startswith("the") else float(end)
    counts = {}
    for event in rucking.events:
        if event.component.startswith("line.hose["):
            counts.setdefault(event.component, []).append((event.t, event.zone_to in ("beyond", "rucking")))
    spans = [(t, after[k + 1][0] if k + 1 < len(after) else rucking.run["end_time"])
             for after in counts.values() for k, (t, on) in enumerate(after) if on]  # fmt: skip
    inside = np.linspace(float(begin), end, 200)  # told to three digits
    assert all(any(a - 5e-3 <= t <= b + 5e-3 for a, b in spans) for t in inside)
    tensions = rucking.elements("line.hose[*].tension")
    most, t = re.search(r"greatest compression is ([0-9.]+) N at t = ([0-9.]+) s", told["How much"]).groups()
    assert float(most) >= -tensions.values.min() - 0.5  # rounded; rows may miss it
    assert float(most) == pytest.approx(-tensions.values.min(), rel=2e-2)
    row = int(tensions.values.min(axis=1).argmin())
    assert float(t) == pytest.approx(float(tensions["time"][row]), abs=0.011)


def test_a_run_without_coefficients_has_no_cause_but_a_verdict(rucking):
    """A run of an earlier version, whose record of its route lacks them."""
    old = fairlead.Result.open(rucking.path)
    for record in old.run["routes"]:
        for station in record["stations"]:
            del station["friction"]
    (found,) = verdicts(old)
    assert found["rucks"]
    assert found["cause"] is None


TWO = """
schema: 1
name: two_bends
components:
  line:
    type: ArrayModule
    length: 8 m
    element: 0.25 m
    start: 1 m
    tension: 500 N
    ruck_force: 60 N
    hose: {mass: 1.6 kg/m, stiffness: 8 kN, damping_ratio: 0.05}
    core: {mass: 4.2 kg/m, stiffness: 500 kN, damping_ratio: 0.05}
    bulkhead_friction: {curve: coulomb, coulomb: 0.3}
  way:
    type: Route
    stations:
      - {type: Bend, name: near, start: 3 m, angle: 60 deg, radius: 1 m, edge: 0.25 m, friction: 0.6}
      - {type: Bend, name: far, start: 6 m, angle: 30 deg, radius: 1 m, edge: 0.25 m, friction: 0.2}
  haul: {type: MotionSource, velocity: {ramp: {to: -0.3 m/s, over: 0.5 s}}}
  tow: {type: ForceSource, force: 500 N}
connections: [[haul.flange, line.inboard], [tow.flange, line.outboard], [line.path, way.path]]
run: {stop: 2 s, accuracy: 1e-3}
record: {every: 10 ms, signals: ["line.hose[*].tension", "line.core[*].tension", "line.hose_node[*].x"]}
"""


def test_of_several_bends_the_one_at_the_place_is_told_and_the_sum_from_the_place_on(tmp_path):
    (tmp_path / "two.yaml").write_text(TWO, encoding="utf-8")
    (found,) = verdicts(fairlead.load(tmp_path / "two.yaml").run(out=None))
    assert found["rucks"]
    told = dict(why(found))
    assert told["Why it began"].startswith("Friction on near.")  # it rucks elsewhere later
    assert "runs over far to element" in told["Capstan"]  # it rucks right behind near
    assert found["cause"]["sum"] == pytest.approx(0.2 * math.pi / 6)
    assert "Below mu = 0.295 on near" in told["Way out"]  # 0.3 * 500/508


APART = """
schema: 1
name: two_bends_apart
components:
  line:
    type: ArrayModule
    length: 20 m
    element: 0.25 m
    start: 1.5 m
    tension: 800 N
    ruck_force: 160 N
    hose: {mass: 1.6 kg/m, stiffness: 8 kN, damping_ratio: 0.05}
    core: {mass: 4.2 kg/m, stiffness: 500 kN, damping_ratio: 0.05}
    bulkhead_friction: {curve: stribeck, stiction: 0.50, coulomb: 0.40, velocity: 20 mm/s}
  route:
    type: Route
    stations:
      - {type: Bend, name: near, start: 3 m, angle: 60 deg, radius: 1 m, edge: 0.25 m, friction: {near}}
      - {type: Bend, name: far, start: 7 m, angle: 90 deg, radius: 1 m, friction: {far}}
  haul: {type: MotionSource, velocity: {ramp: {to: -0.3 m/s, over: 1 s}}}
  tow: {type: ForceSource, force: 800 N}
connections: [[haul.flange, line.inboard], [tow.flange, line.outboard], [line.path, route.path]]
run: {stop: 1.2 s, accuracy: 1e-3}
record: {every: 10 ms, signals: ["line.hose[*].tension", "line.core[*].tension", "line.hose_node[*].x"]}
"""


@pytest.mark.parametrize(("near", "far", "rucks"), [(0.8, 0.2, True), (0.8, 0.01, True), (0.2, 0.2, False)])
def test_a_bend_farther_away_is_told_where_the_core_takes_more_than_friction_at_the_one_beside(
    tmp_path, near, far, rucks
):
    """It first rucks beside far, whose friction does not matter, as the three runs show."""
    text = APART.replace("{near}", str(near)).replace("{far}", str(far))
    (tmp_path / "apart.yaml").write_text(text, encoding="utf-8")
    (found,) = verdicts(fairlead.load(tmp_path / "apart.yaml").run(out=None))
    assert found["rucks"] is rucks
    if rucks:
        (said,) = (words for about, words in why(found) if about.startswith("Why"))
        assert said.startswith("Friction on near.")
