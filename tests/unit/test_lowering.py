"""The small Python that kernels are written in says in machine code what it says in Python."""

import ctypes
import functools
import itertools
import math
import random

import numpy as np
import pytest

from fairlead.native import Build, load_or_compile
from fairlead.system.lowering import INTRINSIC, LIBRARY, lower

KINDS = ("int", "I8", "F8", "F8")
HEAD = "def f(n, whole, x, out):\n"
numbers = itertools.count()


def sign(x):
    return float(x > 0) - float(x < 0)


PYTHON = {**{name: getattr(math, name) for name in (*INTRINSIC, *LIBRARY) if name != "abs"}, "sign": sign}


@pytest.fixture
def both(monkeypatch, tmp_path):
    """both(body, n, whole, x, size) -> what Python and what the machine leave in `out` and `whole`."""
    monkeypatch.setenv("FAIRLEAD_CACHE", str(tmp_path))

    def run(body, n=0, whole=(0,), x=(0.0,), size=1):
        source = HEAD + "".join(f"    {line}\n" for line in body.splitlines())
        names = dict(PYTHON)
        exec(compile(source, "text", "exec"), names)  # the text of this test
        said = [list(whole), list(x), [0.0] * size]
        names["f"](n, *said)
        native = load_or_compile(f"lowering{next(numbers)}", lambda: Build({}, {"f": lower(source, "f", KINDS)}))
        arrays = [np.array(whole, dtype=np.int64), np.array(x, dtype=float), np.zeros(size)]
        call = ctypes.CFUNCTYPE(None, ctypes.c_int64, *[ctypes.c_void_p] * 3)(native.address["f"])
        call(n, *(array.ctypes.data for array in arrays))
        return (said[2], said[0]), (arrays[2].tolist(), arrays[0].tolist())

    return run


def expression(rng, depth):
    """A random expression of x[0] .. x[3], whose functions are defined everywhere."""
    if depth == 0:
        return rng.choice(["x[0]", "x[1]", "x[2]", "x[3]", f"{rng.uniform(-3, 3):.3f}", str(rng.randint(1, 9))])
    one, two = (functools.partial(expression, rng, depth - 1) for _ in range(2))
    return rng.choice(
        [
            lambda: f"({one()} + {two()})",
            lambda: f"({one()} - {two()})",
            lambda: f"{one()}*{two()}",
            lambda: f"{one()}/(2.5 + sin({two()}))",
            lambda: f"({one()})**{rng.randint(2, 6)}",
            lambda: f"(1.5 + cos({one()}))**{rng.choice(['(-3)', '0.7', '-1.5'])}",
            lambda: f"-{one()}",
            lambda: f"exp(-abs({one()}))",
            lambda: f"log(1 + abs({one()}))",
            lambda: f"sqrt(1 + abs({one()}))",
            lambda: f"tanh({one()})",
            lambda: f"atan({one()})",
            lambda: f"min({one()}, {two()}, 0.3)",
            lambda: f"max({one()}, {two()})",
            lambda: f"sign({one()})",
        ]
    )()


@pytest.mark.parametrize("seed", range(5))
def test_random_expressions_have_the_same_values(both, seed):
    rng = random.Random(seed)
    texts = [expression(rng, 4) for _ in range(40)]
    body = "\n".join(f"out[{k}] = {text}" for k, text in enumerate(texts))
    (python, _), (machine, _) = both(body, x=[rng.uniform(-2, 2) for _ in range(4)], size=len(texts))
    # Powers by repeated multiplication and the functions of two libraries differ in the last digits.
    np.testing.assert_allclose(machine, python, rtol=1e-11, atol=1e-13)


def test_whole_numbers_stay_whole(both):
    """An index beyond 2^53 would lose its last digit as a double."""
    body = "a = whole[0] * 3 + 1\nwhole[0] = a - 2\nwhole[1] += n"
    python, machine = both(body, n=5, whole=(2**53 + 1, 7))
    assert machine == python
    assert machine[1] == [3 * 2**53 + 2, 12]


def test_loops_and_branches_nest(both):
    body = (
        "total = 0.0\n"
        "for i in range(0, n):\n"
        "    for k in range(i, n):\n"
        "        if k == 2:\n"
        "            total += x[i]*10\n"
        "        if x[k] > x[i]:\n"
        "            total += k\n"
        "        if x[k] <= 0.5:\n"
        "            whole[0] += 1\n"
        "out[0] = total"
    )
    python, machine = both(body, n=5, x=(0.1, 0.9, 0.4, 0.9, -2.0))
    assert machine == python


def test_a_loop_that_has_nothing_to_do_does_nothing(both):
    python, machine = both("out[0] = 1.0\nfor i in range(n, 2):\n    out[0] = 5.0", n=3)
    assert machine == python == ([1.0], [0])


def test_the_variable_of_a_loop_hides_an_earlier_one_of_that_name(both):
    """Once the variable on the stack was read in its place, and every turn did the first one's work."""
    python, machine = both("i = 7\nout[i - 7] = 0.5\nfor i in range(0, n):\n    out[i] += i + 1", n=4, size=4)
    assert machine == python
    assert machine[0] == [1.5, 2.0, 3.0, 4.0]


def test_two_loops_may_use_one_name(both):
    body = "for i in range(0, n):\n    out[i] = i\nfor i in range(1, n):\n    out[i] = out[i - 1] + 2*i"
    python, machine = both(body, n=4, size=4)
    assert machine == python


def test_a_pair_takes_its_values_before_either_is_stored(both):
    python, machine = both("a, b = x[0], x[1]\na, b = b, a\nout[0] = a - b", x=(1.0, 5.0))
    assert machine == python == ([4.0], [0])


def test_a_variable_first_given_a_float_stays_one(both):
    python, machine = both("a = 0.5\na = n\nout[0] = a/2", n=3)
    assert machine == python == ([1.5], [0])


@pytest.mark.parametrize("name", sorted({*INTRINSIC, *LIBRARY}))
def test_every_function_says_what_it_says_in_python(both, name):
    python, machine = both(f"out[0] = {name}(x[0])\nout[1] = {name}(x[1])", x=(0.37, 1.21), size=2)
    np.testing.assert_allclose(machine[0], python[0], rtol=1e-14)


def test_the_functions_of_the_printer_are_all_known():
    """What a traced law may contain can be written (`trace.SMOOTH`) and lowered."""
    from fairlead.component import trace

    known = {*INTRINSIC, *LIBRARY, "min", "max", "sign"}
    assert {kind.__name__.lower() for kind in (*trace.SMOOTH, *trace.KINKED)} <= known


def test_lowering_keeps_no_state_between_functions(both):
    """The same name may be whole in one function and a float in the next."""
    assert both("a = 1\nout[0] = a/2")[1] == ([0.5], [0])
    assert both("a = 1.5\nout[0] = a/2")[1] == ([0.75], [0])
