"""A library may be a folder, and a file may import its neighbours; what takes the place of what is told by name."""

import sys
import warnings

import pytest

import fairlead
from fairlead.analysis.cost.kept_runs import key_of
from fairlead.cases.identity import scene_digest
from fairlead.component.library_files import all_files
from fairlead.component.registry import known_types
from fairlead.errors import ModelError
from fairlead.studies.sweeps.parcel import _library

SPRING = '''
from fairlead.component import Component, Law, Output, Parameter, Translational
{imports}


class {name}(Component):
    """A spring."""

    a, b = Translational(), Translational()
    stiffness = Parameter("N/m", "Stiffness.", default=10.0)
    tension = Output("N")

    def law(p, a, b):
        pull = p.stiffness * {factor} * (b.x - a.x)
        return Law(a=-pull, b=+pull, tension=pull)
'''
SCENE = """schema: 1
name: pulled
components:
  wall: {type: Ground}
  hand: {type: MotionSource, position: 1 m}
  part: {type: Volute}
connections: [[wall.flange, part.a], [part.b, hand.flange]]
run: {stop: 0.1 s}
"""


@pytest.fixture
def write(tmp_path):
    """Writes files below a folder of the test and gives the path of the first of them."""

    def put(**files):
        for name, text in files.items():
            file = tmp_path / f"{name.replace('__in__', '/')}.py"
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text, encoding="utf-8")
        (tmp_path / "pulled.yaml").write_text(SCENE, encoding="utf-8")
        return str(tmp_path / f"{next(iter(files)).replace('__in__', '/')}.py")

    return put


def spring(name="Volute", factor="1.0", imports=""):
    return SPRING.format(name=name, factor=factor, imports=imports)


def force(tmp_path, *libraries):
    """What the spring pulls with when it is stretched by 1 m: 10 N/m times its factor."""
    model = fairlead.load(tmp_path / "pulled.yaml", libraries=libraries)
    return model.run(out=None)["part.tension"][-1]


def types(*libraries):
    return [name for name in known_types(libraries) if name not in known_types()]


def test_a_folder_is_all_its_files(write, tmp_path):
    write(parts__in__one=spring("Bow"), parts__in__two=spring(), parts__in__test_two="raise ValueError",
          parts__in___own="raise ValueError")  # fmt: skip
    assert types(str(tmp_path / "parts")) == ["Bow", "Volute"]
    assert force(tmp_path, tmp_path / "parts") == pytest.approx(10.0)


def test_a_package_is_what_its_init_imports(write, tmp_path):
    write(pack__in____init__="from .two import Volute", pack__in__two=spring(), pack__in__three=spring("Other"))
    assert types(str(tmp_path / "pack")) == ["Volute"]


def test_a_package_or_folder_that_offers_nothing_is_refused(write, tmp_path):
    write(pack__in____init__="", pack__in__two=spring())
    (tmp_path / "empty").mkdir()
    said = {"pack": "this package offers no component class\n    Import its classes in __init__.py",
            "empty": "there is no Python file in this folder", "none": "there is no such file"}  # fmt: skip
    for name, says in said.items():
        with pytest.raises(ModelError, match=says):
            known_types([str(tmp_path / name)])


def test_a_file_may_import_its_neighbours(write, tmp_path):
    path = write(
        parts=spring(imports="from shapes import FACTOR\nimport pack.more", factor="FACTOR * pack.more.TWO"),
        shapes="from deeper import FACTOR", deeper="FACTOR = 1.5",
        pack__in____init__="from .inner import ONE", pack__in__inner="ONE = 1", pack__in__more="TWO = 2.0",
    )  # fmt: skip
    before = set(sys.modules), list(sys.path), list(sys.meta_path)
    assert force(tmp_path, path) == pytest.approx(30.0)
    assert not {"shapes", "deeper", "pack", "pack.inner", "pack.more"} & (sys.modules.keys() - before[0])
    assert (sys.path, sys.meta_path) == before[1:]
    names = {file.relative_to(tmp_path).as_posix() for file in all_files(path).values()}
    assert names == {"parts.py", "shapes.py", "deeper.py", "pack/__init__.py", "pack/inner.py", "pack/more.py"}


def test_neighbours_of_one_name_in_two_folders_are_kept_apart(write, tmp_path, monkeypatch):
    user = type(sys)("shapes")  # of whoever runs it
    monkeypatch.setitem(sys.modules, "shapes", user)
    text = spring(imports="import shapes", factor="shapes.FACTOR")
    write(one__in__a=text, one__in__shapes="FACTOR = 2.0", two__in__a=text, two__in__shapes="FACTOR = 3.0")
    found = [force(tmp_path, tmp_path / folder / "a.py") for folder in ("one", "two", "one")]
    assert found == pytest.approx([20.0, 30.0, 20.0])
    assert sys.modules["shapes"] is user


def test_a_neighbour_does_not_hide_what_python_has(write, tmp_path):
    path = write(parts=spring(imports="import queue, random\nassert queue.Queue and random.Random"),
                 queue="", random="")  # fmt: skip
    assert types(path) == ["Volute"]
    assert len(all_files(path)) == 1


def keys(tmp_path, path):
    """What cases and kept runs are known by."""
    model = fairlead.load(tmp_path / "pulled.yaml", libraries=[path])
    return scene_digest(model, ()), key_of("", (), [path])


@pytest.mark.parametrize("how", ["beside", "on the path", "by a neighbour", "in a function"])
def test_an_edited_helper_counts_in_results_and_in_keys(write, tmp_path, monkeypatch, how):
    helper, imports, factor = "helper_of_mine", "import helper_of_mine as h", "h.FACTOR"
    if how == "on the path":
        monkeypatch.syspath_prepend(str(tmp_path / "else"))
        monkeypatch.delitem(sys.modules, "helper_of_mine", raising=False)
        helper = "else__in__helper_of_mine"
    files = {"parts": spring(imports=imports, factor=factor)}
    if how == "by a neighbour":
        files |= {"parts": spring(imports="import near", factor="near.h.FACTOR"), "near": imports}
    if how == "in a function":
        more = f"def read():\n    {imports}\n    return h.FACTOR\nTHREE = read()"
        files = {"parts": spring(imports=more, factor="THREE")}
    path = write(**files, **{helper: "FACTOR = 2.0"})
    first = keys(tmp_path, path)
    assert force(tmp_path, path) == pytest.approx(20.0)
    assert keys(tmp_path, path) == first
    write(**{helper: "FACTOR = 3.0"})
    assert not set(first) & set(keys(tmp_path, path))
    assert force(tmp_path, path) == pytest.approx(30.0)
    monkeypatch.delitem(sys.modules, "helper_of_mine", raising=False)


def test_a_job_for_another_machine_takes_neighbours_along(write):
    path = write(parts=spring(imports="import near"), near="", far="")
    name, files = _library(path)
    assert (name, sorted(files)) == ("parts.py", ["", "near.py"])


def told(*libraries):
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        known_types(libraries)
    return [str(one.message) for one in caught]


CURVE = '''
from fairlead.component import Parameter
from fairlead.components.friction.curve import Curve


class {name}(Curve):
    """Level."""

    def coefficient(p, v):
        return 0.3 + 0 * v
'''


def test_a_class_that_takes_the_place_of_another_is_told_by_name(write, tmp_path):
    path = write(mine=spring("Mass"), one=spring("Dup"), two=spring("Dup"), curve=CURVE.format(name="Coulomb"))
    one, two, curve = (str(tmp_path / f"{name}.py") for name in ("one", "two", "curve"))
    [said] = told(path)
    assert said.startswith(f"Mass: {path}:6 takes the place of the one of fairlead wherever a netlist says Mass.")
    assert told(one) == told(two) == told(one) == []
    assert told(one, two) == [
        f"Dup: {two}:6 takes the place of {one}:6 wherever a netlist says Dup. Give it a name of its own."
    ]
    [said] = told(curve)
    assert said.startswith(f"coulomb: {curve}:6 takes the place of the one of fairlead")
    assert told(one, one) == []


TWICE = {
    "a guard": ("    @guard('off', to='on', unit='m')\n    def meets(p, a): return a.x\n" * 2, "Mine: meets"),
    "a port": ("    a = Translational()\n    a = Rotational()\n", "Mine: a "),
    "one of several": ("    a, b = Translational(), Translational()\n    b = Rotational()\n", "Mine: b "),
    "a law": ("    def law(p): return ()\n    def law(p): return Law()\n", "Mine: law"),
    "a class": ("    x = 1\nclass Mine:\n    y = 1\n", ": Mine is defined"),
}


@pytest.mark.parametrize("name", TWICE)
def test_what_a_file_defines_twice_is_refused_at_its_line(write, name):
    body, says = TWICE[name]
    path = write(mine=f"from fairlead.component import *\nclass Mine(Component):\n{body}")
    with pytest.raises(ModelError, match=r"mine\.py:[4-6]: .* and in line [2-4]; one of them is lost") as caught:
        known_types([path])
    assert says in str(caught.value)


def test_what_goes_on_with_a_name_is_not_defined_twice(write):
    more = """
    total = 1
    total = total + 1
    names = sorted(("b", "a"))
    names = tuple(names)

    @property
    def width(self):
        return 1

    @width.setter
    def width(self, value):
        pass

try:
    class Spare: pass
except NameError:
    class Spare: pass
"""
    assert types(write(parts=spring() + more)) == ["Volute"]


def test_a_class_that_is_given_and_imported_too_is_one(write, tmp_path):
    path = write(one=spring("Bow"), two=spring("Volute", imports="from one import Bow"))
    assert told(path, str(tmp_path / "two.py")) == []
