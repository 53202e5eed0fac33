"""A model as a C library does what `advance` does, in a program without Python, under names that C takes."""

import os
import pathlib
import shutil
import subprocess
import sys

import pytest

import fairlead
from fairlead.errors import UsageError
from fairlead.fmu import export_library
from fairlead.fmu.library import header_text, prefix
from fairlead.outer import Variable
from tests.fmu.exported import HERE, PATIENCE, PUSHED, in_group, model, needs_compiler
from tests.unit.test_docs import blocks, files

FRAMES = """
#include "pushed.h"
#include <stdio.h>
int main(void) {
    pushed *run = pushed_new();
    double speed;
    for (int k = 1; k <= 20; k++) {
        if (k == 8) pushed_set(run, 0, 9.0);
        if (pushed_advance(run, k * 0.01, 0, NULL) || pushed_get(run, 0, &speed)) puts(pushed_message(run));
        printf("%a\\n", speed);
    }
    printf("%lld\\n", pushed_overruns(run));
    pushed_free(run);
    return 0;
}
"""

STRICT = ("-Wall", "-Wextra", "-Werror", "-pedantic")


def built(folder, source, name):
    """A program that is linked with a library, both in one folder."""
    command = [
        shutil.which("cc") or shutil.which("gcc") or shutil.which("clang"),
        *STRICT,
        str(source),
        "-o",
        "program",
    ]
    command += ["-I.", "-L.", f"-l{name}", "-lm", f"-Wl,-rpath,{folder}"]
    subprocess.run(command, cwd=folder, check=True, timeout=PATIENCE)
    return str(folder / "program")


@pytest.fixture
def pushed(tmp_path):
    needs_compiler()
    return export_library(model(tmp_path, "pushed", PUSHED), tmp_path / "pushed")


def test_a_program_in_c_sets_advances_reads_saves_and_restores(pushed):
    """9 N on 2 kg less 5 N of friction: 2 m/s^2; then nothing: at rest after 0.08 s; or 5 N, which keeps the speed."""
    names, unknown, first, rest, other, *refused, again = in_group(
        [built(pushed, HERE / "user.c", "pushed")], env={}
    ).splitlines()
    assert (names, unknown) == ("pull speed", "1 1")
    assert [float.fromhex(text) for text in first.split()] == pytest.approx([0.1, 0.2], abs=1e-9)
    changed, t = rest.split()
    assert (changed, float.fromhex(t)) == ("1", pytest.approx(0.18, abs=1e-9))
    changed, t, speed = other.split()
    assert (changed, float.fromhex(t)) == ("0", 0.2)
    assert float.fromhex(speed) == pytest.approx(0.2, abs=1e-9)
    assert [text.split(":")[0] for text in refused] == ["advance", "set", "set", "get", "save", "restore"]
    assert "already" in refused[0]
    assert "finite" in refused[2]
    assert float.fromhex(again) == 0.0


@pytest.mark.slow
def test_the_example_beside_a_library_runs_and_goes_as_in_fairlead(tmp_path):
    needs_compiler()
    folder = export_library(fairlead.load("belt"), tmp_path / "belt", outputs=["block.x"], engine="rodas")
    text = (folder / "example.c").read_text()
    (folder / "exact.c").write_text(text.replace("%s %g", "%s %a"))
    *_, last = in_group([built(folder, folder / "exact.c", "belt")], env={}).splitlines()
    run = fairlead.load("belt").start(engine="rodas")
    for k in range(21):
        run.advance(2.0 * k)
    assert last.split()[0] == "40"
    assert float.fromhex(last.split()[-1]) == run.get("block.x")


TUNES = """
#include "tuned.h"
#include <stdio.h>

int main(void) {
    double speed;
    tuned *run = tuned_new();
    if (run == NULL || tuned_set(run, tuned_INPUT_pull, 9.0) || tuned_tune(run, tuned_PARAMETER_load, 4.0)) return 1;
    if (tuned_advance(run, 0.1, 0, NULL) || tuned_tune(run, tuned_PARAMETER_load, 14.0)) return 1;
    unsigned char state[1 << 15];
    if (tuned_save(run, state, sizeof state) || tuned_advance(run, 0.2, 0, NULL)) return 1;
    if (tuned_get(run, tuned_OUTPUT_speed, &speed)) return 1;
    printf("%a\\n", speed);
    if (tuned_restore(run, state, tuned_state_size(run)) || tuned_tune(run, tuned_PARAMETER_load, 10.0)) return 1;
    if (tuned_advance(run, 0.2, 0, NULL) || tuned_get(run, tuned_OUTPUT_speed, &speed)) return 1;
    printf("%a\\n", speed);
    if (tuned_tune(run, tuned_PARAMETER_load, 1e9) != -1) return 1;
    printf("%s\\n", tuned_message(run));
    tuned_free(run);
    return 0;
}
"""


@pytest.mark.slow
def test_a_parameter_is_tuned_from_c(tmp_path):
    """(9 - 2) N and then (9 - 7) N or (9 - 5) N on 2 kg, for 0.1 s each."""
    needs_compiler()
    scene = PUSHED + "  tunable: {load: pad.normal_force}\n"
    folder = export_library(model(tmp_path, "tuned", scene), tmp_path / "tuned")
    (folder / "tunes.c").write_text(TUNES)
    one, other, refused = in_group([built(folder, folder / "tunes.c", "tuned")], env={}).splitlines()
    assert float.fromhex(one) == pytest.approx(0.35 + 0.1, abs=1e-7)
    assert float.fromhex(other) == pytest.approx(0.35 + 0.2, abs=1e-7)
    assert refused == "tune: load = 1e+09 is beyond its range. It can be set from 1.25 to 80."


def test_names_that_c_does_not_take_are_changed_and_stay_apart(tmp_path):
    """Words of C, names with dots, two that would become one, descriptions that would end a comment."""
    needs_compiler()
    compiler = shutil.which("cc") or shutil.which("gcc") or shutil.which("clang")
    said = "ends */ here /* and \\"
    variables = [
        Variable("a.b", "input", "p.a", "N", said, 1.5, 1.0),
        Variable("a_b", "input", "p.b", "1", "", None, 1.0),
        Variable("größe", "output", "p.c", "m", "", None, 1.0),
    ]
    assert (prefix("double"), prefix("7 up"), prefix("belt")) == ("model_double", "model_7_up", "belt")
    text = header_text(prefix("double"), "*/ double \n#error", variables)
    (tmp_path / "h.h").write_text(text)
    (tmp_path / "h.c").write_text(
        '#include "h.h"\nint both[] = {model_double_INPUT_a_b, model_double_INPUT_a_b_, model_double_INPUTS,'
        " model_double_OUTPUT_gr__e};\n"
    )
    subprocess.run([compiler, *STRICT, "-fsyntax-only", "h.c"], cwd=tmp_path, check=True, timeout=PATIENCE)
    assert "[N]" in text
    assert "1.5 until it is set" in text
    if shutil.which("g++"):
        subprocess.run(
            ["g++", *STRICT, "-fsyntax-only", "-x", "c++", "h.h"], cwd=tmp_path, check=True, timeout=PATIENCE
        )


def test_the_program_on_the_page_is_compiled_as_shown_and_tells_the_speed(tmp_path):
    """9 N on 2 kg less 5 N of friction, for 0.1 s."""
    needs_compiler()
    if shutil.which("cc") is None:
        pytest.skip("there is no cc, which the page calls")
    files("coupling", tmp_path)
    (commands,) = [text for _, language, text in blocks("coupling") if language == "sh" and "fmu library" in text]
    path = f"{pathlib.Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    said = in_group(["sh", "-e", "-c", commands], cwd=tmp_path, env={**os.environ, "PATH": path})
    assert said.splitlines()[-1] == "0.200000 m/s at 0.100000 s"


NAMES = {
    "printf": "model_printf",
    "linux": "model_linux",
    "run": "model_run",
    "values": "model_values",
    "hoist": "hoist",
}


@pytest.mark.parametrize(("name", "prefixed"), NAMES.items())
def test_a_name_that_c_has_another_use_for_is_changed(name, prefixed):
    needs_compiler()
    assert prefix(name) == prefixed


def test_a_compiler_that_makes_nothing_is_told(tmp_path, monkeypatch):
    needs_compiler()
    scene = model(tmp_path, "pushed", PUSHED)
    for command, said in (
        ("true", "true made no library"),
        ("false", "failed with code 1"),
        ("/none", "cannot be called"),
    ):
        monkeypatch.setenv("CC", command)
        with pytest.raises(UsageError, match=rf"{said}[^\n]*\n[^\n]*\(CC\)"):
            export_library(scene, tmp_path / "made")


def test_two_libraries_of_a_model_have_the_same_bytes(pushed, tmp_path):
    again = export_library(model(tmp_path, "pushed", PUSHED), tmp_path / "again")
    for file in sorted(pushed.iterdir()):
        assert (again / file.name).read_bytes() == file.read_bytes()


@pytest.mark.slow
def test_a_library_made_for_real_time_takes_the_steps_that_advance_takes(tmp_path):
    """Frames of 7 ms, divided by the ends of the calls."""
    needs_compiler()
    scene = model(tmp_path, "pushed", PUSHED)
    folder = export_library(scene, tmp_path / "pushed", engine="auto", real_time="7 ms")
    (folder / "frames.c").write_text(FRAMES)
    *speeds, overruns = in_group([built(folder, folder / "frames.c", "pushed")], env={}).split()
    run, own = scene.start(engine="auto", real_time="7 ms"), []
    for k in range(1, 21):
        if k == 8:
            run.set("pull", 9.0)
        run.advance(k * 0.01)
        own.append(run.get("speed"))
    assert [float.fromhex(one) for one in speeds] == own
    assert int(overruns) == run.overruns == 0
