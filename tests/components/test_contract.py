"""Every registered component keeps the contract, and a wrong law is told in a sentence which property it breaks."""

import pytest

from fairlead.component import (
    Component,
    Input,
    Law,
    Output,
    Parameter,
    State,
    Translational,
    Unknown,
    Zones,
    guard,
    hold,
    tanh,
    zone,
)  # fmt: skip
from fairlead.component.registry import known_types
from fairlead.testing import ContractError, checks, contract, properties
from fairlead.testing.properties import PROPERTIES
from tests.slow import is_left

EVERY_CURVE, ENOUGH = ("binding", "hold", "tanh"), ("stribeck", "table")
"""Each pair of method and curve is a kernel of its own to compile; methods beyond these differ from them in how they
stick, not in how they read a curve, so two curves each must do."""


FACTORS = {"load_dependence", "temperature_dependence"}


def asked(check):
    """Whether a check is made here; `contract(kind)` makes them all."""
    curve = check.chosen.get("curve")
    if check.chosen.get("bonds"):  # asked with few bonds as it is
        return False
    if set(check.chosen) & FACTORS:  # on the normal force, the same for all
        return getattr(check.kind, "word", "hold") == "hold"
    return curve is None or getattr(check.kind, "word", "") in EVERY_CURVE or curve in ENOUGH


OF_MACHINE_CODE = ("derivatives", "machine_code", "instances")
"""Properties that need the kernel compiled: what they show of the lowering, they show of one form of each class, and
one of them, in turn, does so in `make test`."""
COMPILED = {"hold", "tanh", "lugre"}
"""Methods of friction whose kernel is compiled for that: one that holds, one that is smooth, one with a state."""
FIRST = {}
"""The words of the first form of each class that has no method of friction; most have none."""


def is_method(check):
    """Whether a class is a method of friction."""
    return hasattr(check.kind, "word") or "curve" in check.chosen


def looked_into(check):
    """Whether a quick test looks at machine code of a class; kernels of other methods are run by other quick tests."""
    return not is_method(check) or getattr(check.kind, "word", "") in COMPILED


def in_turn(check):
    """Whether a property is the one of OF_MACHINE_CODE that a quick test asks of a class."""
    return check.name == OF_MACHINE_CODE[KINDS.index(check.kind) % len(OF_MACHINE_CODE)]


def quick(check):
    """One curve for every method of friction, in its plainest form; machine code of some of them, and of other classes.

    What else these and the others ask of a law, its balance, energy, zones, units and derivatives, needs no compiler
    or goes the same way from text to code.
    """
    compiled = check.name in OF_MACHINE_CODE
    if is_method(check):
        return check.chosen == {"curve": "stribeck"} and (not compiled or (looked_into(check) and in_turn(check)))
    return not compiled or (check.chosen == FIRST.setdefault(check.kind, check.chosen) and in_turn(check))


KINDS = list({check.kind: None for kind in known_types().values() for check in checks(kind)})
ALL = [
    pytest.param(check, marks=[] if quick(check) else pytest.mark.slow, id=str(check))
    for kind in known_types().values()
    for check in checks(kind)
    if asked(check)
]


FEWER = {"INSTANCES": 2, "INSTANTS": 6}
"""Random instances and instants in `make test`; `make test-all` asks as many as `contract(kind)` does."""
SEARCHING = {"zones_reached", "settles"}  # look for motions until they have them


@pytest.mark.parametrize("check", ALL)
def test_registered_component_keeps(check, monkeypatch):
    if quick(check) and check.name not in SEARCHING:
        for name, fewer in FEWER.items():
            monkeypatch.setattr(properties, name, fewer)
    check()


@pytest.mark.slow
@pytest.mark.parametrize("kind", known_types().values())
def test_every_class_keeps_all_that_is_asked_of_it(kind):
    for check in checks(kind):
        if asked(check) and quick(check) and check.name not in SEARCHING:
            check()


def test_of_every_class_but_some_methods_of_friction_a_quick_test_looks_at_machine_code():
    file = "tests/components/test_contract.py::test_registered_component_keeps"
    soon = [one.values[0] for one in ALL if not one.marks and not is_left(f"{file}[{one.id}]")]
    looked = [check for check in soon if check.name in OF_MACHINE_CODE]
    assert {check.kind for check in looked} == {one.values[0].kind for one in ALL if looked_into(one.values[0])}
    assert {check.name for check in looked} == set(OF_MACHINE_CODE)


def test_every_member_of_the_contact_family_is_asked_with_every_curve():
    contact = known_types()["Contact"]
    asked = {(check.kind.word, check.chosen.get("curve")) for check in checks(contact)}
    curves = {"coulomb", "viscous", "stribeck", "tustin", "hump", "table"}
    assert {(method, curve) for method in ("binding", "hold", "tanh") for curve in curves} <= asked


class TwoEnded(Component):
    """What the wrong components below have in common."""

    a, b = Translational(), Translational()
    stiffness = Parameter("N/m", above=0)
    damping = Parameter("N*s/m", default=1.0, above=0)

    def law(p, a, b):
        tension = p.stiffness * (b.x - a.x)
        return Law(a=-tension, b=+tension, stored=tension * (b.x - a.x) / 2)


def broken(kind):
    """The properties that a class breaks, and the whole message."""
    with pytest.raises(ContractError) as caught:
        contract(kind)
    lines = str(caught.value).splitlines()
    return {line.split(":")[0] for line in lines}, str(caught.value)


def test_a_right_component_of_a_user_passes():
    contract(TwoEnded)


def test_flows_that_do_not_sum_to_zero_are_told():
    class Leaky(TwoEnded):
        def law(p, a, b):
            tension = p.stiffness * (b.x - a.x)
            return Law(a=-tension, b=+0.9 * tension)

    names, text = broken(Leaky)
    assert "balance" in names
    assert "what the two ports of a massless component take in must sum to zero; a takes in" in text


def test_negative_dissipation_is_told():
    class Engine(TwoEnded):
        def law(p, a, b):
            force = -p.damping * (b.v - a.v)
            return Law(a=-force, b=+force, dissipated=force * (b.v - a.v))

    names, text = broken(Engine)
    assert names == {"dissipates"}
    assert "W; a component cannot dissipate less than nothing" in text


def test_energy_that_is_not_accounted_for_is_told():
    class Silent(TwoEnded):
        def law(p, a, b):
            tension = p.stiffness * (b.x - a.x)
            return Law(a=-tension, b=+tension)

    names, text = broken(Silent)
    assert names == {"energy"}
    assert "energy is not accounted for: it takes in" in text
    assert "stores 0 W" in text


@pytest.mark.slow
def test_zones_that_run_in_a_circle_are_told():
    class Restless(TwoEnded):
        zones = Zones("slack", "taut")

        @zone("slack")
        def slack(p, a, b):
            return 0, 0

        @zone("taut")
        def taut(p, a, b):
            return Law(
                a=-p.stiffness * (b.x - a.x), b=p.stiffness * (b.x - a.x), stored=p.stiffness * (b.x - a.x) ** 2 / 2
            )

        @guard("slack", to="taut", unit="m")
        def tightens(p, a, b):
            return b.x - a.x

        @guard("taut", to="slack", unit="m")
        def slackens(p, a, b):
            return b.x - a.x

    names, text = broken(Restless)
    assert "settles" in names
    assert "its zones do not settle, they run in a circle: slack -> taut -> " in text


def test_a_zone_that_nothing_leads_to_is_told():
    class Forgotten(TwoEnded):
        zones = Zones("on", "off")

        @zone("on", "off")
        def both(p, a, b):
            return 0, 0

        @guard("off", to="on", unit="m/s")
        def starts(p, a, b):
            return 1.0

    names, text = broken(Forgotten)
    assert names == {"zones_reached"}
    assert "no motion was found that leads to zone off and stays there" in text


def test_an_output_that_no_law_gives_is_told():
    class Mute(TwoEnded):
        tension = Output("N", "Never given.")

    _, text = broken(Mute)
    assert "no law gives the output 'tension'. Add it: Law(..., tension=...)" in text


def test_friction_that_is_not_odd_is_told():
    class Lopsided(TwoEnded):
        slip = Output("m/s", "Slip.")

        def law(p, a, b):
            slip = b.v - a.v
            force = p.damping * (slip + 0.7 * tanh(slip / 0.9) ** 2)
            return Law(a=-force, b=+force, slip=slip, dissipated=force * slip)

    assert "odd" in broken(Lopsided)[0]
    assert "friction is odd in slip" in broken(Lopsided)[1]


def test_an_unknown_that_its_law_does_not_determine_is_told():
    class Vague(TwoEnded):
        force = Unknown("N")

        def law(p, a, b, force):
            return Law(a=-force, b=+force, force=p.stiffness * (b.x - a.x))

    assert "the law does not determine its unknown force" in broken(Vague)[1]


def test_an_unknown_that_holds_and_a_state_pass():
    class Joint(Component):
        a, b = Translational(), Translational()
        force = Unknown("N")

        def law(p, a, b, force):
            return Law(a=-force, b=+force, force=hold(b.v - a.v))

    class Bristle(TwoEnded):
        z = State("m", "Deflection.")

        def law(p, a, b, z):
            elastic = p.stiffness * z
            rate = b.v - a.v - elastic / p.damping
            return Law(a=-elastic, b=elastic, z=rate, stored=elastic * z / 2, dissipated=elastic**2 / p.damping)

    contract(Joint)
    contract(Bristle)


def test_a_law_that_reads_a_signal_is_asked_with_numbers_for_it():
    class Brake(TwoEnded):
        grip = Input("N")

        def law(p, a, b, grip):
            force = grip * tanh((b.v - a.v) / 0.1)
            return Law(a=-force, b=force, dissipated=force * (b.v - a.v))

    contract(Brake)


def test_a_declared_exception_is_respected_and_a_misspelt_one_told():
    class Engine(TwoEnded):
        exempt = {"dissipates": "It is a motor."}

        def law(p, a, b):
            force = -p.damping * (b.v - a.v)
            return Law(a=-force, b=+force, dissipated=force * (b.v - a.v))

    class Misspelt(Engine):
        exempt = {"dissipate": "It is a motor."}

    contract(Engine)
    assert "exempt names ['dissipate']; properties are " in broken(Misspelt)[1]


def test_a_law_that_cannot_be_traced_breaks_the_contract_at_its_own_line():
    class Branching(TwoEnded):
        def law(p, a, b):
            return (0, 0) if b.x > a.x else (1, -1)

    assert "test_contract.py:" in broken(Branching)[1]
    assert "a law must not branch on values" in broken(Branching)[1]


def test_parameters_that_random_numbers_do_not_suit_can_be_given():
    class Choosy(TwoEnded):
        exact = Parameter("m", default=0.125)

        def check(p):
            if p.exact != 0.125:
                yield "exact", "exact must be 0.125", ""

    with pytest.raises(
        ValueError, match=r"no random parameters pass its own check .* fix some: contract\(Choosy, exact=...\)"
    ):
        contract(Choosy)
    contract(Choosy, exact=0.125)


def test_a_derivative_that_is_wrong_in_the_machine_code_is_told(monkeypatch):
    from fairlead.kernels import layout
    from fairlead.testing.rig import Rig

    ask = Rig.ask

    def tampered(self, mode, inputs, zones, *, machine=False):
        said = ask(self, mode, inputs, zones, machine=machine)
        return said * (1 + 1e-6) if machine and mode == layout.PARTIALS_FLOWS else said

    monkeypatch.setattr(Rig, "ask", tampered)
    with pytest.raises(
        ContractError, match=r"the derivative of port:a to port:a:x is .* in machine code and .* by complex step"
    ):
        next(check for check in checks(TwoEnded) if check.name == "derivatives")()


def test_the_list_of_properties_can_be_parametrised():
    assert [check.name for check in checks(TwoEnded)] == list(PROPERTIES)
    assert str(checks(TwoEnded)[0]) == "TwoEnded derivatives"


USERS_FILE = """\
from fairlead.component import Component, Law, Parameter, Translational


class Cushion(Component):
    \"\"\"A spring that stiffens:  force = k u + c u^3.\"\"\"

    a, b = Translational(), Translational()
    k = Parameter("N/m", above=0)
    c = Parameter("N/m^3", default=0.0, least=0)

    def law(p, a, b):
        u = b.x - a.x
        force = p.k * u + p.c * u**3
        return Law(a=-force, b=force, stored=p.k * u**2 / 2 + p.c * u**4 / 4)
"""


def test_a_component_in_a_users_own_file_passes(tmp_path):
    from fairlead.component.registry import load_library

    (tmp_path / "cushion.py").write_text(USERS_FILE)
    assert USERS_FILE.count("\n") <= 15
    contract(load_library(str(tmp_path / "cushion.py")).Cushion)
