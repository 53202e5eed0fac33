"""Controllers in plain Python: called at sample times only, what they give is held, what goes wrong is told."""

import re

import numpy as np
import pytest

from fairlead.component.class_checks import DeclarationError
from fairlead.component.registry import load_library
from fairlead.errors import ModelError

PULLER = """
    class Puller(Component):
        flange = Translational()
        pull = Input("N")
        def law(p, flange, pull):
            return Law(flange=-pull, supplied=pull * flange.v)

    class Speed(Component):
        flange = Translational()
        v = Output("m/s")
        def law(p, flange):
            return Law(flange=0, v=flange.v)
"""
COUNTING = """
    class Counting(Controller):
        "Counts its samples, and pushes against the speed with a force that it remembers."
        speed = Input("m/s")
        force = Output("N", "Held between samples.")
        count = Output("1")
        gain = Parameter("N*s/m")

        def begin(self):
            self.history = []

        def sample(self, t, speed):
            self.history.append((t, speed))
            return {"force": -self.gain * speed, "count": len(self.history)}
"""
SCENE = """
    components:
      cart: {type: Mass, mass: 2 kg, position: 0 m, velocity: 1 m/s}
      puller: {type: Puller}
      seen: {type: Speed}
      control: {type: Counting, period: 50 ms, gain: 8 N*s/m}
    connections:
      - [cart.flange, puller.flange, seen.flange]
      - [seen.v, control.speed]
      - [control.force, puller.pull]
    run: {stop: 1 s}
    record: {signals: ["*"]}
"""


def test_a_controller_in_plain_python_is_called_at_its_samples_and_holds_between_them(simulate, library):
    """v' = -8 v(t_k)/2: the exact recursion is  v_{k+1} = v_k (1 - 4 T)."""
    result = simulate(SCENE, libraries=(library(PULLER + COUNTING),))
    for k in range(20):
        v = (1 - 4 * 0.05) ** k
        assert result.at("cart.v", 0.05 * k, side="right") == pytest.approx(v, rel=1e-9)
        assert result.at("control.force", 0.05 * k + 0.02) == pytest.approx(-8 * v, rel=1e-9)
        assert result.at("control.count", 0.05 * k + 0.02) == k + 1


def test_every_run_begins_with_a_fresh_controller(scene, library, tmp_path):
    model = scene(SCENE, (library(PULLER + COUNTING),))
    ends = [model.run(out=tmp_path / f"run{k}")["control.count"][-1] for k in range(2)]
    assert ends[0] == ends[1]


def test_two_controllers_keep_their_own_memory(simulate, library):
    text = SCENE.replace("connections:", "  slow: {type: Counting, period: 0.2 s, gain: 1 N*s/m}\n    connections:")
    result = simulate(text.replace("[seen.v, control.speed]", "[seen.v, control.speed, slow.speed]"),
                      libraries=(library(PULLER + COUNTING),))  # fmt: skip
    assert [result.at(name, 0.96) for name in ("control.count", "slow.count")] == [20, 5]


@pytest.mark.parametrize("method", ["rodas5p", "rodas3p"])
def test_a_controller_that_reads_a_port_by_itself_sees_its_motion(simulate, library, method):
    reading = COUNTING.replace('speed = Input("m/s")', "flange = Translational()")
    reading = reading.replace("t, speed)", "t, flange)").replace("* speed", "* flange.v").replace("(t, speed)", "t")
    text = SCENE.replace("seen.flange]", "seen.flange, control.flange]").replace("- [seen.v, control.speed]", "")
    result = simulate(text, libraries=(library(PULLER + reading),), **{"run.method": method})
    np.testing.assert_allclose(result.at("cart.v", 0.5, side="right"), 0.8**10, rtol=1e-9)


@pytest.mark.parametrize(
    ("change", "told"),
    [
        (("len(self.history)}", "1 / (len(self.history) - 3)}"), r"t = 0\.1 s: control: ZeroDivisionError"),
        (('"count": len', '"cuont": len'), r"sample gives \['cuont', 'force'\], and the outputs are \['count'"),
        (("len(self.history)}", 'float("nan")}'), r"ValueError: sample gives count = nan"),
        (("len(self.history)}", '"5 N"}'), r"sample gives count = '5 N', and a number is wanted \(.*classes0\.py:\d+"),
        (("len(self.history)}", "exit(0)}"), r"t = 0 s: control: SystemExit: 0 \(.*classes0\.py:27"),
        (("-self.gain", "-self.gian"), r"AttributeError.*gian.*classes0\.py:27"),
    ],
)  # fmt: skip
def test_what_goes_wrong_in_a_controller_ends_the_run_with_its_place(scene, library, tmp_path, change, told):
    model = scene(SCENE, (library(PULLER + COUNTING.replace(*change)),))
    result = model.run(out=tmp_path / "run", check=False)
    assert result.status == "failed"
    reached = result.t[-1] if len(result.t) else 0.0  # some fail in their first sample
    assert reached == pytest.approx(result.run["end_time"])  # and nothing that was computed is lost
    assert re.search(told, result.run["sentence"]), result.run["sentence"]


def test_a_controller_is_checked_when_it_is_declared(library):
    wrong = COUNTING.replace("(self, t, speed)", "(self, t, sped)")
    with pytest.raises((DeclarationError, ModelError), match=r"sample asks for 'sped'; known: \['speed', 't'\]"):
        load_library(library(wrong))
    with pytest.raises((DeclarationError, ModelError), match=r"'simple'\. Did you mean sample\?"):
        load_library(library(COUNTING.replace("def sample", "def simple")))


def test_a_controller_keeps_the_contract(library):
    from fairlead.testing import contract

    contract(load_library(library(COUNTING)).Counting)
