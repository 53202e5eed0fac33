"""What cannot be exported is refused by name, with a way out."""

import platform
import shutil

import pytest

import fairlead
from fairlead.errors import ModelError, UsageError
from fairlead.fmu import compiler, description, export, header
from fairlead.fmu.platforms import HERE, PLATFORMS
from tests.fmu.exported import PUSHED, fmpy, model, needs_compiler, once, slave

PYTHON = """
from fairlead.component import Controller, Output

class Chooser(Controller):
    \"\"\"A number.\"\"\"
    signal = Output("1", "It.")

    def sample(self):
        return 1.0
"""


@pytest.fixture
def pushed(tmp_path):
    return model(tmp_path, "pushed", PUSHED)


@pytest.fixture
def linked(monkeypatch):
    """As if there were a compiler: what is refused is refused before it is called."""
    monkeypatch.setenv("CC", "no-such-compiler")


def refusal(model, *given, **more):
    with pytest.raises((UsageError, ModelError)) as caught:
        export(model, *given, **more)
    return str(caught.value)


def test_a_model_without_outputs_is_told_how_to_name_some(linked, tmp_path):
    said = refusal(fairlead.load("belt"), tmp_path / "belt.fmu")
    assert "no output" in said
    assert "--out SIGNAL" in said


def test_names_that_do_not_exist_are_told_all_at_once_with_the_nearest(linked, pushed):
    said = refusal(pushed, inputs=["comand.value"], outputs=["block.vv", "block.x"])
    assert "--in comand.value" in said
    assert "Did you mean command.value?" in said
    assert "--out block.vv" in said
    assert "block.x:" not in said


def test_the_engine_ida_is_refused(linked, pushed):
    said = refusal(pushed, engine="ida")
    assert "SUNDIALS" in said
    assert "rodas or stepping" in said


def test_a_name_of_an_input_and_an_output_is_refused(linked, tmp_path):
    text = PUSHED.replace("speed: {of: block.v", "pull: {of: block.v")
    assert "pull: two of the inputs, outputs and parameters have this name" in refusal(model(tmp_path, "twice", text))


def test_a_version_that_is_not_made_is_refused(linked, pushed):
    assert "version 2 or 3" in refusal(pushed, version=1)


def test_without_a_compiler_it_is_told_what_to_install(monkeypatch, pushed):
    monkeypatch.delenv("CC", raising=False)
    monkeypatch.setattr(shutil, "which", lambda name: None)
    monkeypatch.setattr(compiler, "has_ziglang", lambda: False)
    said = refusal(pushed)
    assert "no C compiler" in said
    assert "fairlead[zig]" in said


def test_a_compiler_that_fails_is_quoted(monkeypatch):
    monkeypatch.setenv("CC", "false")
    with pytest.raises(UsageError, match="false failed with code 1"):
        compiler.linked({"a.c": b""}, "a", PLATFORMS[HERE])
    monkeypatch.setenv("CC", "no-such-compiler")
    with pytest.raises(UsageError, match="cannot be called"):
        compiler.linked({"a.c": b""}, "a", PLATFORMS[HERE])


def test_on_another_system_it_is_told_where_fmus_are_made(monkeypatch, pushed):
    monkeypatch.setattr(platform, "machine", lambda: "riscv64")
    assert "Linux for x86-64 only, and this is" in refusal(pushed)


def test_a_controller_in_plain_python_is_refused_by_name(linked, tmp_path):
    parts = tmp_path / "parts.py"
    parts.write_text(PYTHON, encoding="utf-8")
    netlist = tmp_path / "chosen.yaml"
    text = PUSHED.replace("{type: SignalInput, start: 0}", "{type: Chooser, period: 10 ms}").partition("interface:")[0]
    netlist.write_text(f"schema: 1\nname: chosen\n{text}", encoding="utf-8")
    said = refusal(fairlead.load(netlist, libraries=[parts]), outputs=["block.v"])
    assert said.startswith("command: written in plain Python")
    assert "let the master call it" in said


@pytest.mark.slow
def test_an_fmu_inside_is_refused_by_name(tmp_path):
    fmpy()
    needs_compiler()
    once(tmp_path, "pushed", 3, PUSHED)
    text = PUSHED.replace("connections:", "  inner: {type: Fmu, file: pushed_3.fmu, period: 10 ms}\nconnections:")
    netlist = tmp_path / "nested.yaml"
    netlist.write_text(f"schema: 1\nname: nested\n{text}", encoding="utf-8")
    said = refusal(fairlead.load(netlist, allow_fmu=True))
    assert "inner.fmu: an FMU inside" in said


def test_a_place_that_cannot_be_written_is_told_and_leaves_nothing(tmp_path):
    from fairlead.fmu.archive import write

    blocking = tmp_path / "file"
    blocking.write_text("mine", encoding="utf-8")
    with pytest.raises(UsageError, match="cannot be written"):
        write(blocking / "belt.fmu", b"")
    assert [*tmp_path.iterdir()] == [blocking]


@pytest.mark.parametrize(
    ("name", "safe"),
    [
        ("belt", "belt"),
        ("../../etc/x", "______etc_x"),
        ("3 parts", "model_3_parts"),
        ("", "model_"),
        ("größe", "gr__e"),
        ("aux", "model_aux"),
        ("COM1", "model_COM1"),
        ("com10", "com10"),
    ],
)
def test_the_name_of_the_library_is_a_name_in_c_and_never_a_path(name, safe):
    assert description.identifier(name) == safe


def test_texts_of_a_netlist_stay_texts_in_c():
    assert header._text('a"; exit(1); //\\\n??/é%') == r'"a\042; exit(1); //\134\012\077\077/\303\251\045"'


def change_for_ever(one):
    for k in range(1000):
        one.set("pull", 8.0 + k % 2)
        one.step(0.1)


@pytest.mark.slow
def test_with_a_failing_law_the_step_fails_with_its_sentence_and_the_state_before_can_be_restored(tmp_path):
    """A budget of steps that is used up is a failure as any other."""
    fmpy()
    from fmpy.fmi1 import FMICallException

    needs_compiler()
    file = export(model(tmp_path, "pushed", PUSHED), tmp_path / "short.fmu", max_steps=30)
    with slave(file, tmp_path) as one:
        one.fmu.exitInitializationMode()
        one.step(0.1)
        state = one.fmu.getFMUState()
        with pytest.raises(FMICallException):
            change_for_ever(one)
        one.fmu.setFMUState(state)
        assert one.get("time") == [0.1]


def test_another_start_than_that_of_the_model_is_refused(tmp_path_factory, tmp_path):
    fmpy()
    from fmpy.fmi1 import FMICallException

    file = once(tmp_path_factory.getbasetemp(), "pushed", 3, PUSHED)
    with pytest.raises(FMICallException), slave(file, tmp_path, start=1.0):
        pass
