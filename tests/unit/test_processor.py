"""FAIRLEAD_CPU: machine code for this processor, or for any of its architecture."""

import os
import platform
import subprocess
import sys

import pytest

from fairlead import native
from fairlead.cli import health
from fairlead.errors import UsageError
from fairlead.kernels.lowering import lower
from fairlead.processor import chosen

INTEL = pytest.mark.skipif(platform.machine() not in ("x86_64", "AMD64"), reason="names of x86-64 registers")
WIDE = ("ymm", "zmm", "vfmadd", "vaddsd", "vmulsd")  # instructions that came after SSE2
KERNEL = "def f(n, whole, x, out):\n    for i in range(0, n):\n        out[i] = out[i] + x[i] * x[i]\n"


@pytest.fixture
def built_for(monkeypatch):
    """built_for(word) sets FAIRLEAD_CPU as if the process had begun with it."""

    def clear():
        for function in (chosen, native._environment):
            function.cache_clear()

    def choose(word):
        monkeypatch.setenv("FAIRLEAD_CPU", word)
        clear()

    yield choose
    clear()


def assembly(function):
    import llvmlite.binding as llvm

    return native.target_machine().emit_assembly(llvm.parse_assembly(function.inspect_llvm()))


def test_each_build_has_entries_of_its_own_in_the_cache(built_for):
    keys = {}
    for word in ("", "host", "generic"):
        built_for(word)
        keys[word] = native.digest("kernel")
    assert keys[""] == keys["host"] != keys["generic"]


def test_a_word_that_is_no_build_is_refused_with_the_words_that_are(built_for):
    built_for("generik")
    with pytest.raises(UsageError, match="Did you mean generic") as caught:
        native.digest("kernel")
    assert "host or generic" in str(caught.value)
    assert "host or generic" in health.processor().cure


def test_doctor_tells_what_code_is_compiled_for(built_for):
    built_for("generic")
    assert health.processor().detail.endswith(f"compiled for generic {platform.machine()}")
    built_for("host")
    assert health.processor().detail.endswith("compiled for it")


@INTEL
def test_a_generic_kernel_takes_no_instruction_that_some_processors_lack(built_for):
    built_for("generic")
    text = assembly(lower(KERNEL, "f", ("int", "I8", "F8", "F8")))
    assert "mulsd" in text or "mulpd" in text
    assert not [word for word in WIDE if word in text]


@INTEL
def test_nor_does_what_numba_compiles():
    """numba asks for the processor once a process, before its first function."""
    script = (
        "import numba, fairlead.processor as p; p.tell_numba()\n"
        "from fairlead.integrate.memory.foreign import reals\n"
        "def f(address, n):\n"
        "    x = reals(address, n)\n"
        "    for i in range(n): x[i] = x[i] * x[i] + 0.5\n"
        "f = numba.cfunc('void(i8, i8)', error_model='numpy', _nrt=False)(f)\n"
        "print(f.inspect_llvm())\n"
        "import llvmlite.binding as llvm, fairlead.native as native\n"
        "print(native.target_machine().emit_assembly(llvm.parse_assembly(f.inspect_llvm())))\n"
    )
    environment = os.environ | {"FAIRLEAD_CPU": "generic"}
    told = subprocess.run([sys.executable, "-c", script], env=environment, text=True, stdout=-1, check=True).stdout
    assert "mulsd" in told
    assert "<2 x double>" in told  # two at a time is what SSE2 has
    assert not [word for word in (*WIDE, "<4 x double>", "<8 x double>") if word in told]
