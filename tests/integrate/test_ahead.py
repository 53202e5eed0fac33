"""Code compiled ahead: bitcode from a file becomes machine code here, or it is told why it cannot."""

import ctypes
import dataclasses
import importlib.util
from types import SimpleNamespace

import llvmlite.binding as llvm
import pytest

from fairlead import native, sealed
from fairlead.errors import UsageError
from fairlead.integrate import ahead, machine_code
from fairlead.integrate.bitcode import SEPARATOR, _told, keep, kept_with_native, loop_bitcode, make_here
from fairlead.integrate.engine import Engine
from fairlead.integrate.engines import ENGINES
from fairlead.kernels.lowering import lower

SQUARES = "def f(n, whole, x, out):\n    for i in range(0, n):\n        out[i] = out[i] + x[i] * x[i]\n"
LOOP = machine_code.loop_code(Engine("own", "nowhere.method"))


def bitcode(sources):
    """A function of one's own as a wheel holds the loop."""
    made = lower(SQUARES, "f", ("int", "I8", "F8", "F8"))
    code = llvm.parse_assembly(made.inspect_llvm()).as_bitcode()
    return ahead.Bitcode(sources, ahead.this_system(), llvm.llvm_version_info[0], {"f": (made.native_name, code)})


@pytest.fixture
def installed(tmp_path, monkeypatch):
    """installed(bitcode) has it where a wheel has its own; the cache is empty."""
    monkeypatch.setattr(ahead, "FOLDER", tmp_path)
    monkeypatch.setenv("FAIRLEAD_CACHE", str(tmp_path / "cache"))
    monkeypatch.delenv("FAIRLEAD_CHECK_INDICES", raising=False)

    def put(stored):
        path = tmp_path / f"{LOOP.module}.bitcode"
        ahead.write(path, stored)
        return path

    return put


@pytest.fixture
def without_numba(monkeypatch):
    find = importlib.util.find_spec

    def find_others(name, *rest):
        return None if name == "numba" else find(name, *rest)

    monkeypatch.setattr(importlib.util, "find_spec", find_others)


def squares_of(code):
    x, out = (ctypes.c_double * 9)(*range(9)), (ctypes.c_double * 9)(*[0.5] * 9)
    kind = ctypes.CFUNCTYPE(None, ctypes.c_int64, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p)
    kind(code.address["f"])(9, None, ctypes.addressof(x), ctypes.addressof(out))
    return list(out)


def test_bitcode_runs_here_and_is_made_native_once(installed, without_numba):
    installed(bitcode(LOOP.fingerprint()))
    first, second = LOOP.loaded(), LOOP.loaded()
    assert (first.cached, second.cached) == (False, True)
    assert squares_of(first) == squares_of(second) == [0.5 + k * k for k in range(9)]


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ({"sources": "others"}, "other sources"),
        ({"system": "riscv64 plan9"}, "is for riscv64 plan9, and this is"),
        ({"llvm": 999}, "needs LLVM 999"),
    ],
)
def test_bitcode_that_does_not_fit_is_named_where_numba_is_missing(installed, without_numba, change, told):
    installed(dataclasses.replace(bitcode(LOOP.fingerprint()), **change))
    with pytest.raises(UsageError, match=told) as caught:
        LOOP.loaded()
    assert "nowhere.method" in str(caught.value)
    assert "fairlead[compile]" in str(caught.value)


def test_bitcode_that_does_not_fit_is_compiled_anew_where_numba_is(installed, monkeypatch):
    installed(bitcode("others"))
    made = lower(SQUARES, "f", ("int", "I8", "F8", "F8"))
    monkeypatch.setattr(machine_code, "_build", lambda module: native.Build({}, {"f": made}))
    assert squares_of(LOOP.loaded())[3] == 9.5


def test_torn_bitcode_and_none_are_named(installed, without_numba):
    with pytest.raises(UsageError, match="no code compiled ahead is installed"):
        LOOP.loaded()
    path = installed(bitcode(LOOP.fingerprint()))
    path.write_bytes(path.read_bytes()[:-1])
    with pytest.raises(sealed.BrokenSealError):
        ahead.read(path)
    with pytest.raises(UsageError, match="torn"):
        LOOP.loaded()


def test_a_loop_that_asks_for_its_indices_is_not_the_one_compiled_ahead(installed, without_numba, monkeypatch):
    installed(bitcode(LOOP.fingerprint()))
    monkeypatch.setenv("FAIRLEAD_CHECK_INDICES", "1")
    with pytest.raises(UsageError, match="FAIRLEAD_CHECK_INDICES is set"):
        LOOP.loaded()


def test_bitcode_that_was_kept_for_export_gives_the_machine_code_as_well(installed, monkeypatch):
    """numba compiles the bitcode, in a process of its own, and nothing besides."""
    made = []

    def make(code, path):
        made.append(code)
        ahead.write(path, bitcode(code.fingerprint()))

    monkeypatch.setattr("fairlead.integrate.bitcode._make", make)
    kept_with_native(LOOP)
    kept_with_native(LOOP)
    found = LOOP.loaded()
    assert made == [LOOP]
    assert found.cached
    assert squares_of(found) == [0.5 + k * k for k in range(9)]


def test_a_loop_that_asks_for_its_indices_is_not_made_of_what_was_kept_for_export(installed, monkeypatch):
    monkeypatch.setattr("fairlead.integrate.bitcode._make", lambda code, path: ahead.write(path, bitcode("any")))
    monkeypatch.setenv("FAIRLEAD_CHECK_INDICES", "1")
    with pytest.raises(ModuleNotFoundError, match="nowhere"):  # numba is asked to compile it
        kept_with_native(LOOP)


def test_what_is_made_together_is_a_file_each(tmp_path):
    made = native.Build({}, {"f": lower(SQUARES, "f", ("int", "I8", "F8", "F8"))})
    codes = [SimpleNamespace(build=lambda cpu: made, fingerprint=lambda name=name: name) for name in ("one", "two")]
    make_here([(code, tmp_path / code.fingerprint()) for code in codes])
    for name in ("one", "two"):
        assert ahead.read(tmp_path / name) == bitcode(name)
    with pytest.raises(OSError, match=r"could not be made|No such file"):
        make_here([(codes[0], tmp_path / "nowhere" / "one")])


def test_loops_are_in_vectors_before_the_processor_is_known():
    text = str(llvm.parse_bitcode(loop_bitcode(ENGINES["rodas"])))
    assert text.count(" x double>") > 100  # no pass would put them there when the code is made native
    assert not [line for line in text.splitlines() if "call" in line and "@llvm.x86." in line]


def test_what_is_missing_is_made_by_one_process_that_is_told_all_of_it(installed, monkeypatch):
    other = machine_code.Compiled("other.method", ("a", "b"))
    asked = []

    def make(targets):
        asked.append([code for code, _ in targets])
        words = [word for code, path in targets for word in (SEPARATOR, str(path), code.module, *code.sources)]
        assert _told(words) == targets
        for code, path in targets:
            ahead.write(path, bitcode(code.fingerprint()))

    monkeypatch.setattr(machine_code.Compiled, "fingerprint", lambda self: self.module)
    monkeypatch.setattr("fairlead.integrate.bitcode._make_together", make)
    keep([LOOP])
    keep([LOOP, other])
    keep([LOOP, other])
    assert asked == [[LOOP], [other]]
