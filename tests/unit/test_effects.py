"""Effects: switched for a component or for the scene; what is off is absent from the compiled system."""

import pytest

from fairlead.component.class_checks import DeclarationError
from fairlead.errors import ModelError

PARTS = '''
    class Rigid(Component):
        """Holds its end where it is."""
        a = Translational()
        force = Unknown("N")
        pull = Output("N")
        def law(p, a, force):
            return Law(a=-force, force=hold(a.v), pull=force)

    class Pad(Component):
        """A stop with a gap; without elasticity it is rigid, without damping a term is missing."""
        a = Translational()
        stiffness = Parameter("N/m", above=0)
        rate = Parameter("N*s/m", default=3.0, least=0)
        pull = Output("N")
        elasticity = Effect("Gives way under load.", off=Rigid)
        damping = Effect("Loses energy.", default="off")
        zones = Zones("apart", "pressed")

        @zone("apart", "pressed")
        def both(p, a, zone):
            loss = p.rate * a.v if p.damping == "on" else 0
            force = p.stiffness * a.x + loss if zone == "pressed" else 0
            return Law(a=force, pull=-force)

        @guard("apart", to="pressed", unit="m")
        def meets(p, a):
            return a.x

        @guard("pressed", to="apart", unit="m")
        def parts(p, a):
            return -a.x

    class Buffer(Composite):
        """Two pads, the second only with `spare`."""
        a = Translational()
        stiffness = Parameter("N/m", above=0)
        spare = Effect("A second pad.")
        elasticity = Effect("Of the first pad.")

        def expand(p, scene):
            pads = {"first": scene.make(Pad, stiffness=p.stiffness, elasticity=p.elasticity)}
            if p.spare == "on":
                pads["second"] = scene.make(Pad, stiffness=p.stiffness)
            joins = [("first.a", "second.a")] if p.spare == "on" else []
            return Expansion(pads, joins, {"a": "first.a"})
'''

PAD = """
    components:
      mass: {type: Mass, mass: 1 kg, position: 1 mm}
      pad: {type: Pad, stiffness: 10 kN/m}
    connections: [[mass.flange, pad.a]]
    run: {stop: 1 s}
"""
BUFFER = PAD.replace("Pad,", "Buffer,")


@pytest.fixture
def parts(library):
    return (library(PARTS),)


def kernels(model):
    return {block.kernel.variant.label for block in model.system.blocks}


def test_a_term_that_is_off_is_not_in_the_law(scene, parts):
    without = scene(PAD, parts)
    (pad,) = [block.kernel.structure for block in without.system.blocks if "Pad" in block.kernel.variant.label]
    assert pad.parameters == ["stiffness"]
    assert not any(key.endswith(":v") for key in pad.inputs)
    lossy = scene(PAD, parts, **{"pad.effects.damping": "on"})
    (pad,) = [block.kernel.structure for block in lossy.system.blocks if "Pad" in block.kernel.variant.label]
    assert pad.parameters == ["rate", "stiffness"]
    assert "port:a:v" in pad.inputs


def test_a_limiting_model_takes_the_place_of_what_has_more_unknowns_and_zones(scene, parts):
    on, off = scene(PAD, parts), scene(PAD, parts, **{"pad.effects.elasticity": "off"})
    assert len(on.system.zones) == 1
    assert len(off.system.zones) == 0
    assert kernels(off) == {"Mass", "Rigid"}
    assert "pad.force" in off.system.unknown_names
    assert "pad.force" not in on.system.unknown_names
    assert "pad.pull" in [signal.name for signal in off.system.signals]
    assert off.assembly.effects == {"pad": {"elasticity": "off", "damping": "off"}}


def test_a_child_that_is_off_is_not_made(scene, parts):
    assert {path for path in scene(BUFFER, parts).assembly.instances if path.startswith("pad")} == {
        "pad.first", "pad.second"
    }  # fmt: skip
    off = scene(BUFFER, parts, **{"pad.effects.spare": "off"})
    assert {path for path in off.assembly.instances if path.startswith("pad")} == {"pad.first"}


def test_the_scene_switches_all_that_know_the_effect_and_a_component_has_the_last_word(scene, parts):
    def types(**settings):
        made = scene(BUFFER, parts, **{name.replace("_", "."): word for name, word in settings.items()}).assembly
        pads = {path: one.type.__name__ for path, one in made.instances.items() if path != "mass"}
        return pads, made.effects

    assert types(effects_elasticity="off")[0] == {"pad.first": "Rigid", "pad.second": "Rigid"}
    found, effects = types(effects_elasticity="off", pad_effects_elasticity="on")
    assert found == {"pad.first": "Pad", "pad.second": "Rigid"}  # the second is a child that the pad says nothing of
    assert effects["pad"] == {"spare": "on", "elasticity": "on"}
    assert effects["pad.second"] == {"elasticity": "off", "damping": "off"}


def test_true_and_false_are_words_too(scene, parts):
    assert scene(PAD, parts, **{"pad.effects.elasticity": "false"}).assembly.effects["pad"]["elasticity"] == "off"
    assert scene(PAD, parts, **{"effects.elasticity": "false"}).assembly.effects["pad"]["elasticity"] == "off"


def test_a_new_number_compiles_nothing(scene, parts):
    """The word decides, not the value: a coefficient of zero has the kernel of any other."""
    variants = {
        rate: next(
            block.kernel.variant
            for block in scene(PAD, parts, **{"pad.effects.damping": "on", "pad.rate": rate}).system.blocks
            if "Pad" in block.kernel.variant.label
        )
        for rate in (0, 5)
    }
    assert variants[0] == variants[5]


@pytest.mark.parametrize(
    ("settings", "told"),
    [
        ({"pad.effects.elastcity": "off"}, r"pad\.effects\.elastcity: .* Did you mean elasticity\?"),
        ({"pad.effects.elasticity": "perhaps"}, r"pad\.effects\.elasticity = perhaps is not known.*\n.*on, off"),
        ({"effects.elastcity": "off"}, r"effects\.elastcity: nothing in this scene .* Did you mean elasticity\?"),
        ({"effects.elasticity": "perhaps"}, r"effects\.elasticity = perhaps is not a switch"),
        ({"pad.elasticity": "off"}, r"pad\.elasticity: Pad has no parameter elasticity"),
        ({"pad.effects": "off"}, r"pad\.effects = off is not a map"),
    ],
)
def test_a_wrong_switch_is_told(scene, parts, settings, told):
    with pytest.raises(ModelError, match=told) as caught:
        scene(PAD, parts, **settings).check()
    assert len(caught.value.faults) == 1


@pytest.mark.slow
def test_the_schema_and_the_description_know_the_effects(parts):
    from fairlead.simulate import describe_type, json_schema

    schema = json_schema(parts)
    assert set(schema["definitions"]["Pad"]["properties"]["effects"]["properties"]) == {"elasticity", "damping"}
    assert {"energy", "elasticity", "damping", "spare"} <= set(schema["properties"]["effects"]["properties"])
    said = describe_type("Pad", parts)
    assert "elasticity" in said
    assert "Gives way under load." in said


def test_a_limiting_model_must_fit(library):
    from fairlead.component.registry import load_library

    for change, told in (
        (("pull = Output", "push = Output"), "whose outputs differ: ['pull', 'push']"),
        (("force = Unknown", 'size = Parameter("m")\n        force = Unknown'), "which wants ['size'] besides"),
    ):
        text = PARTS.replace(*change, 1).replace("pull=force", "push=force" if "push" in change[1] else "pull=force")
        with pytest.raises((ModelError, DeclarationError)) as caught:
            load_library(library(text))
        assert told in str(caught.value)


def test_the_contract_suite_asks_with_and_without_each_effect(parts):
    from fairlead.component.registry import load_library
    from fairlead.testing import checks

    asked = {str(check).rpartition(" ")[0] for check in checks(load_library(parts[0]).Pad)}
    assert asked == {"Pad", "Pad[elasticity off]", "Pad[damping on]"}


def test_a_boolean_of_yaml_switches_as_the_word_does(scene, parts):
    """Also the ledger, which the framework keeps; a number is no switch."""
    for word, closed in (("off", False), ("false", False), ("on", True), ("true", True)):
        names = scene(f"{PAD}    effects: {{energy: {word}}}\n", parts).system.unknown_names
        assert ("energy.dissipated" in names) == closed
    for name in ("energy", "damping"):
        with pytest.raises(ModelError, match=f"effects.{name} = 0 is not a switch"):
            scene(f"{PAD}    effects: {{{name}: 0}}\n", parts).check()
