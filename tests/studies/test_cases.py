"""Cases in memory: figures against closed forms of the block on the belt, and what goes wrong in one case."""

import math
from pathlib import Path

import numpy as np
import pytest

import fairlead
from fairlead import running as run
from fairlead.cases import Cases
from fairlead.errors import ModelError
from fairlead.integrate.problem import Block, End
from fairlead.watch import Watch

PARTS = Path(__file__).parents[2] / "models" / "single_parts"
# Block on a belt (tests/reference): stiffness 100 N/m, mass 1 kg, belt 0.2 m/s, stiction 10 N, sliding 6 N.
# It sticks until the spring pulls with 10 N, slips about x = 0.06 m, and comes to the speed of the belt again.
MODEL, OMEGA, SPEED = fairlead.load("belt", set={"run.accuracy": "1e-8"}), 10.0, 0.2
LET_GO, CENTRE = 0.1, 0.06


def slip_time(let_go: float = LET_GO, centre: float = CENTRE) -> float:
    """Time from letting go to being captured: x - centre = a cos(w t) + (v / w) sin(w t), until x' = v again."""
    return 2 * (math.pi - math.atan((let_go - centre) * OMEGA / SPEED)) / OMEGA


def test_extremes_of_the_block_are_those_of_the_circle_in_the_phase_plane() -> None:
    row = Cases(MODEL, {"peak": "peak(block.x)", "tension": "peak(spring.tension)"}).row({})
    radius = math.hypot(LET_GO - CENTRE, SPEED / OMEGA)
    assert row.figures["peak"] == pytest.approx(CENTRE + radius, abs=1e-7)
    assert row.figures["tension"] == pytest.approx(100.0 * (CENTRE + radius), abs=1e-5)


def test_times_of_changes_are_those_of_sticking_and_slipping() -> None:
    figures = {"let_go": "time(pad, backward)", "captured": "time(pad, held)", "again": "time(pad, backward, 2)"}
    found = Cases(MODEL, figures).row({}).figures
    assert found["let_go"] == pytest.approx(LET_GO / SPEED, abs=1e-7)
    assert found["captured"] - found["let_go"] == pytest.approx(slip_time(), abs=1e-7)
    assert found["again"] - found["let_go"] == pytest.approx(0.4 + slip_time(), abs=1e-7)


def test_means_over_sticking_and_slipping_are_the_integrals() -> None:
    begin, end = LET_GO / SPEED, LET_GO / SPEED + slip_time()
    span = f"{begin - 0.4} s, {end} s"  # a stroke of 0.08 m before letting go, then the slip
    figures = {"mean": f"mean(block.x, {span})", "rms": f"rms(block.v, {span})", "at": f"at(block.x, {begin - 0.1} s)"}
    found = Cases(MODEL, figures).row({}).figures
    t = np.linspace(0.0, slip_time(), 20001)
    x = CENTRE + (LET_GO - CENTRE) * np.cos(OMEGA * t) + SPEED / OMEGA * np.sin(OMEGA * t)
    v = -(LET_GO - CENTRE) * OMEGA * np.sin(OMEGA * t) + SPEED * np.cos(OMEGA * t)
    whole = 0.4 + slip_time()
    assert found["mean"] == pytest.approx((0.4 * 0.06 + np.trapezoid(x, t)) / whole, abs=1e-6)
    assert found["rms"] == pytest.approx(math.sqrt((0.4 * SPEED**2 + np.trapezoid(v**2, t)) / whole), rel=1e-5)
    assert found["at"] == pytest.approx(LET_GO - 0.1 * SPEED, abs=1e-8)


def test_a_case_is_the_run_of_the_model_with_these_values() -> None:
    values = {"pad.normal_force": "12 N", "block.mass": 1.5}
    figures = {"end": "end(block.x)", "n": "switches(pad)", "lost": "energy(dissipated)", "peak": "peak(pad.friction)"}
    cases = Cases(MODEL, figures)
    cases.row({"pad.normal_force": "9 N"})
    row, result = cases.row(values), MODEL.with_values(values).run(out=None)
    assert row.ok
    assert row.figures["end"] == pytest.approx(result["block.x"][-1], abs=1e-12)
    assert row.figures["n"] == len(result.events) == row.counters["switches"]
    assert row.figures["lost"] == pytest.approx(result.energy["energy"][1], rel=1e-9)
    assert row.figures["peak"] == pytest.approx(result.extremes("pad.friction").highest, abs=1e-9)


def test_what_goes_wrong_in_a_case_is_a_row_with_its_reason() -> None:
    cases = Cases(MODEL, {"own": _fails_when_heavy}, max_steps=300)
    assert cases.row({"run.stop": "2 s"}).status == "finished"
    assert cases.row({}).status == "budget"
    assert "300" in cases.row({}).sentence
    refused = cases.row({"block.mass": "2 N"})
    assert refused.status == "refused"
    assert "block" in refused.sentence
    assert "kg" in refused.sentence
    error = cases.row({"run.stop": "2 s", "block.mass": "3 kg"})
    assert (error.status, error.figures) == ("error", {})
    assert "too heavy" in error.sentence


def _fails_when_heavy(result):
    if result.run["extremes"]["spring.tension"][2] > 0 and result["block.v"][-1] != result["block.v"][-1]:
        return 0.0
    if len(result.events) < 4:
        raise ValueError("too heavy")
    return 1.0


def test_a_function_sees_the_result() -> None:
    row = Cases(MODEL, {"own": lambda result: result["block.x"][0] + 1.0}).row({"run.stop": "1 s"})
    assert row.figures["own"] == 1.0


def test_of_a_part_made_of_others_the_one_with_zones_is_meant(scene) -> None:
    """It asked "Did you mean t?", which is a source of torque."""
    model = scene("""
        components:
          j: {type: Inertia, moment: 0.5 kg*m^2, speed: 20 rad/s}
          b: {type: Brake, radius: 0.1 m, normal_force: 50 N, curve: 0.4}
          t: {type: TorqueSource, torque: 1 N*m}
        connections: [[j.shaft, b.shaft, t.shaft]]
        run: {stop: 20 s}
    """)
    with pytest.raises(ModelError, match=r"no component of the name b has zones\. Did you mean b\.contact\?"):
        Cases(model, {"stops": "time(b, held)"})


def test_all_mistakes_in_figures_come_at_once() -> None:
    texts = ["peek(block.x)", "peak(blok.x)", "end(*.x)", "time(pad, stuk)", "mean(block.x, 3 s, 2 s)", "block.x",
             "at(block.x, 50 s)", "at(block.x, 2 N)", "margin(ruck)", "energy(heat)"]  # fmt: skip
    wrong = {f"figure {k}": text for k, text in enumerate(texts)}
    with pytest.raises(ModelError) as raised:
        Cases(MODEL, wrong)
    told = str(raised.value)
    assert len(raised.value.faults) == len(wrong)
    for word in (
        "Did you mean peak?",
        "block.x?",
        "stands for",
        "held",
        "empty",
        "goes from 0 s to 40 s",
        "dissipated",
    ):
        assert word in told


def test_contacts_of_a_line_with_its_devices_can_be_asked_for_before_anything_was_checked() -> None:
    """They are there once the line is laid into its route."""
    cases = Cases(fairlead.load("single_bend"), {"slip": "largest(line.outer[*].slip)"})
    assert cases.units == {"slip": "m/s"}


def test_a_key_hangs_on_values_and_not_on_their_order() -> None:
    cases, others = Cases(MODEL, {"n": "switches()"}), Cases(MODEL, {"n": "switches(pad)"})
    one = {"block.mass": "2 kg", "pad.normal_force": "9 N"}
    assert cases.key(one) == cases.key(dict(reversed(one.items())))
    assert len({cases.key(one), cases.key({**one, "block.mass": "3 kg"}), others.key(one)}) == 3


def test_an_event_that_never_comes_has_no_time() -> None:
    row = Cases(MODEL, {"t": "time(pad, off)"}).row({"run.stop": "1 s"})
    assert row.ok
    assert math.isnan(row.figures["t"])


def test_another_structure_gives_what_a_fresh_model_gives() -> None:
    cases = Cases(fairlead.load("belt", set={"run.stop": "2 s"}), {"end": "end(block.x)"})
    for values in (
        {"pad.method": "binding"},
        {"pad.method": "hold"},
        {"pad.method": "binding", "pad.normal_force": "9 N"},
    ):
        fresh = fairlead.load("belt", set={"run.stop": "2 s", **values}).run(out=None)
        assert cases.row(values).figures["end"] == pytest.approx(fresh["block.x"][-1], abs=1e-12)


def test_figures_without_extremes_cost_no_rows_between_those_of_the_grid(monkeypatch: pytest.MonkeyPatch) -> None:
    """And are the same beside figures that do. A netlist with limits keeps them."""
    rows: list[int] = []

    class Watched(Watch):
        def __call__(self, block: Block) -> End | None:
            rows.append(len(block.t))
            return super().__call__(block)

    monkeypatch.setattr(run, "Watch", Watched)
    plain = {"end": "end(block.x)", "let_go": "time(pad, backward)", "n": "switches(pad)", "lost": "energy(dissipated)"}
    alone = Cases(MODEL, plain).row({})
    few = sum(rows)
    rows.clear()
    beside = Cases(MODEL, {**plain, "closure": "energy(closure)"}).row({})
    assert {name: beside.figures[name] for name in plain} == alone.figures
    # The start, the end, both sides of every change; one more where the run pauses.
    assert few <= 3 + 2 * alone.figures["n"] < sum(rows) / 4


def many_swings(count: int) -> str:
    """Equal bodies of 1 kg on springs of 100 N/m, from 1 m/s on: x = 0.1 m sin(10 t); four rows in a period."""
    parts = "".join(f"""
      s{k}: {{type: Spring, stiffness: 100 N/m}}
      b{k}: {{type: Mass, mass: 1 kg, velocity: 1 m/s}}""" for k in range(count))
    wires = "".join(f"\n      - [g.flange, s{k}.a]\n      - [s{k}.b, b{k}.flange]" for k in range(count))
    return f"""
    components:
      g: {{type: Ground}}{parts}
    connections:{wires}
    run: {{stop: 2 s, accuracy: 1e-6}}
    record: {{signals: [b0.x], every: 160 ms}}
    """


OF_A_SWING = {"at": "at(b0.x, 1.37 s)", "mean": "mean(b0.x, 0 s, 1.7 s)", "rms": "rms(b0.x, 0 s, 1.7 s)",
              "low": "lowest(s0.tension)", "high": "peak(b0.x)", "end": "end(b0.x)"}  # fmt: skip


def closed_forms() -> dict[str, float]:
    square = 0.5 - math.sin(2 * 17.0) / (4 * 17.0)
    return {"at": 0.1 * math.sin(13.7), "mean": 0.1 * (1 - math.cos(17.0)) / 17.0, "rms": 0.1 * math.sqrt(square),
            "low": -10.0, "high": 0.1, "end": 0.1 * math.sin(20.0)}  # fmt: skip


@pytest.mark.parametrize("engine", ["rodas", "stepping"])
@pytest.mark.parametrize(("beside", "count"), [
    ({}, 1), ({"own": lambda result: float(len(result.t))}, 1), ({"own": "peak(b*.x)"}, 33), ({"own": "broken()"}, 1),
])  # fmt: skip
def test_the_accuracy_of_a_figure_does_not_depend_on_which_others_are_asked_for(scene, engine, beside, count) -> None:
    model = scene(many_swings(count), **{"run.engine": engine})
    row = Cases(model, {**beside, **OF_A_SWING}).row({})
    assert list(row.figures) == [*beside, *OF_A_SWING], row.sentence
    exact = closed_forms()
    for name, value in exact.items():
        assert row.figures[name] == pytest.approx(value, abs=2e-5 * (10.0 if name == "low" else 0.1)), name


def test_a_function_beside_them_sees_the_rows_that_the_netlist_asks_for(scene) -> None:
    """From 0 s to 1.92 s every 160 ms, and the end; of b0.x alone."""
    seen: list[tuple[int, list[str]]] = []
    figures = {"own": lambda result: seen.append((len(result.t), list(result))) or 0.0, "mean": "mean(s1.tension)"}
    assert Cases(scene(many_swings(2)), figures).row({}).ok
    assert seen == [(14, ["b0.x"])]


def test_of_signals_of_which_the_extremes_are_wanted_no_rows_are_kept(scene, monkeypatch: pytest.MonkeyPatch) -> None:
    kept: list[list[str]] = []
    own = run._sink
    monkeypatch.setattr(run, "_sink", lambda path, signals, *rest, **more: (
        kept.append([one.name for one in signals]), own(path, signals, *rest, **more))[1])  # fmt: skip
    row = Cases(scene(many_swings(3)), {"peak": "peak(b*.x)", "rms": "rms(b1.v)"}).row({})
    assert row.figures["peak"] == pytest.approx(0.1, abs=1e-6)
    assert kept == [["b1.v"]]


def test_curves_are_told_beside_figures() -> None:
    """They ended with an error: what the figures need was not recorded."""
    let_go = LET_GO / SPEED
    row, curves = Cases(MODEL, {"peak": "peak(block.v)"}).curves({}, ["block.x"], np.array([0.3 * let_go]))
    assert row.ok, row.sentence
    assert row.figures["peak"] == pytest.approx(SPEED, abs=1e-6)
    assert curves[0, 0] == pytest.approx(0.3 * LET_GO, abs=1e-8)


def test_a_peak_close_to_the_end_of_a_step_is_found(scene) -> None:
    """The peak 0.1 m passes through the steps as the stiffness changes; that of an end is 1e-6 off."""
    cases = Cases(scene(many_swings(1)), {"peak": "peak(b0.x)"})
    found = np.array([cases.row({"s0.stiffness": k, "run.stop": 0.3}).figures["peak"] * math.sqrt(k)
                      for k in np.linspace(90.0, 110.0, 60)])  # fmt: skip
    assert np.abs(found - 1.0).max() < 2e-8


@pytest.mark.parametrize("model", ["unwinder", "arm_with_cylinder"])
def test_an_engine_that_does_not_run_a_model_refuses_the_case(model: str) -> None:
    """It had the status of a mistake in fairlead or in a figure, `error`."""
    named = fairlead.load(PARTS / f"{model}.yaml", set={"run.stop": "0.1 s"})
    signal = named.system.signals[0].name
    row = Cases(named, {"most": f"peak({signal})"}).row({"run.engine": "stepping"})
    assert row.status == "refused"
    assert row.sentence.startswith("run.engine: stepping does not")
    assert "Take run.engine: rodas" in row.sentence


@pytest.mark.parametrize(("value", "word"), [("high", "high"), ([1.0, 2.0], "list of 2"), (2j, "2j")])
def test_a_figure_whose_function_returns_no_number_says_which_and_what(value: object, word: str) -> None:
    row = Cases(fairlead.load("belt", set={"run.stop": "0.1 s"}), {"own": lambda result: value}).row({})
    assert row.status == "error"
    assert row.sentence.startswith("own: its function returns ")
    assert word in row.sentence
    assert "no number" in row.sentence


def test_a_figure_that_raises_is_an_error_and_no_refusal() -> None:
    def wants_a_folder(result):
        return len(str(result.folder))

    row = Cases(fairlead.load("belt", set={"run.stop": "0.1 s"}), {"own": wants_a_folder}).row({})
    assert row.status == "error"
