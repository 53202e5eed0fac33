"""The cache of machine code: whatever happens to it, results are right and there is one warning at most."""
# ruff: noqa: E501 - laws and messages read best on one line

import json
import os
import subprocess
import sys
import textwrap
import warnings

import pytest

from fairlead import native
from fairlead.component.parameters import make
from fairlead.component.registry import known_types
from fairlead.component.values import variant_of
from fairlead.kernels import layout
from fairlead.kernels.kernel import _build
from fairlead.testing.rig import Rig

SPRING = make(known_types()["Spring"], stiffness=100.0)
CPU_BOUND = 600  # s; nothing here takes more than some seconds, but a loaded machine may be slow


@pytest.fixture
def cache(tmp_path, monkeypatch):
    folder = tmp_path / "cache"
    monkeypatch.setenv("FAIRLEAD_CACHE", str(folder))
    native._warn_once.cache_clear()
    yield folder
    native._warn_once.cache_clear()


def spring_kernel():
    return native.load_or_compile("spring", lambda: _build(variant_of(SPRING)))


def tension(compiled, monkeypatch):
    """What a spring of 100 N/m takes in at a when stretched by 0.1 m, by the machine code."""
    monkeypatch.setattr("fairlead.testing.rig.kernel", lambda variant: type("K", (), {"address": compiled.address["kernel"]}))
    rig = Rig([SPRING], [{}])
    values = {"port:a:x": 0.0, "port:b:x": 0.1}
    return rig.ask(layout.FLOWS, [values[key] for key in rig.structure.inputs], [], machine=True)[0, 0]


def warned(action):
    """What an action returns, and the texts of the cache's warnings."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        result = action()
    return result, [str(w.message) for w in caught if issubclass(w.category, native.CacheWarning)]


def test_an_entry_is_written_once_and_read_afterwards(cache, monkeypatch):
    first, second = spring_kernel(), spring_kernel()
    assert (first.cached, second.cached) == (False, True)
    assert second.meta == json.loads(json.dumps(first.meta))
    assert tension(first, monkeypatch) == tension(second, monkeypatch) == pytest.approx(-10.0)
    assert [file.name for file in cache.iterdir()] == ["spring.native"]


@pytest.mark.skipif(os.name != "posix", reason="permissions of POSIX")
def test_the_folder_is_closed_to_others(cache):
    spring_kernel()
    assert cache.stat().st_mode & 0o777 == 0o700


@pytest.mark.parametrize(
    "spoil",
    [
        lambda data: data[: len(data) // 2],
        lambda data: b"",
        lambda data: data[:-1] + bytes([data[-1] ^ 1]),
        lambda data: b"fairlead-native-0\n" + data[len(native.MAGIC) :],
        lambda data: b"\x7fELF" + data,
    ],
    ids=["torn", "empty", "one bit", "another version", "foreign"],
)
def test_a_spoilt_entry_means_one_warning_and_is_replaced(cache, monkeypatch, spoil):
    spring_kernel()
    entry = cache / "spring.native"
    entry.write_bytes(spoil(entry.read_bytes()))
    (compiled, again), said = warned(lambda: (spring_kernel(), spring_kernel()))
    assert said == ["kernel cache entry spring.native is torn or foreign; compiling again"]
    assert (compiled.cached, again.cached) == (False, True)
    assert tension(compiled, monkeypatch) == pytest.approx(-10.0)


def test_an_entry_under_the_name_of_another_is_not_taken(cache, monkeypatch):
    damper = make(known_types()["Damper"], damping=3.0)
    native.load_or_compile("damper", lambda: _build(variant_of(damper)))
    spring_kernel()
    (cache / "spring.native").write_bytes((cache / "damper.native").read_bytes())
    compiled, said = warned(spring_kernel)
    assert said == ["kernel cache entry spring.native is torn or foreign; compiling again"]
    assert tension(compiled, monkeypatch) == pytest.approx(-10.0)


@pytest.mark.skipif(os.name != "posix" or os.getuid() == 0, reason="root writes where it likes")
def test_a_folder_that_cannot_be_written_means_one_warning(cache, monkeypatch):
    cache.mkdir(mode=0o500)
    compiled, said = warned(lambda: [spring_kernel(), spring_kernel()][0])
    assert len(said) == 1
    assert "kernel cache cannot be written" in said[0]
    assert tension(compiled, monkeypatch) == pytest.approx(-10.0)


def test_a_full_disk_means_one_warning_and_leaves_no_rest(cache, monkeypatch):
    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(native.os, "replace", full)
    compiled, said = warned(lambda: [spring_kernel(), spring_kernel()][0])
    assert said == ["kernel cache cannot be written: [Errno 28] No space left on device; compiled code is kept in memory"]
    assert tension(compiled, monkeypatch) == pytest.approx(-10.0)
    assert list(cache.iterdir()) == []


@pytest.mark.skipif(os.name != "posix", reason="permissions of POSIX")
def test_code_is_not_run_from_a_folder_that_others_can_write(cache, monkeypatch):
    spring_kernel()
    cache.chmod(0o777)
    compiled, said = warned(lambda: [spring_kernel(), spring_kernel()][0])
    assert not compiled.cached
    assert len(said) == 1
    assert "belongs to or can be written by somebody else" in said[0]
    assert tension(compiled, monkeypatch) == pytest.approx(-10.0)


def test_a_file_where_the_folder_should_be_means_one_warning(cache, monkeypatch):
    cache.write_text("not a folder")
    compiled, said = warned(lambda: [spring_kernel(), spring_kernel()][0])
    assert len(said) == 1
    assert "kernel cache not used" in said[0]
    assert tension(compiled, monkeypatch) == pytest.approx(-10.0)


LIBRARY = """
from fairlead.component import Component, Law, Parameter, Translational
from helper import FACTORS, scale

class Mine(Component):
    a, b = Translational(), Translational()
    stiffness = Parameter("N/m", default=100.0)

    def law(p, a, b):
        tension = scale(p.stiffness) * FACTORS["mine"] * (b.x - a.x)
        return Law(a=-tension, b=tension, stored=tension * (b.x - a.x) / 2)
"""
HELPER = """
FACTORS = {"mine": 1.0}
WEIGHTS = [1.0, 2.0]

def scale(k):
    return k * WEIGHTS[0] * inner()

def inner():
    return 1.0 if "one" in {"one", "two", "three"} else 0.0
"""
SCRIPT = """
import json, sys, warnings
with warnings.catch_warnings(record=True) as caught:
    warnings.simplefilter("always")
    from fairlead.component.parameters import make
    from fairlead.component.registry import load_library
    from fairlead.component.values import variant_of
    from fairlead.kernels import layout
    from fairlead.kernels.kernel import kernel
    from fairlead.testing.rig import Rig
    values = make(load_library("mine.py").Mine)
    rig = Rig([values], [{}])
    at = {"port:a:x": 0.0, "port:b:x": 0.1}
    flow = rig.ask(layout.FLOWS, [at[key] for key in rig.structure.inputs], [], machine=True)[0, 0]
    cached = kernel(variant_of(values)).native.cached
warned = [str(w.message) for w in caught if "cache" in str(w.message)]
print(json.dumps({"flow": flow, "cached": bool(cached), "warned": warned}))
"""


@pytest.fixture
def process(tmp_path, cache):
    """Starts a fresh interpreter that runs SCRIPT beside the library; returns a function that waits for its answer."""
    (tmp_path / "mine.py").write_text(LIBRARY)
    (tmp_path / "helper.py").write_text(HELPER)
    surroundings = {**os.environ, "PYTHONPATH": str(tmp_path), "PYTHONDONTWRITEBYTECODE": "1"}

    def start():
        running = subprocess.Popen([sys.executable, "-c", textwrap.dedent(SCRIPT)], cwd=tmp_path, env=surroundings,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)  # fmt: skip

        def answer():
            out, err = running.communicate(timeout=CPU_BOUND)
            assert running.returncode == 0, err
            return json.loads(out)

        return answer

    return start


@pytest.mark.parametrize(
    ("before", "after", "flow"),
    [
        pytest.param('"mine": 1.0', '"mine": 2.0', -20.0, id="value in a dict", marks=pytest.mark.slow),
        pytest.param("[1.0, 2.0]", "[2.0, 1.0]", -20.0, id="list in another order", marks=pytest.mark.slow),
        pytest.param("return 1.0 if", "return 3.0 if", -30.0, id="helper of a helper"),
    ],
)
def test_a_change_in_another_file_compiles_again(tmp_path, process, before, after, flow):
    assert process()()["flow"] == pytest.approx(-10.0)
    assert process()()["cached"]
    (tmp_path / "helper.py").write_text(HELPER.replace(before, after))
    changed = process()()
    assert not changed["cached"]
    assert changed["flow"] == pytest.approx(flow)
    (tmp_path / "helper.py").write_text(HELPER)
    assert process()() == {"flow": pytest.approx(-10.0), "cached": True, "warned": []}


@pytest.mark.slow
def test_of_two_processes_at_once_one_compiles_and_the_other_waits_for_it(process, cache):
    answers = [start() for start in [process(), process()]]
    assert [answer["flow"] for answer in answers] == [pytest.approx(-10.0)] * 2
    assert [answer["warned"] for answer in answers] == [[], []]
    assert sorted(answer["cached"] for answer in answers) == [False, True]
    assert not [file.name for file in cache.iterdir() if not file.name.endswith(".native")]


@pytest.mark.slow  # four processes
def test_the_key_of_a_class_is_the_same_in_every_process(process):
    """Sets of text have another order in every process; the key must not see it."""
    assert not process()()["cached"]
    assert all(process()()["cached"] for _ in range(3))
