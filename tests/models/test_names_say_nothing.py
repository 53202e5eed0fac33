"""What a contact is called decides nothing: kinds of contacts are class variants."""

import pytest

import fairlead
from fairlead.integrate import Run, integrate

NAMES = {"numbers": "012345", "letters": "abcdef", "words": ("left", "right", "7up", "in0", "out", "pad")}


def pads(names):
    """Blocks in a chain on pads, drawn to and fro by a spring; stiction above sliding friction."""
    lines, joins = ["floor: {type: Ground}"], [["floor.flange"]]
    for k, name in enumerate(names):
        load = f"normal_force: {8 + k} N, curve: {{stiction: {0.5 + 0.02 * k}, coulomb: 0.4}}"
        lines.append(f"block{k}: {{type: Mass, mass: 1 kg}}")
        lines.append(f"pad_{name}: {{type: Contact, {load}}}")
        lines.append(f"link{k}: {{type: SpringDamper, stiffness: {900 + 60 * k} N/m, damping: 2 N*s/m}}")
        joins[0].append(f"pad_{name}.a")
        joins.append([f"block{k}.flange", f"pad_{name}.b", f"link{k}.a"] + ([f"link{k - 1}.b"] if k else []))
    lines.append("hand: {type: MotionSource, position: {sine: {amplitude: 60 mm, frequency: 0.7 Hz}}}")
    joins.append([f"link{len(names) - 1}.b", "hand.flange"])
    wiring = "".join(f"\n  - [{', '.join(ports)}]" for ports in joins)
    parts = "\n  ".join(lines)
    return (
        f"schema: 1\nname: pads\ncomponents:\n  {parts}\nconnections:{wiring}\nfriction: {{method: hold}}\n"
        "run: {stop: 3 s, accuracy: 1e-4}\n"
    )


@pytest.mark.parametrize("engine", ["rodas", "stepping"])
def test_contacts_by_other_names_take_the_same_steps_bit_for_bit(tmp_path, engine):
    told = []
    for names in NAMES.values():
        path = tmp_path / "pads.yaml"
        path.write_text(pads(names), encoding="utf-8")
        outcome = integrate(fairlead.load(path).system, Run(stop=3.0, engine=engine))
        assert outcome.ok, outcome.sentence
        counts = {key: value for key, value in vars(outcome.counters).items() if isinstance(value, int)}
        assert counts["switches"] > 20
        told.append((outcome.times.tobytes(), outcome.values.tobytes(), outcome.events.tobytes(), counts))
    assert told[0] == told[1] == told[2]


def test_machines_of_one_class_variant_are_of_one_kind_and_others_are_not(tmp_path):
    path = tmp_path / "pads.yaml"
    exact = "curve: {stiction: 0.52, coulomb: 0.4}"
    path.write_text(pads("abc").replace(exact, "curve: 0.4, method: lugre"), encoding="utf-8")
    system = fairlead.load(path).system
    kind = dict(zip(system.machine_names, system.machine_kind.tolist(), strict=True))
    assert kind["pad_a"] == kind["pad_c"]
    assert len({kind["pad_a"], kind["pad_b"], kind["hand"]}) == 3
