"""A state that does not fit a run is refused with what differs, in this process and from another."""

import pickle

import pytest

import fairlead
from fairlead.errors import UsageError

SCENE = """
schema: 1
name: NAME
components:
  wall: {type: Ground}
  spring: {type: Spring, stiffness: 100 N/m}
  block: {type: Mass, mass: 1 kg, position: 10 mm}
connections: [[wall.flange, spring.a], [spring.b, block.flange]]
run: {stop: 1 s}
"""


@pytest.fixture
def load(tmp_path):
    def of(name="one", **values):
        file = tmp_path / f"{name}.yaml"
        file.write_text(SCENE.replace("NAME", name))
        return fairlead.load(file, set={key.replace("__", "."): value for key, value in values.items()})

    return of


@pytest.mark.parametrize("elsewhere", [False, True])
def test_a_state_of_another_model_is_refused_with_what_differs(load, elsewhere) -> None:
    saved = load("one", block__mass="2 kg").start().save()
    state = pickle.loads(pickle.dumps(saved)) if elsewhere else saved
    with pytest.raises(UsageError, match=r"saved with block\.mass = 2 kg; this run has block\.mass = 1 kg"):
        load("one").start().restore(state)
    with pytest.raises(UsageError, match=r"saved with the model one, .*; this run has the model two"):
        load("two").start().restore(state)
    with pytest.raises(UsageError, match=r"spring: Spring.*spring: SpringDamper"):
        load("one", block__mass="2 kg", spring__type="SpringDamper", spring__damping="1 N*s/m").start().restore(state)


def test_a_model_that_was_loaded_twice_is_told_to_be(load) -> None:
    with pytest.raises(UsageError, match="loaded apart from this one"):
        load().start().restore(load().start().save())
