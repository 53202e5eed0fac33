"""Two runs give bitwise the same result: other processes, another order of runs, another order of Python's sets.

What is compared is all a run leaves: every recorded row, the zone log, the last state and the counters; and of runs
by command the files, every variable of `series.nc` and the bytes of `events.csv`, also beside a busy process.
"""

import contextlib
import functools
import hashlib
import json
import os
import subprocess
import sys
from pathlib import Path

import h5py
import pytest

import fairlead
from fairlead.integrate import Run, integrate
from tests.models.test_names_say_nothing import pads
from tests.scenes.networks import network
from tests.scenes.routes import route

ROOT = Path(__file__).parents[2]
IDLE = """schema: 1
name: idle
components:
  rod: {type: RodOnGuides, blocks: 1000, mass: 100 kg, axial_stiffness: 1 kN, damping_time: 0.002 s, friction: 500 N}
  hook: {type: SpringDamper, stiffness: 2000 N/m, damping: 4 N*s/m}
  hand: {type: MotionSource, position: {sine: {amplitude: 2.7 mm, frequency: 1 Hz}}}
connections:
  - [rod.end, hook.a]
  - [hook.b, hand.flange]
friction: {method: hold}
run: {stop: 4 s, accuracy: 1e-4}
"""
"""Ten blocks at the end move, 990 stand and are left out."""
SECONDS = {"sandwich": 2.0, "single_bend": 1.0, "winch_drive": 0.5, "guidance_route_electric": 0.03, "torsion": 0.5,
           "hundred_blocks": 0.3, "slack_start": 0.03, "idle": 4.0}  # fmt: skip
"""Of each model that are run: bends, sampled control, electrics, hydraulics, routes, rings, fronts, cut-out parts."""
ENGINES = ("rodas", "stepping", "ida")
RUNS = [(name, engine) for name in SECONDS for engine in ENGINES if (name, engine) != ("idle", "ida")]


@functools.cache
def loaded(folder, name):
    """The model, which is compiled once in a process for all its runs."""
    return fairlead.load(folder / "idle.yaml" if name == "idle" else name)


def told(folder, name, engine):
    """Digest of all a run leaves, its switches and the steps it took with a part of the problem."""
    model, span = loaded(folder, name), SECONDS[name]
    start = model.netlist.run.start
    outcome = integrate(model.system, Run(start=start, stop=start + span, every=span / 50, engine=engine))
    assert outcome.ok, outcome.sentence
    counters = {key: value for key, value in vars(outcome.counters).items() if isinstance(value, int)}
    kept = [outcome.times.tobytes(), outcome.sides.tobytes(), outcome.values.tobytes(), outcome.events.tobytes()]
    kept += [outcome.y.tobytes(), json.dumps(counters, sort_keys=True).encode()]
    return hashlib.sha256(b"".join(kept)).hexdigest(), counters["switches"], counters["partial_steps"]


def all_told(folder, step):
    """What `told` says of all runs whose engine is there, taken in this order (1) or the other way round (-1)."""
    from importlib.util import find_spec

    chosen = [(name, engine) for name, engine in RUNS[::step] if engine != "ida" or find_spec("sksundae")]
    return {f"{name} {engine}": told(folder, name, engine) for name, engine in chosen}


@pytest.fixture(scope="module")
def processes(tmp_path_factory):
    """What two processes say that hash strings differently and run the models in opposite order."""
    folder = tmp_path_factory.mktemp("two")
    (folder / "idle.yaml").write_text(IDLE, encoding="utf-8")
    code = "import json, pathlib, sys; from tests.models.test_two_runs import all_told; " \
           "print(json.dumps(all_told(pathlib.Path(sys.argv[1]), int(sys.argv[2]))))"  # fmt: skip
    found = []
    for seed, step in (("1", "1"), ("2", "-1")):
        command, given = [sys.executable, "-c", code, str(folder), step], {**os.environ, "PYTHONHASHSEED": seed}
        made = subprocess.run(command, env=given, capture_output=True, text=True, check=False, cwd=ROOT)
        assert made.returncode == 0, made.stderr
        found.append(json.loads(made.stdout))
    return found


@pytest.mark.parametrize(("name", "engine"), RUNS)
def test_two_runs_are_the_same_to_the_last_bit(processes, name, engine):
    one, other = (each.get(f"{name} {engine}") for each in processes)
    if one is None:
        pytest.skip("needs scikit-sundae: pip install 'fairlead[ida]'")
    assert one == other
    assert one[1] > 0  # something switched


@pytest.mark.parametrize("engine", ["rodas", "stepping"])
def test_the_runs_that_were_compared_did_leave_out_what_stands(processes, engine):
    assert processes[0][f"idle {engine}"][2] > 20


def files_of(folder):
    """Every variable of series.nc with its numbers, and events.csv, as bytes."""
    with h5py.File(folder / "series.nc") as file:
        found = {name: file[name][()].tobytes() for name in file if file[name].dtype.kind in "fi"}
    return {**found, "events.csv": (folder / "events.csv").read_bytes()}


@contextlib.contextmanager
def busy():
    """A process beside that takes all it is given of the processor."""
    process = subprocess.Popen([sys.executable, "-c", "while True: pass"])
    try:
        yield
    finally:
        process.kill()
        process.wait()


def by_command(scene, folder, seed):
    """The files of a run by the command line, in a process of its own."""
    command = [sys.executable, "-m", "fairlead", "run", str(scene), "--out", str(folder), "--quiet"]
    given = {**os.environ, "PYTHONHASHSEED": seed}
    made = subprocess.run(command, env=given, capture_output=True, text=True, check=False)
    assert made.returncode == 0, made.stderr
    return files_of(folder)


def runs_as_files(scene, folder):
    """What a scene leaves: in a process beside a busy one; and in this process, which has run much, twice."""
    with busy():
        yield by_command(scene, folder / "pressed", "3")
    model = fairlead.load(scene)
    for name in ("here", "again"):
        model.run(out=folder / name)
        yield files_of(folder / name)


def all_files_agree(scene, folder):
    first, *others = runs_as_files(scene, folder)
    assert first["events.csv"].count(b"\n") > 1  # something switched
    assert len(first) > 3
    for other in others:
        assert other.keys() == first.keys()
        assert [name for name in first if other[name] != first[name]] == []


def test_runs_by_command_leave_the_same_files(tmp_path):
    (tmp_path / "pads.yaml").write_text(pads("ab"), encoding="utf-8")
    all_files_agree(tmp_path / "pads.yaml", tmp_path)


@pytest.mark.slow
@pytest.mark.parametrize(("make", "seed"), [(make, seed) for make in (route, network) for seed in range(1, 4)])
def test_runs_of_random_scenes_by_command_leave_the_same_files(tmp_path, make, seed):
    (tmp_path / "scene.yaml").write_text(make(seed), encoding="utf-8")
    all_files_agree(tmp_path / "scene.yaml", tmp_path)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["single_bend", "winch_drive", "torsion"])
def test_runs_of_bundled_models_by_command_leave_the_same_files(tmp_path, name):
    all_files_agree(name, tmp_path)
