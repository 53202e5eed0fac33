"""An exported FMU does what `advance` does, in masters without Python; FMPy and a C master of our own run it."""

import os
import pathlib
import random
import shutil
import subprocess
import zipfile

import pytest

import fairlead
from fairlead.fmu import export
from tests.fmu.exported import HERE, PUSHED, fmpy, in_group, model, once, slave

SIGNALS = ["block.x", "block.v", "pad.friction", "pad.slip"]
H, STEPS = 0.02, 200  # s; five stick-slips of the belt


@pytest.fixture(scope="module")
def shared(tmp_path_factory):
    """A folder that all workers of this session have."""
    own = tmp_path_factory.getbasetemp()
    return own.parent if os.environ.get("PYTEST_XDIST_WORKER") else own


@pytest.fixture
def belt(shared):
    return lambda version: once(shared, "belt", version, outputs=SIGNALS, engine="rodas")


@pytest.fixture
def pushed(shared):
    return lambda version=3: once(shared, "pushed", version, PUSHED)


def native_belt(steps=STEPS):
    """The same points by `advance`."""
    run, rows = fairlead.load("belt").start(engine="rodas"), []
    for _ in range(steps):
        run.advance(run.t + H)
        rows.append([run.get(name) for name in SIGNALS])
    return rows


@pytest.mark.slow
@pytest.mark.parametrize("version", [2, 3])
def test_the_belt_goes_as_in_fairlead_to_the_last_bit(belt, tmp_path, version):
    fmpy()
    from fmpy.validation import validate_fmu

    file = belt(version)
    assert validate_fmu(str(file)) == []
    with slave(file, tmp_path) as one:
        one.fmu.exitInitializationMode()
        rows = []
        for _ in range(STEPS):
            one.step(H)
            rows.append(one.get(*SIGNALS))
    assert one.outputs == SIGNALS
    assert rows == native_belt()
    assert len({row[3] == 0.0 for row in rows}) == 2  # it sticks, and slips


@pytest.fixture
def master(tmp_path):
    """master(FMU, steps, outputs, instances) -> lines that our C master prints."""
    headers = pathlib.Path(fmpy().__file__).parent / "c-code"
    compiler = shutil.which("cc") or shutil.which("gcc") or shutil.which("clang")
    if compiler is None:
        pytest.skip("no C compiler is installed, which compiles the master")
    program = tmp_path / "master"
    subprocess.run(
        [compiler, f"-I{headers}", str(HERE / "master.c"), "-o", str(program), "-ldl"], check=True, timeout=600
    )

    def run(file, steps, outputs, instances=1):
        from fmpy import read_model_description

        with zipfile.ZipFile(file) as archive:
            (library,) = (name for name in archive.namelist() if name.endswith(".so"))
            archive.extract(library, tmp_path)
        token = read_model_description(str(file)).guid
        arguments = [str(tmp_path / library), token, repr(H), str(steps), str(outputs), str(instances)]
        return in_group([str(program), *arguments], env={}).splitlines()

    return run


@pytest.mark.slow
def test_a_master_in_c_runs_it_in_a_process_without_python(belt, master):
    *lines, _ = master(belt(3), STEPS, len(SIGNALS))
    assert [[float.fromhex(text) for text in line.split()] for line in lines] == native_belt()


@pytest.mark.slow
def test_a_hundred_instances_in_one_process_do_the_same_and_none_leaks_in_1e5_steps(belt, master):
    *lines, sizes = master(belt(3), 1000, len(SIGNALS), 100)
    assert len(lines) == 1000  # the master ends where an instance differs from the first one
    before, after = map(int, sizes.split())
    assert after - before < 1000  # kB, of what 9e4 steps of 100 instances would leave


def test_the_library_has_no_instruction_that_a_processor_may_lack_and_needs_libc_and_libm(belt, tmp_path):
    if shutil.which("objdump") is None:
        pytest.skip("objdump is not installed, which shows the instructions")
    with zipfile.ZipFile(belt(3)) as archive:
        (library,) = (archive.extract(name, tmp_path) for name in archive.namelist() if name.endswith(".so"))
    code = in_group(["objdump", "-d", library])
    assert "mulsd" in code
    assert not [word for word in ("ymm", "zmm", "vmulsd", "vaddsd", "vfmadd") if word in code]
    needed = [line.split()[-1] for line in in_group(["objdump", "-p", library]).splitlines() if "NEEDED" in line]
    assert set(needed) <= {"libc.so.6", "libm.so.6"}


@pytest.mark.parametrize("version", [2, 3])
def test_what_is_set_acts_from_the_point_where_it_is_set(pushed, tmp_path, version):
    """9 N on 2 kg less 5 N of friction: 2 m/s^2; then 5 N, which keeps its speed; then 0 N: -2.5 m/s^2."""
    fmpy()
    with slave(pushed(version), tmp_path) as one:
        one.fmu.exitInitializationMode()
        speeds = []
        for pull in (9.0, 5.0, 0.0):
            one.set("pull", pull)
            one.step(0.1)
            speeds += one.get("speed")
        assert one.get("pull") == [0.0]
    assert speeds == pytest.approx([0.2, 0.2, 0.0], abs=1e-9)


def test_while_it_is_initialised_what_is_set_last_counts(pushed, tmp_path):
    fmpy()
    with slave(pushed(), tmp_path) as one:
        one.set("pull", 20.0)
        assert one.get("speed", "pull") == [0.0, 20.0]
        one.set("pull", 9.0)
        assert one.get("speed", "pull") == [0.0, 9.0]
        one.fmu.exitInitializationMode()
        one.step(0.1)
        assert one.get("speed") == pytest.approx([0.2], abs=1e-9)


def test_in_event_mode_a_step_ends_where_the_block_comes_to_rest(pushed, tmp_path):
    """0.2 m/s are gone after 0.2/2.5 s."""
    fmpy()
    with slave(pushed(), tmp_path, eventModeUsed=True, earlyReturnAllowed=True) as one:
        one.fmu.exitInitializationMode()
        assert one.fmu.updateDiscreteStates()[0] is False
        one.fmu.enterStepMode()
        until_change(one, 0.1)
        one.fmu.enterEventMode()
        one.set("pull", 0.0)
        one.fmu.updateDiscreteStates()
        one.fmu.enterStepMode()
        event, _, early, reached = one.fmu.doStep(0.1, 0.4)
        assert (event, early) == (True, True)
        assert reached == pytest.approx(0.18, abs=1e-9)
        assert one.get("speed") == pytest.approx([0.0], abs=1e-12)


def until_change(one, goal):
    """Step on to `goal`, past zone changes."""
    while one.t < goal:
        event, _, _, one.t = one.fmu.doStep(one.t, goal - one.t)
        if event:
            one.fmu.enterEventMode()
            one.fmu.updateDiscreteStates()
            one.fmu.enterStepMode()


@pytest.mark.parametrize("version", [2, 3])
def test_a_state_goes_back_and_into_another_instance(pushed, tmp_path, version):
    fmpy()
    file = pushed(version)

    def on(one):
        one.set("pull", 0.0)
        one.step(0.05)
        return one.get("speed", "pull")

    with slave(file, tmp_path / "a") as one, slave(file, tmp_path / "b") as other:
        names = ("FMUState", "serializeFMUState", "deserializeFMUState") if version == 3 else (
            "FMUstate", "serializeFMUstate", "deSerializeFMUstate"
        )  # fmt: skip
        one.fmu.exitInitializationMode()
        one.step(0.1)
        state = getattr(one.fmu, f"get{names[0]}")()
        content = getattr(one.fmu, names[1])(state)
        first = on(one)
        getattr(one.fmu, f"set{names[0]}")(state)
        one.t = 0.1
        assert on(one) == first
        other.fmu.exitInitializationMode()
        getattr(other.fmu, f"set{names[0]}")(getattr(other.fmu, names[2])(content))
        other.t = 0.1
        assert on(other) == first
        assert first == pytest.approx([0.075, 0.0], abs=1e-9)


@pytest.mark.slow
def test_a_state_saved_and_restored_a_thousand_times_at_random_gives_the_same_run(belt, tmp_path):
    """A run that goes astray after every state it keeps and comes back gives the points of one that does not."""
    fmpy()
    dice, rows = random.Random(7), []
    with slave(belt(3), tmp_path) as one:
        one.fmu.exitInitializationMode()
        for _ in range(1000):
            t, state = one.t, one.fmu.getFMUState()
            for _ in range(dice.randrange(3)):
                one.step(dice.random())
            one.fmu.setFMUState(state)
            one.fmu.freeFMUState(state)
            one.t = t
            one.step(H)
            rows.append(one.get(*SIGNALS))
    assert rows == native_belt(1000)


@pytest.mark.slow
def test_two_exports_have_the_same_bytes(pushed, tmp_path):
    again = export(model(tmp_path, "pushed", PUSHED), tmp_path / "again.fmu")
    assert again.read_bytes() == pushed().read_bytes()


def test_the_description_tells_names_units_sizes_and_starts(pushed):
    fmpy()
    from fmpy import read_model_description

    told = read_model_description(str(pushed()))
    time, pull, speed = told.modelVariables
    assert (time.causality, time.unit) == ("independent", "s")
    assert (pull.name, pull.causality, pull.unit, pull.start, pull.nominal) == ("pull", "input", "N", "9.0", "10.0")
    assert (speed.name, speed.causality, speed.unit, speed.nominal) == ("speed", "output", "m/s", "0.2")
    assert (pull.description, speed.description) == ("Force on the block.", 'Of the <block>, "v" & co.')
    assert told.coSimulation.canGetAndSetFMUstate
    assert told.defaultExperiment.stopTime == "1.0"


@pytest.mark.slow
@pytest.mark.parametrize("version", [2, 3])
def test_a_step_beyond_the_stop_time_that_the_master_has_set_is_an_error(tmp_path, version):
    fmpy()
    file = once(tmp_path, "ends", version, PUSHED)
    for stop in (0.3, None):
        with slave(file, tmp_path / f"at {stop}", stop=stop) as one:
            one.fmu.exitInitializationMode()
            for _ in range(3):
                one.step(0.1)  # which add up to a rounding more than 0.3
            if stop is None:
                one.step(7.0)
            else:
                with pytest.raises(Exception, match="error"):
                    one.step(0.1)
