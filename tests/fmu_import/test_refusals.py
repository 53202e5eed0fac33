"""What cannot be an FMU, and what a netlist says wrongly of one, is told at its place with a way out; nothing runs."""

import re
import zipfile

import pytest

from fairlead.errors import ModelError
from tests.fmu_import.build import DECAY, description, packed

SPEED = {"name": "speed", "ref": 0, "causality": "input", "start": 0, "unit": "km/h"}
ODD = {"name": "odd", "ref": 5, "causality": "output", "unit": "qqq/s2"}
WORDS = {"name": "said", "ref": 0, "causality": "output", "kind": "String"}
WHOLE = {"name": "whole", "ref": 3, "causality": "parameter", "variability": "fixed", "kind": "Int8", "start": 0}


@pytest.mark.parametrize(
    ("given", "place", "told"),
    [
        ("file: gone.fmu", 6, r"fmu\.file: there is no file gone\.fmu in the folder of the netlist"),
        ("file: decai3.fmu", 6, r"there is no file decai3\.fmu.* Did you mean decay3\.fmu\?"),
        ("file: ../decay3.fmu", 6, r"lies outside the folder of the netlist"),
        ("file: /decay3.fmu", 6, r"lies outside the folder"),
        ("file: 3", 6, r"there is no file 3"),
        ("{}", 4, r"fmu\.file is missing; Fmu needs it"),
        ("file: plain.fmu", 6, r"plain\.fmu is no FMU: .*zip"),
        ("file: empty.fmu", 6, r"is no FMU: it holds no modelDescription\.xml"),
        ("file: torn.fmu", 6, r"modelDescription\.xml that cannot be read"),
        ("file: bomb.fmu", 6, r"defines entities\.\n +No FMU needs them"),
        ("file: old.fmu", 6, r"is of FMI version 1\.0\.\n +Export it for FMI 2\.0, 3\.0"),
        ("file: exchange.fmu", 6, r"is for model exchange only\.\n +Export it for co-simulation"),
        ("file: elsewhere.fmu", 6, r"has no code for this machine \(.*\); it has sparc-solaris\.\n +Export it for"),
        ("file: decay3.fmu", 4, r"fmu: period is missing; decay3\.fmu names no step of its own\.\n +Give the comm"),
        ("file: fixed3.fmu\n    period: 15 ms", 7, r"steps by 0\.01 s, and period = 0\.015 s is no multiple"),
        ("file: decay3.fmu\n    period: 0 s", 7, r"out of range"),
        ("file: decay3.fmu\n    step: 1 s", 7, r"Fmu has no parameter step.*\n.*period"),
        ("file: decay3.fmu\n    period: 1 s\n    outputs: {x: y}", 8, r"fmu\.outputs\.x: the FMU has no variable y"),
        ("file: decay3.fmu\n    period: 1 s\n    outputs: {y: X}", 8,
         r"no variable X\.\n +Did you mean x\? Its outputs are x\."),
        ("file: decay3.fmu\n    period: 1 s\n    inputs: {x: x}", 8, r"x is output and cannot be one of its inputs"),
        ("file: decay3.fmu\n    period: 1 s\n    outputs: [x]", 8, r"write a map"),
        ("file: decay3.fmu\n    period: 1 s\n    outputs: {x: 3}", 8, r"3 names no variable"),
        ("file: decay3.fmu\n    period: 1 s\n    outputs: {t: x}", 8, r"no signal can be called t"),
        ("file: decay3.fmu\n    period: 1 s\n    outputs: {x: {of: x, unit: N}}", 8,
         r"the FMU has x in mm, which is no unit of N\.\n +Leave out the unit, or give mm"),
        ("file: decay3.fmu\n    period: 1 s\n    outputs: {x: {of: x, unit: m}}", 8,
         r"the FMU has x in mm, not in m\.\n.*turns mm into m by itself"),
        ("file: decay3.fmu\n    period: 1 s\n    outputs: {x: {of: x, unit: nix}}", 8, r"nix is not a known unit"),
        ("file: decay3.fmu\n    period: 1 s\n    parameters: {rat: 3}", 8, r"no variable rat\.\n +Did you mean rate\?"),
        ("file: decay3.fmu\n    period: 1 s\n    parameters: {rate: 3 N}", 8, r"3 N is a force, not a frequency"),
        ("file: decay3.fmu\n    period: 1 s\n    parameters: {rate: true}", 8,
         r"true is no number\.\n +rate is Float64 in the FMU: a number in 1/s"),
        ("file: decay3.fmu\n    period: 1 s\n    parameters: {x: 1}", 8, r"x is output and cannot be one of its par"),
        ("file: odd3.fmu\n    period: 1 s", 4, r"odd is in qqq/s2, a unit that fairlead does not know"),
        ("file: odd3.fmu\n    period: 1 s\n    outputs: {said: said}", 8, r"said is String, and a signal is one num"),
        ("file: odd3.fmu\n    period: 1 s\n    outputs: {}\n    parameters: {whole: 200}", 9,
         r"whole = 200 is out of range\.\n.*from -128 to 127"),
        ("file: odd3.fmu\n    period: 1 s\n    outputs: {}\n    parameters: {whole: 1.5}", 9, r"is no whole number"),
    ],
)  # fmt: skip
def test_a_mistake_is_told_at_its_place(fmus, load, given, place, told):
    body = "" if given == "{}" else f"    {given}\n"
    with pytest.raises(ModelError) as refused:
        load(f"components:\n  fmu:\n    type: Fmu\n{body}run: {{stop: 1 s}}\n").check()
    found = "\n".join(map(str, refused.value.faults))
    assert re.search(told, found), found
    assert len(refused.value.faults) == 1, found
    where = refused.value.faults[0].where
    assert where is not None
    assert where.line == place, found


@pytest.fixture(scope="module")
def fmus(make, folder):
    """The FMUs that are spoken of, most of them damaged."""
    library = make("decay", 3).with_name("own3.so")
    if not library.exists():
        library = next(folder.glob("own3.*"))
    make("fixed", 3, more='fixedInternalStepSize="0.01"')
    make("odd", 3, [SPEED, ODD, WORDS, WHOLE])
    good = description("decay", 3, DECAY)
    texts = {"torn": good[:200], "old": good.replace('fmiVersion="3.0"', 'fmiVersion="1.0"'),
             "exchange": description("decay", 3, DECAY, of="ModelExchange"),
             "bomb": good.replace("<fmiModel", '<!DOCTYPE a [<!ENTITY b "b">]>\n<fmiModel', 1)}  # fmt: skip
    for name, text in texts.items():
        packed(folder / f"{name}.fmu", 3, text, library)
    packed(folder / "elsewhere.fmu", 3, good, library, "sparc-solaris")
    (folder / "plain.fmu").write_text("no archive")
    with zipfile.ZipFile(folder / "empty.fmu", "w") as archive:
        archive.writestr("readme.txt", "nothing")


def test_an_input_is_joined_with_what_has_its_dimension_and_scaled(fmus, load):
    scene = """
        components:
          fmu: {type: Fmu, file: odd3.fmu, period: 1 s, outputs: {}}
          body: {type: Mass, mass: 1 kg}
          seen: {type: MotionSensor}
        connections: [[body.flange, seen.flange], [seen.%s, fmu.speed]]
        run: {stop: 1 s}
    """
    assert load(scene % "v").check() == []
    with pytest.raises(ModelError, match=r"seen\.x is in m, fmu\.speed wants m/s"):
        load(scene % "x").check()


def test_without_the_package_the_cure_is_told(fmus, load, monkeypatch):
    import sys

    from fairlead.foreign import description as described

    described._read.cache_clear()
    monkeypatch.setitem(sys.modules, "fmpy", None)
    with pytest.raises(ModelError, match=r"decay3\.fmu cannot be read without a package.*\n.*fairlead\[fmu\]"):
        load("components: {fmu: {type: Fmu, file: decay3.fmu, period: 1 s}}\nrun: {stop: 1 s}").check()
    described._read.cache_clear()
