"""`fairlead cost`: what it says of a scene whose motion is known in closed form, and that its advice holds."""

import importlib
import json
from types import SimpleNamespace

import numpy as np
import pytest
from typer.testing import CliRunner

import fairlead
import fairlead.analysis.cost.timed_run as timed_runs
from fairlead.analysis.cost.boxed_runs import BoxedRuns
from fairlead.analysis.cost.choice import choose, front, knee
from fairlead.analysis.cost.cost import cost
from fairlead.analysis.cost.deviation import OutputError
from fairlead.analysis.cost.kept_runs import KeptRuns
from fairlead.analysis.cost.ladder import Equations, Ladder, Rung, own_equations, rungs
from fairlead.analysis.cost.mesh_errors import MeshErrors, order_of
from fairlead.analysis.cost.meshes import Mesh
from fairlead.analysis.cost.references import References
from fairlead.analysis.cost.study import Reference, Row, Study
from fairlead.analysis.cost.timed_run import Timed
from fairlead.cli import app
from fairlead.cli.cost_table import _cells
from tests.reference.belt import StickSlipBelt

STOP = {"run.stop": "4 s"}
AMPLE = 1e6
"""s: a budget that decides nothing, however slow the machine; what budgets decide has clocks of its own."""
LADDER = Ladder(accuracies=(1e-2, 1e-4), engines=("rodas",), treatments=("binding",))


def belt(more):
    return fairlead.load("belt", set={**STOP, **more})


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("kept")


@pytest.fixture(scope="module")
def study(folder):
    return cost(belt, LADDER, budget=AMPLE, signals=["block.x", "block.v"], kept=KeptRuns(folder), full=True)


@pytest.mark.slow
def test_two_methods_agree_on_the_reference(study):
    assert study.reference is not None
    assert study.reference.agrees
    assert not study.sensitive


@pytest.mark.slow
def test_the_three_errors_are_apart(study):
    """Tight runs of a law that creeps have no numerical error and yet a modelling error."""
    exact = next(row for row in study.rows if row.rung.equations.exact and row.rung.accuracy == 1e-4)
    creeping = next(row for row in study.rows if not row.rung.equations.exact and row.rung.accuracy == 1e-4)
    assert study.size(exact.modelling) == 0
    assert study.size(creeping.modelling) > 10 * study.size(creeping.numerical)
    assert exact.discretisation is None  # the scene has no elements


def test_an_error_is_what_it_says_against_the_closed_form(study):
    """The numerical error of block.x is the distance from the closed form, up to the floor."""
    closed = StickSlipBelt()
    times = np.linspace(0.0, 4.0, 1001)
    exact = np.asarray(closed.position(times))
    for row in study.rows:
        if row.rung.equations.exact:
            rms = float(np.sqrt(np.mean((row.timed.values[:, study.outputs.index("block.x")] - exact) ** 2)))
            found = next(one for one in row.numerical if one.name == "block.x")
            assert found.rms == pytest.approx(rms, rel=0.02, abs=study.floor * found.scale)


def test_the_advice_holds_when_it_is_followed(study, tmp_path):
    """A run with the settings advised for 1 % is within 1 % of the closed form."""
    choice = choose(study, 0.01)
    assert choice.row is not None, choice.sentence
    result = belt(choice.settings).run(out=tmp_path / "run")
    span = np.ptp(StickSlipBelt().position(np.linspace(0.0, 4.0, 1001)))
    rms = np.sqrt(np.mean((result["block.x"] - StickSlipBelt().position(result.t)) ** 2))
    assert rms < 0.01 * span


def test_nothing_is_faster_and_more_exact_than_the_front(study):
    points = front(study)
    assert [seconds for seconds, _, _ in points] == sorted(seconds for seconds, _, _ in points)
    assert [size for _, size, _ in points] == sorted((size for _, size, _ in points), reverse=True)
    assert knee(points) is None or any(row is knee(points) for _, _, row in points)


def test_a_study_goes_on_where_it_stopped(folder, study):
    """The second time all runs come from the folder: even no time at all is enough."""
    again = cost(belt, LADDER, budget=1e-9, signals=["block.x", "block.v"], kept=KeptRuns(folder), full=True)
    assert [row.rung.label for row in again.rows] == [row.rung.label for row in study.rows]
    assert again.left_out == []
    other = cost(belt, LADDER, budget=1e-9, signals=["block.x"], kept=KeptRuns(folder), full=True)
    assert other.rows == []  # other outputs, other runs
    assert other.left_out


def test_ctrl_c_keeps_what_was_measured(monkeypatch, folder):
    import fairlead.analysis.cost.boxed_runs as module

    def pressed(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr(module, "timed_run", pressed)
    found = cost(belt, LADDER, budget=AMPLE, signals=["block.v"], kept=KeptRuns(folder), full=True)
    assert found.interrupted
    assert found.rows == []


CHAOS = """
    components:
      belt: {type: MotionSource, velocity: 0.3 m/s}
      ground: {type: Ground}
      shaker: {type: MotionSource, position: {sine: {amplitude: 0.5 m, frequency: 0.25 Hz}}}
      one: {type: Mass, mass: 1 kg, position: 0.1 m, velocity: 0 m/s}
      two: {type: Mass, mass: 1.3 kg, position: 0 m, velocity: 0 m/s}
      spring_one: {type: Spring, stiffness: 1 N/m}
      spring_two: {type: Spring, stiffness: 1 N/m}
      between: {type: Spring, stiffness: 0.3 N/m}
      pad_one: {type: Contact, normal_force: 1 N, curve: {curve: coulomb, stiction: 1.0, coulomb: 0.4}}
      pad_two: {type: Contact, normal_force: 1.4 N, curve: {curve: coulomb, stiction: 1.0, coulomb: 0.4}}
    connections:
      - [shaker.flange, spring_one.a]
      - [ground.flange, spring_two.a]
      - [spring_one.b, one.flange, between.a, pad_one.b]
      - [spring_two.b, two.flange, between.b, pad_two.b]
      - [belt.flange, pad_one.a, pad_two.a]
    friction: {method: hold}
    run: {stop: 3000 s, accuracy: 1e-3}
"""


def test_a_scene_that_is_sensitive_to_everything_is_said_to_be(scene, monkeypatch):
    """Two shaken stick-slip blocks on a belt: nearby motions part, so that only statistics can be compared."""
    # the second method is rodas3p
    monkeypatch.setattr("fairlead.analysis.cost.references.engines_here", lambda: ["rodas"])
    path = scene(CHAOS).netlist.path
    found = cost(lambda more: fairlead.load(path, set=more), Ladder((1e-2,), ("rodas",), (), (), ()), budget=AMPLE,
                 signals=["one.x", "two.x"], full=True)  # fmt: skip
    assert found.sensitive
    row = next(row for row in found.rows if row.numerical)
    assert all(one.relative > 0.1 for one in row.numerical)  # moment by moment it is another motion
    assert found.size(row.numerical) < 0.1  # and yet its mean and its spread are those of the reference


TIED = """
    components:
      b1: {type: Mass, mass: 1 kg}
      b2: {type: Mass, mass: 1 kg}
      b3: {type: Mass, mass: 1 kg}
      p1: {type: Contact, normal_force: 10 N, curve: {curve: coulomb, stiction: 0.5, coulomb: @SLIDING@}}
      p2: {type: Contact, normal_force: 10 N, curve: {curve: coulomb, stiction: 0.5, coulomb: @SLIDING@}}
      push: {type: ForceSource, force: {step: {at: 0.1 s, to: 10 N}}}
      pull: {type: ForceSource, force: {step: {at: 0.1 s, to: -10 N}}}
    connections:
      - [b1.flange, p1.a, push.flange]
      - [p1.b, b2.flange, p2.a]
      - [p2.b, b3.flange, pull.flange]
    run: {stop: 0.2 s}
"""


@pytest.mark.parametrize(("sliding", "several"), [("0.4", True), ("0.5", False)])
def test_a_reference_that_is_one_of_several_solutions_is_not_called_the_only_one(scene, sliding, several):
    """Where friction falls as it lets go, the first of two that tie would relieve the other; else one solution is."""
    path = scene(TIED.replace("@SLIDING@", sliding)).netlist.path
    found = cost(lambda more: fairlead.load(path, set=more), Ladder((1e-3,), ("rodas",), (), (), ()), budget=AMPLE,
                 full=True)  # fmt: skip
    told = [remark for remark in found.remarks if "p1, p2 at t = 0.1 s came to their limits together" in remark]
    assert len(told) == several


def test_the_command_writes_table_figure_and_settings_that_run_accepts(tmp_path, monkeypatch):
    monkeypatch.setattr("fairlead.analysis.cost.boxed_runs.WORTH_WAITING", AMPLE)
    words = ["cost", "belt", "--set", "run.stop=2 s", "--accuracy", "1e-3", "--engine", "rodas", "--friction", "hold",
             "--output", "block.x", "--budget", f"{AMPLE:g} s", "--fresh", "--out", str(tmp_path),
             "--target", "5%"]  # fmt: skip
    done = CliRunner().invoke(app, [*words, "--write", str(tmp_path / "chosen.yaml")])
    assert done.exit_code == 0, done.output
    assert "5 %: accuracy 1e-3 with rodas" in done.output
    assert (tmp_path / "cost.png").read_bytes().startswith(b"\x89PNG")
    record = json.loads((tmp_path / "cost.json").read_text())
    assert record["rows"][0]["numerical"][0]["name"] == "block.x"
    run = ["run", "belt", "--settings", str(tmp_path / "chosen.yaml"), "--out", str(tmp_path / "run"), "--json"]
    done = CliRunner().invoke(app, run)
    assert done.exit_code == 0, done.output
    told = json.loads(done.stdout)
    assert told["settings"]["accuracy"] == 1e-3
    assert told["settings"]["engine"] == "rodas"
    assert told["end_time"] == 2.0


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["--output", "block.y"], "--output block.y: the netlist records no such signal. Did you mean block.x?"),
        (["--engine", "rodos"], "--engine rodos: there is no such engine. Did you mean rodas?"),
        (["--accuracy", "1"], "--accuracy 1 is not between 1e-10 and 0.1"),
        (["--budget", "0 s"], "--budget 0 s: it must be above zero"),
        (["--budget", "3 m"], "length, not a time"),
    ],
)
def test_a_wrong_option_is_told(words, told):
    done = CliRunner().invoke(app, ["cost", "belt", *words])
    assert done.exit_code == 2
    assert told in " ".join(done.output.replace("│", " ").split())


def references(found, monkeypatch, converges=True):
    """What References makes of tight runs that are given: engine -> the value of one output over time."""
    runs = BoxedRuns(None, "", ["a.x"], (0.0, 1.0), 1.0, 1e-7, KeptRuns(None))
    made = References(runs, ["m"], [])
    t = np.linspace(0, 1, 1001)
    timed = {name: Timed("finished", values=np.reshape(t + off, (-1, 1))) for name, off in found.items()}
    monkeypatch.setattr(runs, "tightly", lambda equations, engine, *_: timed.get(engine))
    monkeypatch.setattr(runs, "run", lambda *_: None)
    monkeypatch.setattr(made, "brief", lambda: True)
    monkeypatch.setattr(made, "converges", lambda *_: converges)
    monkeypatch.setattr("fairlead.analysis.cost.references.engines_here", lambda: ["rodas", "stepping", "ida"])
    return made.of_scene(Equations(""))


def test_where_two_engines_do_not_agree_a_third_decides(monkeypatch):
    found = references({"rodas": 0.0, "ida": 0.1, "stepping": 1e-5}, monkeypatch)
    assert found.label == "rodas and stepping at accuracy 1e-07"
    assert found.spread == pytest.approx(1e-5)
    assert found.agrees
    assert found.dissent == "ida is 10 % from them (a.x)"
    outvoted = references({"rodas": 0.1, "ida": 1e-5, "stepping": 0.0}, monkeypatch)
    assert outvoted.label == "ida and stepping at accuracy 1e-07"


def test_where_no_two_of_three_engines_agree_the_spread_is_the_floor(monkeypatch):
    found = references({"rodas": 0.0, "ida": 0.1, "stepping": 0.03}, monkeypatch)
    assert found.spread == pytest.approx(0.03)
    assert not found.agrees
    assert "rodas and ida are 10 % apart" in found.dissent


def test_a_third_engine_is_not_asked_where_tight_runs_do_not_converge(monkeypatch):
    found = references({"rodas": 0.0, "ida": 0.1, "stepping": 0.0}, monkeypatch, converges=False)
    assert found.sensitive
    assert found.label.startswith("rodas and ida")


def test_a_mesh_that_cannot_be_made_is_left_out_with_a_reason(monkeypatch):
    """Elements of five times the size do not fit the bend; the study goes on."""
    monkeypatch.setattr("fairlead.analysis.cost.references.engines_here", lambda: ["rodas"])
    found = cost(lambda more: fairlead.load("capstan", set={"run.stop": "20 ms", "element": "0.25 m", **more}),
                 Ladder((1e-2,), ("rodas",), (), (), (0.2,)), budget=AMPLE, full=True)  # fmt: skip
    assert found.rows
    assert any("element 1.25 is left out" in remark for remark in found.remarks)


def test_without_a_reference_nothing_is_advised():
    choice = choose(Study("empty", (0.0, 1.0), True), 0.01)
    assert choice.settings == {}
    assert choice.sentence == "1 %: cannot be told, there are no two references."


def off(size):
    """An output that is off by some share of its range of 1, in mean and spread."""
    return [OutputError("a.x", "m", 1.0, size, size, size, size, size)]


def sensitive_study(*rows, floor=0.016):
    """A study of a sensitive scene, of (accuracy, error) by the same equations."""
    lines = [Row(Rung(Equations(""), "rodas", one), Timed("finished", cpu=1.0), off(size), []) for one, size in rows]
    reference = Reference("rodas and rodas3p", Timed("finished"), floor, sensitive=True)
    return Study("bend", (0.0, 1.0), True, ["a.x"], ["m"], reference, lines)


def test_nothing_below_the_floor_of_a_sensitive_scene_is_called_a_numerical_error():
    study = sensitive_study((1e-2, 0.08), (1e-3, 0.009), (1e-4, 0.015), (1e-5, 0.008))
    assert [study.told(row.numerical, row) for row in study.rows] == [
        (0.08, False), (0.016, True), (0.016, True), (0.016, True)]  # fmt: skip
    assert "below 1.6 % numerical error" in choose(study, 0.05).sentence
    assert [_cells(study, row)[3] for row in study.rows] == ["8 %", "<1.6 %", "<1.6 %", "<1.6 %"]


def test_what_does_not_become_less_with_the_accuracy_is_no_numerical_error_of_a_sensitive_scene():
    """The most exact lines are 2.5 % from the reference, so what is nearer than that is scatter too."""
    study = sensitive_study((1e-2, 0.04), (1e-3, 0.019), (1e-4, 0.012), (1e-5, 0.025))
    assert [study.told(row.numerical, row)[1] for row in study.rows] == [False, True, True, True]


def test_of_a_scene_that_converges_the_floor_is_that_of_the_references():
    study = sensitive_study((1e-2, 0.04), (1e-5, 0.025))
    study.reference = Reference("rodas and ida", Timed("finished"), 0.001)
    assert [study.told(row.numerical, row) for row in study.rows] == [(0.04, False), (0.025, False)]


def test_two_refinements_of_the_elements_tell_their_order():
    """Errors C h^2 of h and 2h against h/2 are as 3/4 to 15/4: order 2, and h is off by 4/3 of what it differs by."""
    study = Study("rope", (0.0, 1.0), True)
    coarse = Equations("element 0.5", axis="mesh")
    study.rows.append(Row(Rung(coarse, "rodas", 1e-3), Timed("finished"), discretisation=off(0.15)))
    study.elements = off(0.03)
    made = MeshErrors(study, None, None, None, Ladder(), [])
    meshes = [Mesh("element 0.5", {}, 0.5), Mesh("element 0.125", {}, 2.0)]
    made._tell_order(meshes)
    assert study.remarks[-1].endswith("order 2, so the whole error of the scene's elements is 4 %.")
    study.elements = off(0.09)
    made._tell_order(meshes)
    assert "no convergence" in study.remarks[-1]


@pytest.mark.parametrize("order", [0.5, 1, 2, 3])
@pytest.mark.parametrize(("coarse", "fine"), [(2.0, 2.0), (1.5, 2.0), (2.0, 4.0)])
def test_the_order_is_that_with_which_errors_were_made(order, coarse, fine):
    of_h, of_coarse, of_fine = (size**order for size in (1.0, coarse, 1 / fine))
    assert order_of((of_coarse - of_fine) / (of_h - of_fine), coarse, fine) == pytest.approx(order, abs=1e-4)


@pytest.mark.parametrize("ratio", [0.0, 1.0, 17 / 12])
def test_errors_that_do_not_shrink_have_no_order(ratio):
    assert order_of(ratio, 2.0, 2.0) is None


def test_a_coarser_mesh_is_found_where_twice_the_size_does_not_fit():
    """Bends of 0.785 m take elements of 0.375 m, not of 0.5 m."""
    model = fairlead.load("long_route")
    study = Study("long_route", (0.0, 1.0), True)
    runs = BoxedRuns(lambda more: fairlead.load("long_route", set=more), "", [], (0.0, 1.0), 1.0, 1e-7, KeptRuns(None))
    found = MeshErrors(study, runs, References(runs, [], []), model, Ladder(), [])._possible()
    assert [mesh.finer for mesh in found] == pytest.approx([2 / 3, 2.0])
    assert all("line.hose[0].tension" in names for names in found.values())


@pytest.mark.slow
def test_columns_come_before_further_lines(monkeypatch):
    """First the scene by one engine, then its elements, then what else there is time for."""
    asked = []

    def run(self, settings, cap, names=None, members=None):
        asked.append((dict(settings), names is not None))
        t = np.linspace(0, 1, 1001).reshape(-1, 1)
        values = np.tile(np.sin(t), (1, len(names or self.names)))
        return Timed("finished", wall=0.1, cpu=0.1, values=values)

    monkeypatch.setattr(BoxedRuns, "run", run)
    cost(lambda more: fairlead.load("capstan", set=more), budget=AMPLE, signals=["rope.line[*].tension"])
    mesh = next(k for k, (_, named) in enumerate(asked) if named)
    loose = [({"run.engine": engine, "run.accuracy": "0.01"}, False) for engine in ("rodas", "stepping")]
    own, other = map(asked.index, loose)
    assert own < mesh < other


def test_a_scene_whose_reference_takes_too_long_is_studied_over_less_time(monkeypatch):
    """Instead of an empty table."""
    def run(self, settings, cap, names=None, members=None):
        if self.span[1] > 2 and settings.get("run.accuracy") == "1e-07":
            return Timed("budget", "too slow", reached=2.5)
        t = np.linspace(0, 1, 1001).reshape(-1, 1)
        return Timed("finished", wall=0.1, cpu=0.1, values=np.tile(np.sin(t), (1, len(names or self.names))))

    monkeypatch.setattr(BoxedRuns, "run", run)
    found = cost(belt, budget=AMPLE, signals=["block.x"])
    assert found.span == (0.0, 2.0)
    assert found.reference is not None
    assert found.rows
    assert not any("No reference" in one for one in found.remarks)


class Machine:
    """A machine with a clock of its own, on which all takes `slow` times as long as on a quiet one.

    There a model takes a second to make, what a run takes beside its steps two, and the steps of the whole scene ten;
    the first run compiles for a minute.
    """

    def __init__(self, monkeypatch, slow):
        self.now, self.slow, self.compiled, self.runs = 100.0, slow, 0.0, 0
        clock = SimpleNamespace(perf_counter=lambda: self.now, process_time=lambda: self.now / slow)
        for name in ("cost", "boxed_runs", "timed_run", "references"):
            module = importlib.import_module(f"fairlead.analysis.cost.{name}")
            monkeypatch.setattr(module, "time", clock, raising=False)
            monkeypatch.setattr(module, "spent_compiling", lambda: self.compiled, raising=False)
        monkeypatch.setattr(timed_runs, "_once", self.run)
        monkeypatch.setattr(timed_runs, "_summary", lambda result, *_: result.timed)

    def load(self, more):
        self.now += self.slow
        return belt(more)

    def run(self, model, cap, settings):
        if not self.runs:
            self.compiled, self.now = self.compiled + 60.0, self.now + 60.0
        self.runs += 1
        share = model.netlist.run.stop / 4.0
        wanted = 10.0 * self.slow * share
        steps = min(wanted, cap)
        self.now += 2.0 * self.slow + steps
        status, reached = "finished" if steps == wanted else "budget", model.netlist.run.stop * steps / wanted
        values = np.tile(np.linspace(0, 1, 1001).reshape(-1, 1), (1, 2))
        timed = Timed(status, steps=10, reached=reached, values=values if status == "finished" else np.empty((0, 0)))
        return SimpleNamespace(run={"solve_time": steps}, timed=timed), 1.0


@pytest.mark.parametrize("slow", [0.3, 1.0, 2.0, 3.0, 5.0, 10.0])
def test_a_busy_machine_makes_fewer_runs_and_not_a_longer_study(monkeypatch, slow):
    """The budget is kept, compiling apart; what there was no time for is named."""
    machine = Machine(monkeypatch, slow)
    found = cost(machine.load, budget=120.0, signals=["block.x", "block.v"])
    assert machine.now - 100.0 - machine.compiled <= 120.0
    assert machine.compiled == 60.0
    begun = [row.rung.label for row in found.rows]
    assert not set(begun) & set(found.left_out)
    own = [rung for rung in rungs(own_equations(belt({})), Ladder(), belt({})) if rung.engine == "rodas"]
    assert {rung.label for rung in own} <= {*begun, *found.left_out}
    if slow <= 3.0:
        assert found.reference is not None
        assert found.rows[0].timed.finished


def test_no_run_of_one_study_is_made_twice(monkeypatch):
    """Nothing need be kept on disk for that: the reference of a treatment serves all its lines."""
    machine, asked = Machine(monkeypatch, 0.1), []

    def run(model, cap, settings):
        words = {name: value for name, value in settings.items() if name != "run.stop"}
        asked.append((model.netlist.digest, model.netlist.run.stop, tuple(sorted(words.items()))))
        return machine.run(model, cap, settings)

    monkeypatch.setattr(timed_runs, "_once", run)
    monkeypatch.setattr(timed_runs, "BRIEF", 0.0)
    cost(machine.load, budget=1000.0, signals=["block.x", "block.v"])
    assert len(asked) == len(set(asked)) > 10


@pytest.mark.parametrize("name", ["valve_motor", "single_bend"])
@pytest.mark.parametrize("settings", [
    {}, {"run.engine": "stepping"}, {"run.accuracy": "1e-3"}, {"run.engine": "rodas", "run.method": "rodas3p"},
])  # fmt: skip
def test_a_run_has_the_settings_that_it_is_timed_with(name, settings):
    seen = []

    def load(more):
        model = fairlead.load(name, set=more)
        run = model.run
        model.run = lambda **words: seen.append(run(**words)) or seen[-1]
        return model

    timed = timed_runs.timed_run(load, settings, [], (0.0, 0.02), 60.0, repeats=1)
    assert timed.finished, timed
    (result,) = seen
    used = result.run["settings"]
    for setting, value in settings.items():
        key = setting.partition(".")[2]
        assert str(used[key]) == str(float(value) if key == "accuracy" else value)
