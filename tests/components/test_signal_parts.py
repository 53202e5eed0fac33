"""Parts that work on signals, against what their formulas say of a sine."""

import pathlib
import re

import numpy as np
import pytest
import scipy.signal
from scipy.interpolate import RegularGridInterpolator

import fairlead
from fairlead.errors import ModelError

SCENES = pathlib.Path(__file__).parents[2] / "models" / "single_parts"


def run(name, **settings):
    """A scene, with other values by their dotted names."""
    result = fairlead.load(SCENES / f"{name}.yaml", set={"run.accuracy": "1e-7", **settings}).run(out=None)
    assert result.ok
    return result


def relay(value, lower, upper):
    """Whether a relay is on, sample by sample."""
    on, told = False, []
    for x in value:
        on = x > upper or (on and x >= lower)
        told.append(on)
    return np.array(told)


def test_what_has_no_memory_is_a_formula_of_the_sine():
    result = run("limits_of_signals")
    wave = 2 * np.sin(2 * np.pi * result.t)
    clear = np.abs(np.abs(wave) - 1) > 1e-3  # of the jumps of the relay, and of the switch at zero
    expected = {
        "limited": np.clip(wave, -1, 1.5), "dead": 2 * np.sign(wave) * np.maximum(np.abs(wave) - 0.5, 0),
        "larger": np.maximum(wave, wave / 2), "size": np.abs(wave), "square": wave**2, "mark": wave,
        "shape": np.interp(wave, [-2, 0, 2], [4, 0, 1]),
    }  # fmt: skip
    for name, values in expected.items():
        assert np.max(np.abs(result[f"{name}.signal"] - values)) < 1e-6, name
    assert np.array_equal(result["relay.signal"][clear] > 0, relay(wave, -1, 1)[clear])
    away = np.abs(wave) > 1e-3
    assert np.allclose(result["chosen.signal"][away], np.where(wave > 0, wave, wave / 2)[away], atol=1e-6)
    assert len(result.switches()) >= 10  # none was stepped over


@pytest.mark.parametrize("high", ["0.5", "0.3"])
def test_an_integral_stays_at_its_limit_and_leaves_when_the_value_turns(high):
    """The integral of 2 sin(w t) is (1 - cos(w t))/pi; it is held from where it meets the limit until t = 0.5 s."""
    result = run("memory_of_signals", **{"integral.high": high})
    free, late = (1 - np.cos(2 * np.pi * result.t)) / np.pi, result.t % 1 > 0.5
    top = float(high)
    fall = top - 2 / np.pi + free  # after the turn it falls from the limit
    first = result.t < 1
    expected = np.where(late, fall, np.minimum(free, top))
    assert np.max(np.abs(result["integral.signal"] - expected)[first]) < 1e-5
    assert result["integral.signal"].max() <= top + 1e-6


@pytest.mark.parametrize("engine", ["rodas", "stepping", "ida"])
def test_an_integral_that_is_reset_begins_anew(engine):
    """It rises by 3/s from 0.25 to 1, and falls from there as 0.2 + 0.8 exp(-t/0.1 ms): 16 times nearer to 0.2."""
    if engine == "ida":
        pytest.importorskip("sksundae")
    result = run("sawtooth", **{"run.engine": engine})
    table = result.switches().to_pandas().set_index(["component", "zone_to"])
    resets = table.loc[("ramp", "returning")]
    assert resets["first"] == pytest.approx(0.8 / 3, rel=1e-6)
    assert resets["last"] - resets["first"] == pytest.approx(6 * (0.25 + 1e-4 * np.log(16)), rel=1e-5)
    assert resets["count"] == 7
    given = result.at("dose.signal", np.array([0.1, 0.45, 0.495, 0.6, 0.9, 1.1, 1.6]))
    assert given == pytest.approx([0.3, 0.5, 0, 0.3, 0.5, 0.3, 0.3], abs=1e-6)


def test_filters_answer_as_their_frequency_response_says():
    result = run("memory_of_signals", **{"run.stop": "4 s"})
    settled, w = result.t > 3, 2 * np.pi
    for name, response in (("rate", 1j * w / (1 + 0.01j * w)), ("filter", 100 / (100 - w**2 + 10j * w))):
        expected = 2 * np.imag(response * np.exp(1j * w * result.t))
        assert np.max(np.abs(result[f"{name}.signal"] - expected)[settled]) < 2e-4 * abs(response), name


def test_samples_are_held_and_told_late():
    result = run("memory_of_signals")
    t = result.t[:-1] + 1e-9
    inside = (result.t[:-1] % 0.05 > 1e-6) & (result.t[:-1] % 0.05 < 0.05 - 1e-6)
    held = 2 * np.sin(2 * np.pi * np.floor(t / 0.05) * 0.05)
    assert np.allclose(result["held.signal"][:-1][inside], held[inside], atol=1e-6)
    between = (result.t[:-1] % 0.01 > 1e-6) & (result.t[:-1] % 0.01 < 0.01 - 1e-6)
    late = np.maximum(np.floor(t / 0.01) * 0.01 - 0.05, 0)
    assert np.allclose(result["late.signal"][:-1][between], 2 * np.sin(2 * np.pi * late)[between], atol=1e-6)


@pytest.mark.parametrize("engine", ["stepping", "ida"])
def test_samples_that_rounding_alone_parts_are_taken_on_every_engine(engine):
    """3 times 50 ms is 2.8e-17 s after 15 times 10 ms."""
    if engine == "ida":
        pytest.importorskip("sksundae")
    one, other = run("memory_of_signals"), run("memory_of_signals", **{"run.engine": engine})
    for name in ("held", "late", "integral"):
        assert other[f"{name}.signal"][-1] == pytest.approx(one[f"{name}.signal"][-1], abs=1e-5), name


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ({"limited.high": "-2"}, "limited.high: high -2 is not above low -1"),
        ({"relay.lower": "2"}, "relay.lower: lower 2 is above upper 1"),
        ({"dead.band": "-1"}, "dead.band = -1"),
    ],
)
def test_what_contradicts_itself_is_refused(change, says):
    with pytest.raises(ModelError, match=says):
        fairlead.load(SCENES / "limits_of_signals.yaml", set=change).check()


def test_gates_counters_and_timers_say_what_two_square_waves_give():
    result = run("logic_of_signals")
    fast, slow = np.sin(4 * np.pi * result.t), np.sin(np.pi * result.t)
    clear = (np.abs(fast) > 1e-3) & (np.abs(slow) > 1e-3)
    one, other = fast > 0, slow > 0
    for name, expected in (("both", one & other), ("some", one | other), ("alone", one ^ other)):
        assert np.array_equal(result[f"{name}.signal"][clear] > 0.5, expected[clear]), name
    assert np.allclose(result["alone.inverse"], 1 - result["alone.signal"])
    assert result["counter.count"][-1] == 3  # at 0.25, 0.75 and 1.5 s; at 1 s one hands over to the other
    assert result["hours.elapsed"][-1] == pytest.approx(1.0, abs=2e-3)
    made = result.t[np.flatnonzero(np.diff(result["timer.signal"]))]
    assert made == pytest.approx([0.1, 0.25, 0.6, 0.75, 1.1, 1.25, 1.6, 1.75], abs=3e-3)


@pytest.mark.slow
@pytest.mark.parametrize("b3", ["0 s^3", "2e-5 s^3"])
def test_a_transfer_function_answers_a_sweep_as_scipy_says(b3):
    """The reference holds its input linear between 80000 samples."""
    result = run("transfer_function", **{"plant.b3": b3})
    t = np.linspace(0, 5, 80001)
    sweep = np.sin(2 * np.pi * (t + 19 / 5 * t**2 / 2))
    numerator = [float(b3.split()[0]), 0, 1e-2, 1][-4 if b3 != "0 s^3" else -2 :]
    _, answer, _ = scipy.signal.lsim((numerator, [1e-5, 1e-3, 2e-2, 1]), sweep, t)
    assert np.max(np.abs(np.interp(result.t, t, answer) - result["plant.signal"])) < 1e-5


def test_a_transfer_function_is_the_blocks_it_stands_for(simulate):
    """Two formulations: a SecondOrder behind a lag, and the product of their denominators."""
    result = simulate("""
        components:
          step: {type: SignalSource, value: {ramp: {to: 1, over: 10 ms}}}
          slow: {type: SignalLag, lag: 50 ms}
          swings: {type: SecondOrder, omega: 20 rad/s, damping: 0.2}
          both: {type: TransferFunction, a1: 70 ms, a2: 3.5e-3 s^2, a3: 1.25e-4 s^3}
        connections: [[step.signal, slow.value, both.value], [slow.signal, swings.value]]
        run: {stop: 1 s, accuracy: 1e-7}
    """)
    assert np.abs(result["swings.signal"]).max() > 1.2
    assert np.allclose(result["swings.signal"], result["both.signal"], atol=1e-5)


@pytest.mark.parametrize(
    ("settings", "says"),
    [({"plant.b4": "1 s^4"}, "the numerator has order 4, the denominator 3"),
     ({f"plant.a{k}": "0" for k in range(4)}, "the denominator is zero")],
)  # fmt: skip
def test_a_transfer_function_that_cannot_be_is_refused(settings, says):
    with pytest.raises(ModelError, match=says):
        fairlead.load(SCENES / "transfer_function.yaml", set=settings).check()


def test_a_map_of_two_signals_is_bilinear_and_keeps_its_borders():
    result = run("table_of_two")
    x, y = [0, 1, 3], [-1, 0, 2, 2.5, 4]
    of = RegularGridInterpolator((y, x), [[0, 2, 4], [1, 1, 5], [3, 0, -2], [3, 0, -2], [1, 1, 1]])
    expected = of(np.c_[np.clip(result["down.signal"], -1, 4), np.clip(result["across.signal"], 0, 3)])
    assert np.allclose(result["chart.signal"], expected, atol=1e-9)


@pytest.mark.parametrize(
    ("text", "says"),
    [("0,0,1\n0,1,x\n1,2,3\n", "row 2: 'x' is not a finite number"), ("0,0,1\n0,1\n1,2,3\n", "row 2 has 1 values"),
     ("0,1,0\n0,1,2\n1,2,3\n", "x does not grow"), ("0,0,1\n", "it has 1 rows")],
)  # fmt: skip
def test_a_map_that_is_none_is_refused_with_its_row(tmp_path, text, says):
    (tmp_path / "map.csv").write_text(text)
    scene = (SCENES / "table_of_two.yaml").read_text(encoding="utf-8")
    (tmp_path / "scene.yaml").write_text(scene)
    with pytest.raises(ModelError, match=re.escape(says)):
        fairlead.load(tmp_path / "scene.yaml").check()


def test_a_function_is_its_expression():
    result = run("function_of_signals")
    a, b = result["force.signal"], result["angle.signal"]
    assert np.allclose(result["shaped.signal"], a * np.sin(b) ** 2 + 2 - np.sqrt(1 + b) / 2, atol=1e-9)
    cornered = np.maximum(np.maximum(np.abs(a) - 0.5, 0), a * b / 3)
    assert np.allclose(result["cornered.signal"], cornered, atol=1e-6)
    assert np.allclose(result["ratio.signal"], 3 * a / (1 + b / 3), atol=1e-9)


EXPRESSIONS = {
    "a**3 - a**-2 + a**1.5": lambda a, b: a**3 - a**-2 + a**1.5,
    "a**0.3/b": lambda a, b: a**0.3 / b,
    "-(a - 2*b)*exp(-b/3) + log(a)": lambda a, b: -(a - 2 * b) * np.exp(-b / 3) + np.log(a),
    "2*3 - 1": lambda a, b: 5 + 0 * a,
    "3/a": lambda a, b: 3 / a,
    "a**0 + 1 - a": lambda a, b: 2 - a,
    "min(a, b, 1.5) + cos(60*deg)": lambda a, b: np.minimum(a, 1.5) + 0.5,
    "+a*a - (a*a)/b": lambda a, b: a * a - a * a / b,
}


@pytest.mark.parametrize("engine", ["rodas", "stepping"])
def test_every_operation_of_an_expression_is_what_python_says(simulate, engine):
    parts, joins = [], []
    for k, text in enumerate(EXPRESSIONS):
        parts.append(f'f{k}: {{type: SignalFunction, expression: "{text}"}}')
        joins += [f"[{one}.signal, f{k}.{one}]" for one in "ab" if re.search(rf"\b{one}\b", text)]
    result = simulate(f"""
        components:
          a: {{type: SignalSource, value: {{ramp: {{from: 1, to: 2, over: 1 s}}}}}}
          b: {{type: SignalSource, value: 4}}
          {(chr(10) + 10 * " ").join(parts)}
          memory: {{type: Integrator}}
        connections: [[f0.signal, memory.value], {", ".join(joins)}]
        run: {{stop: 1 s, engine: {engine}}}
    """)
    a, b = result["a.signal"], result["b.signal"]
    for k, value in enumerate(EXPRESSIONS.values()):
        assert np.allclose(result[f"f{k}.signal"], value(a, b), rtol=1e-9, atol=1e-9), k


def function(**given):
    """The mistakes of a scene with a function; it feeds a force."""
    settings = ", ".join(f"{name}: {value}" for name, value in given.items())
    return f"""
schema: 1
components:
  a: {{type: SignalSource, value: 1}}
  f: {{type: SignalFunction, {settings}}}
  pull: {{type: ForceActuator}}
  block: {{type: Mass, mass: 1 kg}}
connections: [[a.signal, f.a, f.b], [f.signal, pull.force], [pull.flange, block.flange]]
run: {{stop: 1 s}}
"""


@pytest.mark.parametrize(
    ("given", "says"),
    [
        ({"expression": "a*sinn(b)"}, r"f.expression: .*there is no function sinn.*Did you mean sin\?"),
        ({"expression": "a^b"}, "f.expression: .*Write .. for a power"),
        ({"expression": "a**b"}, "f.expression: .*an exponent is a number"),
        ({"expression": "'(lambda: a*b)()'"}, "f.expression: .*is not arithmetic"),
        ({"expression": "a.real + b"}, "f.expression: .*is not arithmetic"),
        ({"expression": "a/0 + b"}, "f.expression: .*divides by zero"),
        ({"expression": "a*b*signal"}, "f.inputs: signal cannot be the name of an input"),
        ({"expression": "a + b", "inputs": "{a: N, b: m}"}, "f.expression: .*1 m.kg/s.2 and 1 m are not of one kind"),
        ({"expression": "a*b", "inputs": "{a: N, b: 1, c: m}"}, "f.inputs: c does not occur in the expression"),
        ({"expression": "a*b*k", "inputs": "{a: N, b: 1}"}, "f.expression: .*there is no input k"),
        ({"expression": "a*b", "inputs": "{a: N, b: s}"}, r"f.signal is in .*, pull.force wants N"),
    ],
)  # fmt: skip
def test_an_expression_that_is_none_is_told(given, says, tmp_path):
    (tmp_path / "scene.yaml").write_text(function(**given), encoding="utf-8")
    with pytest.raises(ModelError, match=f"(?s){says}"):
        fairlead.load(tmp_path / "scene.yaml").check()


def test_a_function_with_units_tells_the_unit_that_follows(tmp_path):
    text = function(expression="a*k*b + (2 kN)*b", inputs="{a: m, b: 1}", constants="{k: 3 N/mm}")
    (tmp_path / "scene.yaml").write_text(text, encoding="utf-8")
    result = fairlead.load(tmp_path / "scene.yaml").run(out=None)
    assert result["block.v"][-1] == pytest.approx(5000.0, rel=1e-6)  # 1 m * 3 N/mm + 2 kN on 1 kg for 1 s


@pytest.mark.slow
@pytest.mark.parametrize("engine", ["rodas", "stepping", "ida"])
def test_a_state_space_with_two_inputs_answers_as_scipy_says(engine):
    """The reference holds its inputs linear between 80000 samples; of whole numbers it would make its start one, 0."""
    if engine == "ida":
        pytest.importorskip("sksundae")
    result = run("state_space", **{"run.engine": engine})
    t = np.linspace(0, 4, 80001)
    inputs = np.stack([np.minimum(t / 0.01, 1), np.sin(2 * np.pi * (t + t**2 / 2))], axis=1)
    a = np.array([[0, 1, 0, 0], [-200, -2, 100, 1], [0, 0, 0, 1], [100, 1, -100, -1]], float)
    b, c = np.array([[0, 0], [1, 0], [0, 0], [0, 1]], float), np.array([[1, 0, 0, 0], [0, 0, 1, 0]], float)
    system = (a, b, c, np.array([[0, 0], [0, 1e-3]]))
    _, answer, _ = scipy.signal.lsim(system, inputs, t, X0=[0.01, 0, 0, 0])
    for k in range(2):
        told = result[f"masses.signal{k + 1}"]
        assert np.max(np.abs(np.interp(result.t, t, answer[:, k]) - told)) < 1e-5


def test_a_state_space_is_the_transfer_function_of_its_matrices(simulate):
    """Two formulations of (s + 3)/(s^2 + 2 s + 10), the second with feed-through beside it."""
    result = simulate("""
        components:
          step: {type: SignalSource, value: {ramp: {to: 1, over: 10 ms}}}
          one: {type: TransferFunction, b0: 3, b1: 1 s, a0: 10, a1: 2 s, a2: 1 s^2}
          two: {type: StateSpace, a: [[0, 1], [-10, -2]], b: [0, 1], c: [3, 1]}
          three: {type: StateSpace, a: [[0, 1], [-10, -2]], b: [[0], [1]], c: [[3, 1]], d: 2}
        connections: [[step.signal, one.value, two.value, three.value]]
        run: {stop: 3 s, accuracy: 1e-7}
    """)
    assert np.allclose(result["one.signal"], result["two.signal"], atol=1e-5)
    assert np.allclose(result["three.signal"], result["two.signal"] + 2 * result["step.signal"], atol=1e-5)


@pytest.mark.parametrize(
    ("given", "says"),
    [
        ("a: [[0, 1], [1]], b: 1, c: 1", r"plant.a\[1\] has 1 numbers, and the first row 2"),
        ("a: [[0, 1]], b: 1, c: 1", "plant.a: a has 1 rows and 2 columns"),
        ("a: [[0, 1], [1, 0]], b: [0, 1, 1], c: [1, 0]", "plant.b: b has 1 rows, and a 2"),
        ("a: [[0, 1], [1, 0]], b: [0, 1], c: [1]", "plant.c: c has 1 columns, and a 2"),
        ("a: [[0, 1], [1, 0]], b: [0, 1], c: [1, 0], d: [[1, 1]]", "plant.d: d has 1 rows and 2 columns"),
        ("a: [[0, 1], [1, 0]], b: [0, 1], c: [1, 0], initial: 3", "plant.initial: initial has 1 numbers, and a 2 rows"),
        ("a: [[0, 1], [1, x]], b: [0, 1], c: [1, 0]", r"plant.a\[1\]\[1\] = x"),
        ("a: hello, b: 1, c: 1", "plant.a = hello"),
        ("a: [], b: 1, c: 1", "plant.a: this is not a matrix"),
    ],
)
def test_matrices_that_do_not_fit_are_told(given, says, tmp_path):
    text = f"""
schema: 1
components:
  step: {{type: SignalSource, value: 1}}
  plant: {{type: StateSpace, {given}}}
connections: [[step.signal, plant.value]]
run: {{stop: 1 s}}
"""
    (tmp_path / "scene.yaml").write_text(text, encoding="utf-8")
    with pytest.raises(ModelError, match=says):
        fairlead.load(tmp_path / "scene.yaml").check()


BETWEEN = """
    components:
      value: {{type: SignalSource, value: {value}}}
      relay: {{type: Relay, lower: -1, upper: 1, on: 3, off: -3{begins}}}
    connections: [[value.signal, relay.value]]
    run: {{stop: 10 s}}
"""


@pytest.mark.parametrize(
    ("begins", "value", "first", "last"),
    [
        ("", "0", -3, -3),
        (", begins_on: no", "0", -3, -3),
        (", begins_on: yes", "0", 3, 3),
        (", begins_on: yes", "-2", -3, -3),
        (", begins_on: no", "2", 3, 3),
        (", begins_on: yes", "{ramp: {to: -2, over: 4 s, start: 1 s}}", 3, -3),
    ],
)
def test_a_relay_begins_as_asked_where_its_value_is_between_its_levels(simulate, begins, value, first, last):
    result = simulate(BETWEEN.format(begins=begins, value=value))
    assert (result["relay.signal"][0], result["relay.signal"][-1]) == (first, last)
