"""Fits of scenes with closed forms: what was put in comes out, what is not told is named, mistakes have places."""

import json

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from typer.testing import CliRunner

from fairlead.cli import app
from fairlead.errors import ModelError
from fairlead.studies.differences.steps import difference, noise_floor, steps
from fairlead.studies.fits.features import read_feature
from fairlead.studies.fits.fit_file import Law, read_fit
from fairlead.studies.fits.laws import Judged, better_everywhere
from fairlead.studies.fits.problem import records_of
from fairlead.studies.fits.report import law_lines, lines_of, record_of
from fairlead.studies.fits.search import Error, fit, prepared

STIFFNESS, MASS, FRICTION, BEGIN = 400.0, 2.0, 1.2, 0.1
SCENE = """schema: 1
name: coasting
parameters: {k: 400 N/m, m: 2 kg, mu: 0.12, pressed: 10 N}
components:
  wall: {type: Ground}
  spring: {type: Spring, stiffness: "{k}"}
  block: {type: Mass, mass: "{m}", position: 0.1 m, velocity: 0 m/s}
  pad: {type: Contact, normal_force: "{pressed}", curve: "{mu}"}
connections:
  - [wall.flange, spring.a, pad.a]
  - [spring.b, block.flange, pad.b]
run: {stop: 2 s, accuracy: 1e-6}
"""


def coasting(times, friction=FRICTION, stiffness=STIFFNESS, mass=MASS, begin=BEGIN):
    """Free oscillation with dry friction: half cycles of pi/w about +-F/k, each 2F/k shorter, until it sticks."""
    w, centre = np.sqrt(stiffness / mass), friction / stiffness
    found, peak, begun = np.empty_like(times), begin, 0.0
    while abs(peak) > centre:
        now = times >= begun
        middle = np.sign(peak) * centre
        found[now] = middle + (peak - middle) * np.cos(w * (times[now] - begun))
        peak, begun = 2 * middle - peak, begun + np.pi / w
    found[times >= begun] = peak
    return found


def write(folder, fit_text, noise=0.0, seed=0, unit="m"):
    times = np.linspace(0, 2, 81)
    x = coasting(times) + noise * np.random.default_rng(seed).normal(size=times.size)
    factor = 1e3 if unit == "mm" else 1.0
    rows = "".join(f"{t!r},{v * factor!r}\n" for t, v in zip(times.tolist(), x.tolist(), strict=True))
    (folder / "scene.yaml").write_text(SCENE)
    (folder / "coast.csv").write_text(f"t [s],place [{unit}]\n{rows}")
    (folder / "fit.yaml").write_text(fit_text)
    return folder / "fit.yaml"


def fitted(file):
    asked = read_fit(file)
    return fit(asked, prepared(asked)[1])


HEAD = "model: scene.yaml\nrecords:\n  one: {file: coast.csv, time: t, signals: {block.x: place}}\nparameters:\n"
FREQUENCY = "  k: {start: 380 N/m, low: 200 N/m, high: 800 N/m, log: true}\n"
DRY = "  mu: {start: 0.1, low: 0.01, high: 0.5, log: true}\n"


def test_stiffness_and_friction_come_out_of_a_record_without_noise(tmp_path) -> None:
    found = fitted(write(tmp_path, f"{HEAD}{FREQUENCY}{DRY}starts: 1\n", unit="mm"))
    assert found.values["k"] == pytest.approx(STIFFNESS, rel=1e-5)  # the accuracy of the run is 1e-6
    assert found.values["mu"] == pytest.approx(FRICTION / 10, rel=1e-4)
    assert all(one.told for one in found.directions)


@pytest.mark.slow
def test_noise_widens_intervals_that_hold_the_truth(tmp_path) -> None:
    found = fitted(write(tmp_path, f"{HEAD}{FREQUENCY}{DRY}starts: 1\n", noise=1e-3, seed=3))
    for name, truth in (("k", STIFFNESS), ("mu", FRICTION / 10)):
        one = found.intervals[name]
        assert one.low < truth < one.high
        assert one.drawn[0] < found.values[name] < one.drawn[1]
        assert 0.5 < (one.drawn[1] - one.drawn[0]) / (one.high - one.low) < 1.5  # white noise: both say the same


@pytest.mark.slow
def test_friction_and_normal_force_of_one_record_are_named_as_a_pair(tmp_path) -> None:
    pair = "  pressed: {start: 11 N, low: 2 N, high: 50 N, log: true}\n"
    found = fitted(write(tmp_path, f"{HEAD}{FREQUENCY}{DRY}{pair}starts: 1\n", noise=1e-4))
    untold = [one for one in found.directions if not one.told]
    assert len(untold) == 1
    assert "mu and pressed apart" in untold[0].sentence
    assert [name for name, one in found.intervals.items() if one.low is None] == ["mu", "pressed"]
    assert found.values["mu"] * found.values["pressed"] == pytest.approx(FRICTION, rel=0.05)


@pytest.mark.slow
def test_features_of_a_record_are_fitted_as_well(tmp_path) -> None:
    text = f"{HEAD}{FREQUENCY}features: {{period: period(block.x)}}\nstarts: 1\n"
    assert fitted(write(tmp_path, text)).values["k"] == pytest.approx(STIFFNESS, rel=1e-4)


def test_a_step_weighs_noise_against_curvature() -> None:
    chance = np.random.default_rng(0)

    def rough(z):
        return np.exp(z) + 1e-6 * chance.normal(size=50)

    z, wide = np.array([0.5]), (np.array([-9.0]), np.array([9.0]))
    noise = noise_floor(rough, z, wide)
    assert noise == pytest.approx(1e-6, rel=0.5)
    (one,) = steps(rough, z, wide, noise)
    # error noise/(h sqrt 2) + h^2/6 exp: smallest at h = (3 noise/(sqrt 2 exp))^(1/3), about 0.011
    assert 0.25 < one.size / (3 * 1e-6 / (np.sqrt(2) * np.exp(0.5))) ** (1 / 3) < 4
    assert difference(rough, z, 0, one.size, wide).mean() == pytest.approx(np.exp(0.5), rel=1e-4)


def test_features_have_the_values_of_known_curves() -> None:
    times = np.linspace(0, 10, 2001)
    curve = {"x": np.sin(2 * np.pi * times / 1.25), "v": times - 5}
    assert read_feature("p", "period(x)").of(times, curve) == pytest.approx(1.25, rel=1e-5)
    assert read_feature("a", "amplitude(x)").of(times, curve) == pytest.approx(1, rel=1e-4)
    assert read_feature("b", "breakaway(x, v, 4.99)").of(times, curve) == pytest.approx(0)
    assert read_feature("s", "at_speed(v, v, 1, 2)").of(times, curve) == pytest.approx(1.5, abs=0.01)


def test_every_mistake_of_a_fit_comes_at_once_with_its_place(tmp_path) -> None:
    (tmp_path / "scene.yaml").write_text(SCENE)
    (tmp_path / "empty.csv").write_text("")
    (tmp_path / "back.csv").write_text("t,place [m]\n0,0\n1,0\n0.5,0\n2,0\n")
    (tmp_path / "unit.csv").write_text("t,place [in_arc]\n0,0\n1,x\n2,0\n3,0\n")
    (tmp_path / "fit.yaml").write_text(
        "model: scene.yaml\nrecords:\n"
        "  a: {file: empty.csv, time: t, signals: {block.x: place}}\n"
        "  b: {file: back.csv, time: t, signals: {block.x: plaice}}\n"
        "  c: {file: unit.csv, time: t, signals: {block.x: place, blok.v: place}}\n"
        "  d: {file: gone.csv, time: t, signals: {block.x: place}}\n"
        "parameters:\n  mue: {start: 0.1, low: 0, high: 1}\n"
    )
    with pytest.raises(ModelError) as raised:
        records_of(read_fit(tmp_path / "fit.yaml"))
    told = str(raised.value)
    for part in ("empty.csv:1:1", "is empty", "back.csv:4:1: time goes back", "plaice", "Did you mean place",
                 "in_arc", "unit.csv:3:2", "blok.v", "block.v", "gone.csv", "mue", "Did you mean mu"):  # fmt: skip
        assert part in told, f"{part} is missing in\n{told}"


def test_mistakes_in_the_form_of_a_fit_file_have_places(tmp_path) -> None:
    file = tmp_path / "fit.yaml"
    file.write_text(
        "model: belt\nrecords:\n  a: {file: a.csv, signals: {block.x: x}}\nparameters:\n"
        "  m: {start: 1 kg, low: 2 kg, high: 3 kg}\n  k: {start: 1 N/m, low: 0, high: 2 s, log: true}\n"
        "leave_out: [b]\n"
    )
    with pytest.raises(ModelError) as raised:
        read_fit(file)
    told = str(raised.value)
    for part in (f"{file}:5:14", "not between", f"{file}:6:35", "different kinds", "no record b"):
        assert part in told, f"{part} is missing in\n{told}"


@pytest.mark.slow
def test_the_command_writes_a_page_and_compares_laws_by_what_was_left_out(tmp_path) -> None:
    second = "  two: {file: coast.csv, time: t, signals: {block.x: place}}\n"
    file = write(tmp_path, f"{HEAD}{DRY}starts: 1\n".replace("parameters:", f"{second}parameters:"))
    outcome = CliRunner().invoke(
        app, ["fit", str(file), "--compare", "pad.method=hold,tanh", "--json", "--out", str(tmp_path / "made")]
    )
    assert outcome.exit_code == 0, outcome.output
    told = json.loads(outcome.stdout)
    assert told["comparison"]["preferred"] == "pad.method=hold"  # tanh creeps back where hold stays
    assert told["parameters"]["mu"]["value"] == pytest.approx(FRICTION / 10, rel=1e-3)
    assert (tmp_path / "made" / "fit.html").read_text().count("data:image/png") == 2


@pytest.mark.parametrize(
    ("errors", "said", "better"),
    [
        ({"one": (3.0, 4.0), "two": (2.0, 3.0)}, "The data prefer two by its errors on what was left out.", ["two"]),
        ({"one": (3.0, 4.0), "two": (2.999, 3.998)}, "The data do not tell one and two apart: ", []),
        ({"one": (3.0, 4.0), "two": (2.0, 3.0), "three": (2.01, 3.01)}, "tell two and three apart", ["two", "three"]),
        ({"one": (3.0, 4.0), "two": (2.0, 9.0)}, "The data prefer one by its errors", []),
        ({"one": (3.0, 4.0), "two": (2.0, None)}, "The data prefer one by its errors", []),
        ({"one": (3.0, None), "two": (2.0, 9.0)}, "The data prefer two by its errors", ["two"]),
        ({"one": (3.0, None), "two": (None, 9.0)}, "No law is preferred, since none foretells every record", []),
    ],
)
def test_a_law_is_preferred_by_more_than_two_equal_runs_differ(errors, said, better) -> None:
    """By the sum over records of errors as shares of the first law's; what did not finish has no error."""
    judged = [
        Judged(Law(name), left_out={
            record: {} if mean is None else {"x": Error(mean, mean)}
            for record, mean in zip(("first", "second"), pair, strict=True)
        })
        for name, pair in errors.items()
    ]  # fmt: skip
    assert any(said in line for line in law_lines(judged))
    assert better_everywhere(judged) == better


def test_a_robust_loss_lets_go_of_outliers(tmp_path) -> None:
    """Every eighth place of an exact record is 3 cm off; least squares follow them, cauchy does not."""
    found = {}
    for kind in ("linear", "cauchy"):
        loss = f"loss: {{by: time, kind: {kind}}}\nstarts: 1\n"
        text = f"{HEAD}{FREQUENCY}{DRY}{loss}".replace("{block.x: place}", "{block.x: {column: place, noise: 1 mm}}")
        file = write(tmp_path, text)
        head, *rows = (tmp_path / "coast.csv").read_text().splitlines()
        for k in range(2, len(rows), 8):
            t, x = rows[k].split(",")
            rows[k] = f"{t},{float(x) + 0.03!r}"
        (tmp_path / "coast.csv").write_text("\n".join([head, *rows]))
        found[kind] = fitted(file)
    assert found["cauchy"].values["k"] == pytest.approx(STIFFNESS, rel=1e-4)
    assert found["cauchy"].values["mu"] == pytest.approx(FRICTION / 10, rel=1e-3)
    assert found["linear"].values["mu"] < 0.99 * FRICTION / 10  # the closed form with scipy says 0.1184


def test_without_noise_a_robust_loss_takes_the_noise_that_is_left(tmp_path) -> None:
    """Else it would count outliers of 3 cm in the spread of the signal, 5 cm, and follow them as least squares do."""
    file = write(tmp_path, f"{HEAD}{FREQUENCY}{DRY}loss: {{by: time, kind: cauchy}}\nstarts: 1\n", noise=1e-3)
    head, *rows = (tmp_path / "coast.csv").read_text().splitlines()
    for k in range(2, len(rows), 8):
        t, x = rows[k].split(",")
        rows[k] = f"{t},{float(x) + 0.03!r}"
    (tmp_path / "coast.csv").write_text("\n".join([head, *rows]))
    found = fitted(file)
    assert found.problem.targets[0].left["block.x"] == pytest.approx(1e-3, rel=0.3)
    for name, true in (("k", STIFFNESS), ("mu", FRICTION / 10)):
        one = found.intervals[name]
        assert one.low < true < one.high
        assert one.high - one.low < 0.03 * true
    assert found.starts[-1].loss == min(one.loss for one in found.starts)


def features_of(tmp_path, start, stop=None, features="{p: period(block.x), l: lowest(block.x)}"):
    text = f"{HEAD}  k: {{start: {start}, low: 1, high: 1000, log: true}}\n{DRY}features: {features}\nstarts: 1\n"
    file = write(tmp_path, text)
    if stop is not None:
        rows = (tmp_path / "coast.csv").read_text().splitlines()
        kept = [rows[0], *(row for row in rows[1:] if float(row.split(",")[0]) < stop)]
        (tmp_path / "coast.csv").write_text("\n".join(kept))
    asked = read_fit(file)
    _, targets, chaotic = prepared(asked)
    found = fit(asked, targets)
    told = record_of(asked, found, targets, {"one": None}, chaotic, {"one": {"block.x": "m"}})
    return found, "\n".join(lines_of(told))


def test_a_feature_without_a_value_in_the_model_is_named(tmp_path) -> None:
    """A spring of 40 N/m swings in 1.4 s, the record lasts 2 s. The data were said not to tell k and mu apart."""
    found, said = features_of(tmp_path, "40 N/m")
    assert "No value in the model, at these values of the parameters: period(block.x) of one." in found.remarks[0]
    assert found.remarks[0] in said
    assert "apart" not in said
    assert "not told by the data" not in said


def test_as_many_features_as_parameters_leave_no_interval_and_that_is_said(tmp_path) -> None:
    found, said = features_of(tmp_path, "380 N/m")
    assert found.values["k"] == pytest.approx(STIFFNESS, rel=1e-3)
    assert "The data are 2 numbers for 2 parameters" in said
    assert "k = 4" in said
    assert "no interval" in said
    assert "The data do not tell" not in said


def test_a_feature_that_no_record_has_is_a_mistake(tmp_path) -> None:
    with pytest.raises(ModelError, match=r"p = period\(block.x\) has no value in any record"):
        features_of(tmp_path, "380 N/m", stop=0.3)


DRIVEN = """schema: 1
name: driven
parameters: {torque: 1.5 N*m, damping: 0.5 N*m*s/rad}
components:
  case: {type: Housing}
  bob: {type: Pendulum, mass: "{1/9.80665**2} kg", arm: 9.80665 m, angle: 0.2 rad, speed: 0 rad/s}
  drag: {type: RotationalDamper, damping: "{damping}"}
  motor: {type: TorqueSource, torque: {sine: {amplitude: "{torque}", frequency: "{2/3/(2*3.141592653589793)} Hz"}}}
connections: [[case.shaft, drag.a], [bob.shaft, drag.b, motor.shaft]]
run: {stop: 300 s, accuracy: 1e-6}
"""


@pytest.mark.parametrize(("torque", "by"), [(0.5, "time"), (1.5, "statistics")])
def test_a_driven_pendulum_is_fitted_by_statistics_where_it_is_chaotic(tmp_path, torque, by) -> None:
    """q = 2, 2/3 of the natural frequency: periodic at a torque of 0.5 m g l, chaotic at 1.5 (Baker, Gollub 1990)."""
    run = solve_ivp(lambda t, y: [y[1], -np.sin(y[0]) - y[1] / 2 + torque * np.sin(2 / 3 * t)], (0, 300), [0.2, 0],
                    "DOP853", np.linspace(0, 300, 1501), rtol=1e-9, atol=1e-9)  # fmt: skip
    rows = "".join(f"{t!r},{w!r}\n" for t, w in zip(run.t.tolist(), run.y[1].tolist(), strict=True))
    (tmp_path / "w.csv").write_text(f"t [s],w [rad/s]\n{rows}")
    (tmp_path / "scene.yaml").write_text(DRIVEN)
    (tmp_path / "fit.yaml").write_text(
        "model: scene.yaml\nrecords:\n  one: {file: w.csv, time: t, signals: {bob.speed: w}}\nparameters:\n"
        f"  torque: {{start: {torque} N*m, low: 0.1 N*m, high: 2 N*m}}\n"
    )
    asked = read_fit(tmp_path / "fit.yaml")
    _, (target,), chaotic = prepared(asked)
    assert (chaotic, target.by) == ({"one": by == "statistics"}, by)
    residuals = target.residuals({"torque": torque})
    # where it is periodic the course agrees; where it is not, each statistic within a few deviations of its own
    assert np.abs(residuals).max() < (1e-3 if by == "time" else 5)


def test_a_constant_record_of_a_scene_that_moves_is_no_chaos(tmp_path) -> None:
    """Its spread is zero; so what the residuals vary by counts."""
    rows = "".join(f"{0.1 * k!r},0\n" for k in range(100))
    (tmp_path / "x.csv").write_text(f"t [s],x [m]\n{rows}")
    (tmp_path / "scene.yaml").write_text("""schema: 1
name: swings
components:
  wall: {type: Ground}
  spring: {type: Spring, stiffness: 100 N/m}
  block: {type: Mass, mass: 1 kg, position: 0.1 m, velocity: 0}
  pad: {type: Contact, normal_force: 2 N, curve: 0.3}
connections: [[wall.flange, spring.a, pad.a], [spring.b, block.flange, pad.b]]
run: {stop: 10 s}
""")
    (tmp_path / "fit.yaml").write_text(
        "model: scene.yaml\nrecords:\n  one: {file: x.csv, time: t, signals: {block.x: x}}\nparameters:\n"
        "  spring.stiffness: {start: 100 N/m, low: 50 N/m, high: 200 N/m}\n"
    )
    _, (target,), chaotic = prepared(read_fit(tmp_path / "fit.yaml"))
    assert (chaotic, target.by) == ({"one": False}, "time")
