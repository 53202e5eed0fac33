"""Laws become expressions and kernels; a law that cannot is refused with its author's file and line."""
# ruff: noqa: E501 - laws and messages read best on one line

import re
import textwrap

import numpy as np
import pytest
import sympy

import fairlead
from fairlead.component import Component
from fairlead.component.bundled import bundled
from fairlead.component.dependencies import dependencies
from fairlead.component.parameters import make
from fairlead.component.quantity import watched
from fairlead.component.registry import load_library
from fairlead.component.trace import trace
from fairlead.component.values import variant_of
from fairlead.describe.specimen import traced_specimen
from fairlead.errors import ModelError

NETLIST = """\
schema: 1
name: scene
components:
  wall: {type: Ground}
  block: {type: Mass, mass: 1 kg}
  part: {type: Mine}
connections:
  - [wall.flange, part.a]
  - [part.b, block.flange]
run: {stop: 1 s}
"""
HEAD = "from fairlead.component import *\nfrom fairlead.component import Component, Law\n"


def scene(tmp_path, body, head="", name="mine"):
    """A scene with a user's component whose class body is `body`; its lines count from 1 after HEAD."""
    ports = "    a, b = Translational(), Translational()\n"
    text = HEAD + head + "class Mine(Component):\n" + ports + textwrap.indent(textwrap.dedent(body), "    ")
    (tmp_path / f"{name}.py").write_text(text)
    (tmp_path / "scene.yaml").write_text(NETLIST)
    return tmp_path / "scene.yaml", [str(tmp_path / f"{name}.py")]


def refusal(tmp_path, body, head=""):
    """What `check` says, and the line of the user's file it names."""
    path, libraries = scene(tmp_path, body, head)
    with pytest.raises(ModelError) as caught:
        fairlead.load(path, libraries=libraries).check()
    found = re.search(r"mine\.py:(\d+)", str(caught.value))
    assert found, str(caught.value)
    return str(caught.value), (tmp_path / "mine.py").read_text().splitlines()[int(found[1]) - 1].strip()


@pytest.mark.parametrize(
    ("law", "line", "says"),
    [
        ("if a.x > b.x:\n        return 0, 0\n    return 1, -1", "if a.x > b.x:", "must not branch on values; write one law per zone"),
        ("return a.a, -a.a", "def law(p, a, b):", "must not read an acceleration or a reaction (a's acceleration)"),
        ("return a.force, -a.force", "def law(p, a, b):", "a law must not read an acceleration or a reaction (a's reaction)"),
        ("return abs(a.v), -abs(a.v)", "def law(p, a, b):", "Abs(port:a:v) is not smooth; give each branch a zone"),
        ("f = max(a.v, 0)\n    return f, -f", "f = max(a.v, 0)", "must not branch on values"),
        ("if a.x == 0.5:\n        return 0, 0\n    return 1, -1", "if a.x == 0.5:", "must not branch on values"),
        ("return (2 if a.v != 0 else 1), 0", "return (2 if a.v != 0 else 1), 0", "must not branch on values"),
        ("return (2 if a.v in (0, 1) else 1), 0", "return (2 if a.v in (0, 1) else 1), 0", "must not branch on values"),
        ("f = a.v or 4\n    return f, -f", "f = a.v or 4", "must not branch on values"),
        ("if not a.v:\n        return 0, 0\n    return a.v, 0", "if not a.v:", "must not branch on values"),
        ("match a.v:\n        case 0: return 0, 0\n    return 1, 0", "case 0: return 0, 0", "must not branch on values"),
        ("try:\n        f = 2 if a.v == 0 else 1\n    except Exception:\n        f = 9\n    return f, 0", "f = 2 if a.v == 0 else 1",
         "must not branch on values"),
        ("if 1 - a.v == 0:\n        return 0, 0\n    return 1, -1", "if 1 - a.v == 0:", "must not branch on values"),
        ("if b.x - a.x != 0:\n        return 0, 0\n    return 1, -1", "if b.x - a.x != 0:", "must not branch on values"),
        ("return (2 if b.x - a.x else 1), 0", "return (2 if b.x - a.x else 1), 0", "must not branch on values"),
        ("return (2 if not 2 * a.v else 1), 0", "return (2 if not 2 * a.v else 1), 0", "must not branch on values"),
        ("return (2 if 2 * a.v in (0, 1) else 1), 0", "return (2 if 2 * a.v in (0, 1) else 1), 0", "must not branch on values"),
        ("return (2 if 0 * a.v == b.x - a.x else 1), 0", "return (2 if 0 * a.v == b.x - a.x else 1), 0", "must not branch on values"),
        ("return (2 if (a.v < 0) & (b.v < 0) else 1), 0", "return (2 if (a.v < 0) & (b.v < 0) else 1), 0", "must not branch on values"),
        ("return (2 if (a.v < 0) == True else 1), 0", "return (2 if (a.v < 0) == True else 1), 0", "must not branch on values"),
        ("return {1: 1, 0: 0}.get(a.v, 0.5), 0", "return {1: 1, 0: 0}.get(a.v, 0.5), 0", "must not branch on values"),
        ("return len({0.0, 2 * a.v}), 0", "return len({0.0, 2 * a.v}), 0", "must not branch on values"),
        ("import collections\n    return len(collections.Counter([a.v, b.v])), 0", "return len(collections.Counter([a.v, b.v])), 0", "must not branch on values"),
        ("import numpy\n    return (2 if numpy.any([a.v - b.v]) else 1), 0", "return (2 if numpy.any([a.v - b.v]) else 1), 0", "must not branch on values"),
        ("match 2 * a.v:\n        case 0: return 0, 0\n    return 1, 0", "case 0: return 0, 0", "must not branch on values"),
        ("return Law(a=0, b=0, dissipated=(1 if a.v - b.v == 0 else 0))", "return Law(a=0, b=0, dissipated=(1 if a.v - b.v == 0 else 0))", "must not branch on values"),
        ("import numpy\n    return numpy.array([a.v]), 0", "def law(p, a, b):", "gives [port:a:v], an array; take one of its numbers, such as x[0]"),
        ("import numpy\n    return numpy.array(a.v), 0", "def law(p, a, b):", "gives port:a:v, an array; take one of its numbers, such as x.item()"),
        ("import numpy\n    return Law(a=0, b=0, stored=numpy.array([1.0, 2.0]))", "def law(p, a, b):", "gives [1. 2.], an array"),
        ("return 1j * a.v, 0", "def law(p, a, b):", "gives 1.0*I*port:a:v, which is not a real number"),
        ("import math\n    return math.sin(a.v), 0", "return math.sin(a.v), 0", "import sqrt, exp, sin, ... from fairlead.component"),
        ("import numpy\n    return numpy.sin(a.v), 0", "return numpy.sin(a.v), 0", "import sqrt, exp, sin, ... from fairlead"),
        ("import sympy\n    return sympy.gamma(a.v), 0", "def law(p, a, b):", "gamma(port:a:v) cannot be compiled"),
        ("import sympy\n    f = sympy.Max(a.v, 0)\n    return f, -f", "def law(p, a, b):", "is not smooth"),
        ("return a.w, 0", "return a.w, 0", "the port 'a' has x, v, a, force, and no 'w'"),
        ("return p.stifness, 0", "return p.stifness, 0", "Mine has no parameter 'stifness'"),
        ("return 1 / 0 * a.v, 0", "return 1 / 0 * a.v, 0", "ZeroDivisionError: division by zero"),
        ("return a.v / (a.v - a.v), 0", "def law(p, a, b):", "which is not finite"),
        ("return a.v", "def law(p, a, b):", "the law returns 1 flows for 2 ports ['a', 'b']"),
        ("return None, None", "def law(p, a, b):", "gives None, which is not a number"),
        ("return 'a.v', 0", "def law(p, a, b):", "gives 'a.v', which is not a number"),
        ("return Law(a=0, c=0)", "def law(p, a, b):", "gives ['c'] unasked and leaves out ['b']"),
        ("return Law(a=0, b=0, dissipated=a.a)", "def law(p, a, b):", "must not read an acceleration (a's acceleration)"),
    ],
)  # fmt: skip
def test_a_law_that_cannot_be_frozen_in_a_step_is_refused_at_its_line(tmp_path, law, line, says):
    said, named = refusal(tmp_path, f"def law(p, a, b):\n    {law}\n")
    assert says in said
    assert named == line
    assert "scene.yaml:6:3: part: " in said


@pytest.mark.parametrize("part", ["law", "guard", "stored", "shared"])
def test_whoever_branches_on_an_expression_is_refused(tmp_path, part):
    body = """
    zones = Zones("off", "on")

    @shared
    def sized(p, a):
        return {shared}

    @zone("off", "on")
    def rest(p, a, b, zone, sized):
        return Law(a={law}, b=0)

    def stored(p, a):
        return {stored}

    @guard("off", to="on", unit="m")
    def meets(p, a):
        return {guard}
    """
    odd = "(1 if 2 * a.x == 1 else 0) * a.x"
    said, named = refusal(tmp_path, body.format(**{"law": "0", "guard": "a.x", "stored": "0", "shared": "1", part: odd}))
    assert "must not branch on values" in said
    assert odd in named


GUARDED = """
kind = Choice(("plain", "other"), default="plain")
zones = Zones("off", "on", "far")
@zone("off", "on", "far")
def rest(p, a, b):
    return Law(a=0, b=0)
@guard("off", "far", to="on", unit="{unit}")
def meets(p, a, b, zone):
    {guard}
"""


@pytest.mark.parametrize(
    ("unit", "guard", "says"),
    [
        ("m", "if zone == 'far':\n        return a.x", "the guard 'meets' gives nothing in 'off'; does it lack a return?"),
        ("m", "return ()", "the guard 'meets' gives nothing in 'off'"),
        ("m", "import numpy\n    return numpy.array([a.x, b.x])", "gives [port:a:x port:b:x], an array"),
        ("m", "return [a.x, b.x]", "gives [port:a:x, port:b:x], which is not a number"),
        ("N", "return a.x - 1", "the guard meets is in N, and is given a.x - 1, which is in m; its unit is not that"),
        ("m", "return b.v - a.v", "the guard meets is in m, and is given -a.v + b.v, which is in m/s; its unit is not that"),
        ("N", "return a.x - b.x, a.v", "the guard meets is in N, and is given a.x - b.x, which is in m"),
    ],
)  # fmt: skip
def test_a_guard_gives_numbers_in_its_unit(tmp_path, unit, guard, says):
    body = GUARDED.format(unit=unit, guard=guard)
    said, _ = refusal(tmp_path, body if "if zone" not in guard else body.replace('kind = Choice(("plain", "other"), default="plain")', ""))
    assert says in said


@pytest.mark.parametrize(
    ("unit", "guard"),
    [
        ("m", "if p.kind == 'other':\n        return a.x"),  # a choice takes the guard with it
        ("1", "return a.x - 1"),
        ("m", "return a.x - b.x, a.v - 1"),  # the unit of one of them
        ("m", "return -0.5"),
    ],
)
def test_a_guard_may_go_with_a_choice_and_be_of_several_units(tmp_path, unit, guard):
    path, libraries = scene(tmp_path, GUARDED.format(unit=unit, guard=guard))
    fairlead.load(path, libraries=libraries).check()


def test_a_law_may_compare_words_and_constants(tmp_path):
    path, libraries = scene(tmp_path, """
    cap = Choice(("on", "off"), default="on")
    spare = Parameter("N", default=None)
    exempt = {"units": "nothing but numbers here"}
    def law(p, a, b, zone):
        nothing, three = 0 * a.x, {2: 3.0}[2]
        assert nothing == 0 and not nothing and zone == "always" and p.spare is None and p.spare == None
        assert 2 - 2 in (0, 1) and {nothing: 1}[0] == 1
        f = three * (b.x - a.x) if p.cap == "on" else 0
        return Law(a=-f, b=f)
    """)
    fairlead.load(path, libraries=libraries).check()
    traced = trace(variant_of(make(load_library(libraries[0]).Mine)))
    assert str(traced.zones["always"].flows["b"]) == "-3.0*port:a:x + 3.0*port:b:x"


def test_no_law_of_the_library_branches_on_an_expression():
    with watched():
        for kind in bundled().values():
            if issubclass(kind, Component) and kind.declaration.laws:
                traced_specimen(kind)


def test_sympy_is_left_as_it_was(tmp_path):
    before = {kind: dict(vars(kind)) for kind in (sympy.Basic, sympy.Expr, sympy.Integer, sympy.Float)}
    refusal(tmp_path, "def law(p, a, b):\n    return (2 if a.x - b.x == 0 else 1), 0\n")
    for kind, had in before.items():
        now = vars(kind)
        assert {name for name in had.keys() | now.keys() if had.get(name) is not now.get(name)} <= {"__slotnames__"}


def test_a_helper_that_fails_is_told_at_the_line_of_the_law_that_called_it(tmp_path):
    said, named = refusal(tmp_path, "def law(p, a, b):\n    return helper(a.v), 0\n", head="def helper(v):\n    return v if v > 0 else 0\n")
    assert "must not branch on values" in said
    assert named == "return v if v > 0 else 0"


def test_a_hold_that_is_not_a_slip_is_refused(tmp_path):
    said, _ = refusal(tmp_path, 'f = Unknown("N")\ndef law(p, a, b, f):\n    return Law(a=-f, b=f, f=hold(b.x - a.x))\n')
    assert "wants a sum of speeds of ports, such as b.v - a.v" in said


GEARED = """
f = Unknown("N")
throw = Parameter("1", default=0.2)
share = Table("m", "1", default=((0, 1), (1, 2)))
beat = Waveform("1", default=1.0)
ratio = Input("1", default=1.0)
own = State("1")
step = Discrete("1")

@sampled(every="throw")
def counted(p, step):
    return Law(step=step + 1)

def law(p, a, b, f, t, ratio, own, step):
    return Law(a=-f, b=f, own=1, f=hold(SLIP))
"""


@pytest.mark.parametrize(
    ("slip", "varies"),
    [
        ("b.v - p.throw*cos(a.x)*a.v", "the ratio of a's speed varies with the motion of 'a'"),
        ("b.v - ratio*a.v", "the ratio of a's speed varies with the signal 'ratio'"),
        ("own*b.v - a.v", "the ratio of b's speed varies with 'own'"),
        ("b.v - f*a.v", "the ratio of a's speed varies with 'f'"),
        ("b.v - (1 + t)*a.v", "the ratio of a's speed varies with time"),
        ("b.v - p.beat(t)*a.v", "the ratio of a's speed varies with the table 'beat', time"),
        ("b.v - p.share(b.x)*a.v", "varies with the table 'share', the motion of 'b'"),
        ("b.v - step*a.v", "the ratio of a's speed varies with the discrete 'step'"),
        ("b.v - a.v - sin(t)", "what is added to the speeds varies with time"),
        ("b.v - a.v + ratio", "what is added to the speeds varies with the signal 'ratio'"),
    ],
)  # fmt: skip
def test_a_hold_whose_ratio_moves_is_refused_at_its_law(tmp_path, slip, varies):
    """The row of a hold is ratio times acceleration: what the rate of a ratio would add to it is not in it."""
    said, named = refusal(tmp_path, GEARED.replace("SLIP", slip))
    assert varies in said
    assert "numbers and parameters" in said
    assert varies.startswith("what is added") or "as hold_position(gap), the relation of positions" in said
    assert named == "def law(p, a, b, f, t, ratio, own, step):"


@pytest.mark.parametrize("slip", ["b.v - p.throw*a.v", "(1 + p.throw)*b.v - cos(p.throw)*a.v + p.throw"])
def test_a_hold_whose_ratio_is_made_of_parameters_is_taken(tmp_path, slip):
    path, libraries = scene(tmp_path, GEARED.replace("SLIP", slip))
    fairlead.load(path, libraries=libraries).check()


@pytest.mark.parametrize(
    ("zero", "says"),
    [
        ("b.x - a.x", "what must be zero reads positions and not the unknown, so the index is 3, not 1"),
        ("(b.x / 0.1 + 1)*b.x - a.x", "so the index is 3"),
        ("b.v - 2*a.v", "what must be zero reads speeds and not the unknown, so the index is 2, not 1"),
    ],
)
def test_a_constraint_on_motions_is_refused_with_its_index(tmp_path, zero, says):
    law = f"return Law(a=-f, b=f, f={zero})"
    path, libraries = scene(tmp_path, f'f = Unknown("N")\ndef law(p, a, b, f):\n    {law}\n')
    with pytest.raises(ModelError) as caught:
        fairlead.load(path, libraries=libraries).check()
    assert says in str(caught.value)
    assert "Write hold(slip) for a sum of speeds" in str(caught.value)


def test_every_refused_class_of_a_netlist_is_told_at_once(tmp_path):
    path, libraries = scene(tmp_path, "def law(p, a, b):\n    return abs(a.v), 0\n")
    other = "\n\nclass Yours(Mine):\n    def law(p, a, b):\n        return a.a, 0\n"
    (tmp_path / "mine.py").write_text((tmp_path / "mine.py").read_text() + other)
    path.write_text(NETLIST.replace("connections:", "  also: {type: Yours}\nconnections:").replace("part.b, block", "part.b, also.a, also.b, block"))
    with pytest.raises(ModelError) as caught:
        fairlead.load(path, libraries=libraries).check()
    assert "part: " in str(caught.value)
    assert "also: " in str(caught.value)


def test_an_output_with_a_corner_can_be_recorded_and_not_fed_to_a_law(tmp_path):
    body = """
    speed = Output("1", "Without its sign.")
    most = Output("m/s", "The larger speed.")
    way = Output("1", "Its sign.")
    pull = Input("N", default=0.0)

    def law(p, a, b, pull):
        import sympy

        return Law(a=-pull, b=pull, speed=abs(a.v - b.v), most=sympy.Max(a.v, b.v), way=sympy.sign(a.v), dissipated=pull * (b.v - a.v))
    """
    path, libraries = scene(tmp_path, body)
    assert fairlead.load(path, libraries=libraries).check() == []
    path.write_text(NETLIST.replace("  - [wall", "  - [part.speed, part.pull]\n  - [wall"))
    with pytest.raises(ModelError, match=r"part.speed cannot feed part.pull: it has a corner where its derivative jumps"):
        fairlead.load(path, libraries=libraries).check()


def test_an_acceleration_can_be_recorded_and_not_fed_to_a_law(tmp_path):
    body = 'pull = Input("1", default=0.0)\ndef law(p, a, b, pull):\n    return Law(a=-pull, b=pull, supplied=pull * (a.v - b.v))\n'
    path, libraries = scene(tmp_path, body)
    sensed = NETLIST.replace("connections:", "  eye: {type: MotionSensor}\nconnections:\n  - [eye.flange, block.flange]\n  - [eye.a, part.pull]")
    path.write_text(sensed)
    with pytest.raises(ModelError, match=r"eye.a cannot feed part.pull: it reads an acceleration, which is known only after"):
        fairlead.load(path, libraries=libraries).check()
    path.write_text(sensed.replace("eye.a,", "eye.v,"))
    assert fairlead.load(path, libraries=libraries).check() == []


@pytest.mark.slow
def test_functions_and_powers_say_in_machine_code_what_they_say_in_python(tmp_path):
    from fairlead.component.registry import load_library
    from fairlead.testing import contract

    body = """
    exempt = {"units": "functions are asked for their values"}
    def law(p, a, b):
        v = b.v - a.v
        s = 2 + tanh(v)
        force = sin(v) ** 3 + cos(v) * v + atan(v) - exp(-v * v) * v + log(s) * v + sqrt(s) * v + s**-0.5 * v + v * s**9 + v / s**2
        return Law(a=-force, b=force, supplied=-force * v)
    """
    _, (library,) = scene(tmp_path, body, name="functions")
    contract(load_library(library).Mine)


@pytest.mark.slow
def test_a_member_that_joins_a_family_later_does_not_change_what_the_others_depend_on(scene, library):
    """Its kernel would be compiled again under another name, in every process with another library."""
    belt = fairlead.load("belt")
    before = [dependencies(instance.variant) for instance in belt.flat.instances]
    relative = library("""
        from fairlead.components.friction.hold import Hold

        class HeldOtherwise(Hold):
            '''Exact hold by another word.'''
            word = "held_otherwise"
    """)
    fairlead.load("belt", set={"pad.method": "held_otherwise"}, libraries=[relative]).check()
    assert [dependencies(instance.variant) for instance in belt.flat.instances] == before


def test_a_new_netlist_of_known_classes_compiles_nothing(tmp_path, monkeypatch):
    from fairlead.kernels import kernel as kernels

    fairlead.load("belt").check()
    monkeypatch.setattr(kernels, "_build", lambda variant, *_: pytest.fail(f"{variant.label} was compiled again"))
    kernels.kernel.cache_clear()
    assert fairlead.load("belt", set={"pad.normal_force": "12 N", "spring.stiffness": "80 N/m"}).check() == []


def test_a_class_is_traced_once_for_its_machine_code_and_its_python_function():
    """Tracing is most of the time that a kernel takes."""
    from fairlead.component.registry import known_types
    from fairlead.kernels import kernel
    from fairlead.testing.samples import sample

    damper = sample(known_types()["Damper"], np.random.default_rng(1), {}, True)
    kernel.write_source.cache_clear()
    kernel.plain.__wrapped__(variant_of(damper))
    kernel._build(variant_of(damper))
    assert kernel.write_source.cache_info().misses == 1
