"""The small Python that kernels are written in says in machine code what it says in Python."""

import ctypes
import functools
import itertools
import math
import random

import numpy as np
import pytest

import fairlead.native as native
from fairlead.kernels.lowered_values import INTRINSIC, LIBRARY, LoweringError
from fairlead.kernels.lowering import lower, lower_together
from fairlead.native import Build, load_or_compile

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
        made = load_or_compile(f"lowering{next(numbers)}", lambda: Build({}, {"f": lower(source, "f", KINDS)}))
        arrays = [np.array(whole, dtype=np.int64), np.array(x, dtype=float), np.zeros(size)]
        call = ctypes.CFUNCTYPE(None, ctypes.c_int64, *[ctypes.c_void_p] * 3)(made.address["f"])
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


class Programs:
    """Random programs over whole a, b, float u, v, the arrays x and out (8 floats) and whole (8).

    Only what is rounded the same way everywhere occurs, so that machine and Python must agree in every bit.
    Wholes are kept small and indices inside, by %.
    """

    def __init__(self, seed):
        self.rng, self.loops = random.Random(seed), []

    def program(self):
        head = [f"a, b = {self.rng.randint(-9, 9)}, {self.rng.randint(-9, 9)}", "u, v = x[0], x[1]"]
        statements = [line for _ in range(6) for line in self.statement(3)]
        tail = ["out[0] = u", "out[1] = v", "whole[0] = a", "whole[1] = b"]
        return "\n".join([*head, *statements, *tail])

    def pick(self, *ways):
        return self.rng.choice(ways)()

    def whole(self, depth):
        if depth == 0:
            return self.rng.choice(["a", "b", "n", "whole[2]", str(self.rng.randint(0, 9)), "True", *self.loops])
        one, two = self.whole(depth - 1), self.whole(depth - 1)
        return self.pick(
            lambda: f"(({one} {self.rng.choice('+-*')} {two}) % {self.rng.randint(2, 99)})",
            lambda: f"({one} // {self.rng.randint(1, 9)})",
            lambda: f"(-{one})",
            lambda: f"abs({one})",
            lambda: f"(({one}) % 7)**{self.rng.randint(0, 4)}",
            lambda: f"{self.rng.choice(['min', 'max'])}({one}, {two}, 5)",
            lambda: f"whole[({one}) % 8]",
        )

    def float(self, depth):
        if depth == 0:
            return self.rng.choice(["u", "v", "x[3]", "out[4]", "0.5", "(-1.25)", "1e309"])
        one, two = self.float(depth - 1), self.float(depth - 1)
        return self.pick(
            lambda: f"({one} {self.rng.choice('+-*')} {self.rng.choice([two, self.whole(1)])})",
            lambda: f"({one})/(1.5 + abs({two}))",
            lambda: f"({self.whole(1)})/7",
            lambda: f"(-{one})",
            lambda: f"sqrt(abs({one}))",
            lambda: f"sign({one})",
            lambda: f"{self.rng.choice(['min', 'max'])}({one}, {two}, {self.whole(1)})",
            lambda: f"x[({self.whole(1)}) % 8]",
        )

    def condition(self, depth):
        if depth == 0:
            ways, signs = [self.whole, self.float], ["==", "!=", "<", "<=", ">", ">="]
            values = [self.rng.choice(ways)(1) for _ in range(self.rng.randint(2, 4))]
            return values[0] + "".join(f" {self.rng.choice(signs)} {value}" for value in values[1:])
        one, two = self.condition(depth - 1), self.condition(depth - 1)
        return self.pick(
            lambda: f"({one} and {two})", lambda: f"({one} or {two})", lambda: f"not ({one})",
            lambda: f"({one} or {two} and not {self.whole(1)})", lambda: self.float(1), lambda: one,
        )  # fmt: skip

    def block(self, depth, *ahead):
        lines = [*ahead, *(line for _ in range(self.rng.randint(1, 3)) for line in self.statement(depth - 1))]
        return ["    " + line for line in lines]

    def statement(self, depth):
        simple = [self.assign, self.add, self.swap]
        return self.rng.choice(simple if depth == 0 else [*simple, self.branch, self.branch, self.loop, self.turns])(
            depth
        )

    def assign(self, depth):
        return self.pick(
            lambda: [f"{self.rng.choice('ab')} = {self.whole(2)} % 50"],
            lambda: [f"{self.rng.choice(['u', 'v', 'out[2] = u', 'v = x[5]'])} = {self.float(2)}"],
            lambda: [f"whole[({self.whole(1)}) % 8] = {self.whole(1)} % 50"],
            lambda: [f"out[({self.whole(1)}) % 8] = {self.rng.choice([self.float, self.whole])(1)}"],
        )

    def add(self, depth):
        return self.pick(
            lambda: [f"{self.rng.choice(['a', 'whole[3]'])} {self.rng.choice('+-')}= {self.whole(1)} % 9", "a %= 40"],
            lambda: [f"b {self.rng.choice(['//= 3', '*= -2', '**= 2'])}", "b %= 40"],
            lambda: [f"{self.rng.choice(['u', 'out[6]'])} {self.rng.choice('+-*')}= {self.float(1)}"],
            lambda: [f"v /= 2 + abs({self.float(1)})"],
        )

    def swap(self, depth):
        return [self.rng.choice(["a, b = b, a", "u, v = v, u", "x[0], u = u, x[1]", "out[1], out[2] = out[2], v"])]

    def branch(self, depth):
        lines = [f"if {self.condition(2)}:", *self.block(depth)]
        for _ in range(self.rng.randint(0, 2)):
            lines += [f"elif {self.condition(1)}:", *self.block(depth)]
        return lines + (["else:", *self.block(depth)] if self.rng.random() < 0.6 else [])

    def loop(self, depth):
        name = self.rng.choice(["a", "b", f"k{depth}"])  # a loop may run over a variable that has a value already
        ends = self.rng.choice([f"{self.whole(1)} % 5", f"{self.whole(1)} % 4, {self.whole(1)} % 6"])
        self.loops.append(name)
        lines = [f"for {name} in range({ends}):", *self.block(depth)]
        self.loops.remove(name)
        return lines

    def turns(self, depth):
        turns = f"t{depth}"
        return [f"{turns} = 0", f"while {turns} < 4 and {self.condition(1)}:", *self.block(depth, f"{turns} += 1")]


@pytest.mark.parametrize("seed", range(20))
def test_random_programs_do_the_same(both, seed):
    """Nested branches and loops, chained comparisons, and, or, not; whole numbers, floats, infinities and nans."""
    rng = random.Random(1000 + seed)
    start = [rng.choice([rng.uniform(-3, 3), 0.0, float(rng.randint(-2, 2))]) for _ in range(8)]
    whole = tuple(rng.randint(-9, 9) for _ in range(8))
    text = Programs(seed).program()
    python, machine = both(text, n=rng.randint(-3, 6), whole=whole, x=start, size=8)
    np.testing.assert_array_equal(machine[0], python[0], err_msg=text)  # nan where nan is
    assert machine[1] == [int(value) for value in python[1]], text


def test_the_other_branch_is_taken(both):
    """Once `else:` was dropped without a word."""
    body = "if x[0] > 0:\n    out[0] = 1.0\nelif x[0] == 0:\n    out[0] = 2.0\nelse:\n    out[0] = 3.0"
    assert [both(body, x=(x,))[1][0] for x in (0.5, 0.0, -0.5)] == [[1.0], [2.0], [3.0]]


@pytest.mark.parametrize("test", ["0 < x[0] < 3", "3 > x[0] > 0", "0 <= x[0] <= x[0] < 3 != 4"])
def test_comparisons_in_a_chain_must_all_hold(both, test):
    """Once `0 < a < 3` was `a > 0`."""
    body = f"if {test}:\n    out[0] = 1.0"
    for x in (-1.0, 1.0, 5.0, math.nan):
        python, machine = both(body, x=(x,))
        assert machine == python


def test_what_stands_behind_and_or_or_is_looked_at_only_where_it_counts(both):
    """Otherwise the element far outside of the array would be read."""
    body = (
        "if n < 1 and x[n] > 0:\n    out[0] = 1.0\n"
        "if n > 1 or x[n] > 0:\n    out[1] = 1.0\n"
        "if 5 < 1 < x[n]:\n    out[0] = 3.0"
    )
    python, machine = both(body, n=2**50, size=2)
    assert machine == python == ([0.0, 1.0], [0])


def test_nan_is_unlike_itself_and_chooses_as_in_python(both):
    body = (
        "if x[0] != x[0]:\n    out[0] = 1.0\n"
        "if x[0] == x[0]:\n    out[1] = 1.0\n"
        "if not x[0] < 1:\n    out[2] = 1.0\n"
        "if x[0]:\n    out[3] = 1.0\n"
        "out[4] = min(x[0], 1.0)\nout[5] = min(1.0, x[0])\nout[6] = max(x[0], 1.0)\nout[7] = max(1, x[0])"
    )
    python, machine = both(body, x=(math.nan,), size=8)
    np.testing.assert_array_equal(machine[0], python[0])
    assert machine[0][:4] == [1.0, 0.0, 1.0, 1.0]


def test_whole_division_rounds_downwards(both):
    body = "for i in range(0, 9):\n    whole[i] = (i - 4) // 3\n    whole[i + 9] = (i - 4) % 3\nout[0] = n/4"
    python, machine = both(body, n=3, whole=[0] * 18)
    assert machine == python
    assert machine[0] == [0.75]


def test_an_argument_may_be_given_another_value(both):
    python, machine = both("if n > 2:\n    n = 2\nn *= 5\nout[0] = n", n=4)
    assert machine == python == ([10.0], [0])


def test_a_function_may_end_early(both):
    body = "for i in range(0, 9):\n    if i == n:\n        return\n    out[0] += 1\nout[0] = 0.0"
    python, machine = both(body, n=4)
    assert machine == python == ([4.0], [0])


REFUSED = {
    "x[0] = 1.0 if n > 0 else 2.0": "no such expression here",
    "a = n > 0": "a condition stands in `if` and `while` only",
    "a = n and 3": "a condition stands in `if` and `while` only",
    "a = not n": "a condition stands in `if` and `while` only",
    "a = ~n": "a condition",
    "a = n // 0": "by a whole constant above zero",
    "a = n % -2": "by a whole constant above zero",
    "a = x[0] % 2": "by a whole constant above zero",
    "a = 7 // n": "by a whole constant above zero",
    "a = n ** n": "whole or not by its sign",
    "a = n ** 64": "more than 64 bit",
    "a = n @ n": "there are",
    "a = n << 2": "there are",
    "a = 9223372036854775808": "64 bit",
    "a = 'word'": "neither a float",
    "a = 2j": "neither a float",
    "a = x[-1]": "count from its beginning",
    "a = x[0.5]": "an index is a whole number",
    "a = x[x[0]]": "an index is a whole number",
    "a = x[0:1]": "no such expression",
    "a = n[0]": "not an array",
    "a = x + 1": "an array of floats where a number is wanted",
    "a = 1\na = 0.5": "a is a whole number and cannot take a float",
    "a = 1\na /= 2": "a is a whole number and cannot take a float",
    "a = 0.5\na = x": "a is a float and cannot take an array of floats",
    "whole[0] = 0.5": "the element is a whole number and cannot take a float",
    "whole[0] /= 2": "the element is a whole number and cannot take a float",
    "if n > 0:\n    a = 1.0\nout[0] = a": "a has a value on some ways",
    "for i in range(0, n):\n    a = i\nout[0] = a": "a has a value on some ways",
    "while n > 0:\n    n -= 1\n    a = n\nout[0] = a": "a has a value on some ways",
    "for i in range(0, n):\n    a = i\nout[0] = i": "i has a value on some ways",
    "out[0] = b": "b has no value here",
    "b += 1": "b has no value here",
    "for i in range(0, 9, 2):\n    a = i": "range takes a start and a stop",
    "for i in range(0, 0.5):\n    a = i": "an end of range is a whole number",
    "for i in x:\n    a = i": "a loop runs over range",
    "for i in range(0, n):\n    a = i\nelse:\n    a = 2": "without else",
    "while n > 0:\n    n -= 1\nelse:\n    n = 2": "no else",
    "for i in range(0, n):\n    break": "no such statement",
    "for i in range(0, n):\n    continue": "no such statement",
    "a: int = 1": "no such statement",
    "assert n": "no such statement",
    "if (a := n) > 0:\n    out[0] = a": "no such expression",
    "if n is 3:\n    out[0] = 1": "numbers are compared by",
    "if n in x:\n    out[0] = 1": "numbers are compared by",
    "if x:\n    out[0] = 1": "where a number is wanted",
    "if x == x:\n    out[0] = 1": "where a number is wanted",
    "a, b = x[0], x[1], x[2]": "2 names on the left, 3 values",
    "a, b = x": "as many values on the right",
    "n + 1": "does nothing",
    "return n": "this function returns nothing",
    "out[0] = exp(n, n)": "exp does not take 2 arguments",
    "out[0] = min(n)": "min does not take 1 arguments",
    "out[0] = max(x)": "where a number is wanted",
    "out[0] = min(n, 2, key=abs)": "plain arguments",
    "out[0] = math.exp(n)": "called by its name",
    "out[0] = erf(n)": "erf is no function here",
    "a = i8(x[0])": "an address is a whole number",
}


@pytest.mark.filterwarnings("ignore::SyntaxWarning")
@pytest.mark.parametrize("body", REFUSED)
def test_what_would_not_do_the_same_is_refused_by_file_and_line(body):
    source = HEAD + "".join(f"    {line}\n" for line in body.splitlines())
    with pytest.raises(LoweringError) as refused:
        lower(source, "f", KINDS, file="here.py")
    place, text = str(refused.value).split(": ", 1)
    file, line = place.split(":")
    assert file == "here.py"
    assert source.splitlines()[int(line) - 1].strip() in text
    assert REFUSED[body] in text


def steps_by_two(x):
    """A function whose file and line the message names."""
    for k in range(0, 9, 2):
        x[k] = 0.0


def test_a_function_is_refused_at_its_own_place():
    line = steps_by_two.__code__.co_firstlineno + 2
    with pytest.raises(LoweringError, match=rf"test_lowering.py:{line}: for k in range\(0, 9, 2\):: range takes"):
        lower(steps_by_two, "f", ("F8",))


def squares(out, w):
    for k in range(0, 3):
        w[k] = out[k] * out[k]


def doubled(out, w):
    squares(out, w)
    for k in range(0, 3):
        w[k] = 2.0 * w[k]


def negated(out, w):
    squares(out, w)
    for k in range(0, 3):
        w[k] = -w[k]


def test_functions_lowered_together_share_one_module_that_is_compiled_once(monkeypatch, tmp_path):
    monkeypatch.setenv("FAIRLEAD_CACHE", str(tmp_path))
    make, compiled = native.object_code, []
    monkeypatch.setattr(native, "object_code", lambda source: compiled.append(source) or make(source))
    functions = {"doubled": doubled, "negated": negated}
    code = lower_together({name: (given, ("F8", "F8"), "None") for name, given in functions.items()}, [squares])
    for cached in (False, True):
        loaded = load_or_compile("together", lambda: Build({}, dict(code)))
        assert loaded.cached == cached
        x, out = np.array([1.0, -2.0, 3.0]), np.zeros(3)
        for name, factor in (("doubled", 2), ("negated", -1)):
            ctypes.CFUNCTYPE(None, *[ctypes.c_void_p] * 2)(loaded.address[name])(x.ctypes.data, out.ctypes.data)
            assert out.tolist() == [factor, 4 * factor, 9 * factor]
    assert len(compiled) == 1


@pytest.mark.parametrize("returned", ["if n > 0:\n        return 1", "return"])
def test_a_function_that_is_to_return_a_value_does_so_on_every_way(returned):
    with pytest.raises(LoweringError, match=r"may end without a value|returns a value"):
        lower(f"def f(n):\n    {returned}\n", "f", ("int",), "int")


@pytest.mark.parametrize("head", ["def f(n, whole=1):", "def f(*n):", "@cached\ndef f(n):"])
def test_only_plain_functions_are_taken(head):
    with pytest.raises(LoweringError, match="plain arguments"):
        lower(f"{head}\n    return\n", "f", ("int",))


def test_constants_of_sympy_are_numbers_in_kernels(both):
    """Once a law with SymPy's pi ended in a traceback."""
    import sympy

    from fairlead.kernels.text import _Printer

    text = _Printer().doprint(sympy.pi * sympy.Symbol("x") + sympy.E)
    assert both(f"out[0] = {text.replace('x', 'x[0]')}", x=(2.0,))[1][0] == [2 * math.pi + math.e]


def test_lowering_keeps_no_state_between_functions(both):
    """The same name may be whole in one function and a float in the next."""
    assert both("a = 1\nout[0] = a/2")[1] == ([0.5], [0])
    assert both("a = 1.5\nout[0] = a/2")[1] == ([0.75], [0])
