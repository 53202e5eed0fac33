"""The engine of a run: chosen in the netlist, stated in run.json, refused at once when its package is missing."""

import sys

import pytest

import fairlead
from fairlead.engine import engine_of
from fairlead.errors import UsageError
from fairlead.system.compiled.named_parts import least_friction_left


def test_ida_runs_from_a_netlist_and_run_json_says_so(tmp_path):
    pytest.importorskip("sksundae.ida", reason="needs scikit-sundae: pip install 'fairlead[ida]'")
    result = fairlead.load("belt", set={"run.engine": "ida", "run.stop": "2 s"}).run(out=tmp_path / "run")
    assert result.status == "finished"
    assert (result.run["engine"], result.run["engine_reason"]) == ("ida", "chosen by run.engine")
    assert [e.zone_to for e in result.events] == ["backward", "held", "backward", "held"]
    assert result.run["energy"]["closure"] < 1e-3


def test_ida_without_its_package_is_refused_before_a_directory_is_made(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "sksundae.ida", None)
    model = fairlead.load("belt", set={"run.engine": "ida"})
    with pytest.raises(UsageError, match=r"needs the package scikit-sundae.*\n.*pip install 'fairlead\[ida\]'"):
        model.run(out=tmp_path / "run")
    assert not (tmp_path / "run").exists()


LEVELS = """
    from fairlead.components.friction.curve import Curve


    class Levels(Curve):
        '''Two levels under names of its own.'''

        static, kinetic = Parameter("1", "At rest.", least=0), Parameter("1", "Sliding.", least=0)

        def breakaway(p):
            return p.static

        def coefficient(p, v):
            return p.kinetic


    class Stick(Component):
        '''A contact that is no member of the family: static level and sliding level are forces.'''

        left, right = Translational(), Translational()
        most, least = Parameter("N", above=0), Parameter("N", above=0)
        pull = Unknown("N")
        zones = Zones("fast", "slips", "slips_back")

        @zone("fast")
        def fast(p, left, right, pull):
            return Law(left=-pull, right=+pull, pull=hold(right.v - left.v))

        @zone("slips")
        def slips(p, left, right, pull):
            return Law(left=-p.least, right=p.least, pull=pull - p.most)

        @zone("slips_back")
        def slips_back(p, left, right, pull):
            return Law(left=p.least, right=-p.least, pull=pull + p.most)

        @guard("fast", to="slips", unit="N")
        def lets_go(p, pull):
            return pull - p.most

        @guard("fast", to="slips_back", unit="N")
        def lets_go_back(p, pull):
            return -pull - p.most

        @guard("slips", to="fast", unit="m/s")
        def stops(p, left, right):
            return left.v - right.v

        @guard("slips_back", to="fast", unit="m/s")
        def stops_back(p, left, right):
            return right.v - left.v
"""
PADS = {
    "as bundled, one level": ("{type: Contact, normal_force: 9 N, curve: 0.3}", 1.0),
    "as bundled": ("{type: Contact, normal_force: 9 N, curve: {curve: coulomb, stiction: 0.4, coulomb: 0.3}}", 0.75),
    "as bundled, with a load exponent": (
        "{type: Contact, normal_force: 9 N, curve: {curve: coulomb, stiction: 0.4, coulomb: 0.3, load_exponent: 0.8, "
        "load_reference: 5 N, softening: 0.01 1/K}}",
        0.75,
    ),
    "other names": ("{type: Contact, normal_force: 9 N, curve: {curve: levels, static: 0.4, kinetic: 0.3}}", 0.75),
    "other names, one level": (
        "{type: Contact, normal_force: 9 N, curve: {curve: levels, static: 0.3, kinetic: 0.3}}",
        1.0,
    ),
    "another class": ("{type: Stick, most: 4 N, least: 3 N}", 0.75),
    "another class, one level": ("{type: Stick, most: 3 N, least: 3 N}", 1.0),
    "a limit kept until the slip leaves a band": (
        "{type: Contact, method: karnopp, normal_force: 9 N, curve: {curve: levels, static: 0.4, kinetic: 0.3}}",
        0.75,
    ),
    "points that begin at rest": (
        "{type: Contact, normal_force: 9 N, curve: {curve: table, points: [[0, 0.4], [1, 0.3]]}}",
        1.0,
    ),
    "a fall that is smooth": (
        "{type: Contact, normal_force: 9 N, curve: {curve: stribeck, stiction: 0.4, coulomb: 0.3, velocity: 0.1}}",
        1.0,
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", PADS)
def test_a_contact_that_lets_go_with_a_jump_is_known_by_its_law(name, scene, library):
    """Once by parameters called `curve.rest` and `curve.coulomb`, so that other names were passed over."""
    pad, left = PADS[name]
    ends = ("left", "right") if "Stick" in pad else ("a", "b")
    system = scene(
        f"""
        components: {{floor: {{type: Ground}}, pad: {pad}, block: {{type: Mass, mass: 1 kg}}}}
        connections: [[floor.flange, pad.{ends[0]}], [pad.{ends[1]}, block.flange]]
        run: {{stop: 1 s}}
        """,
        libraries=(library(LEVELS),),
    ).system
    assert least_friction_left(system) == pytest.approx(left, abs=1e-12)


@pytest.mark.parametrize(("sliding", "engine"), [("0.4", "stepping"), ("0.3", "rodas")])
@pytest.mark.parametrize(
    "curve", ["{{curve: coulomb, stiction: 0.4, coulomb: {}}}", "{{curve: levels, static: 0.4, kinetic: {}}}"]
)
def test_the_engine_does_not_depend_on_names_of_parameters(curve, sliding, engine, scene, library):
    pads = "".join(
        f"pad{k}: {{type: Contact, normal_force: 9 N, curve: {curve.format(sliding)}}}, " for k in range(100)
    )
    blocks = "".join(f"block{k}: {{type: Mass, mass: 1 kg}}, " for k in range(100))
    joins = ", ".join(f"[floor.flange, pad{k}.a], [pad{k}.b, block{k}.flange]" for k in range(100))
    model = scene(
        f"components: {{floor: {{type: Ground}}, {pads}{blocks}}}\nconnections: [{joins}]\nrun: {{stop: 1 s}}\n",
        libraries=(library(LEVELS),),
    )
    assert engine_of(model.netlist.run, model.system)[0] == engine


def test_what_swings_is_known_by_the_waveform(scene, library):
    """An own parameter called omega is none, and one of another name that swings is one."""
    system = scene(
        """
        components:
          pushed: {type: Mass, mass: 1 kg}
          push: {type: Push, drive: {sine: {amplitude: 1 N, frequency: 5 Hz}}, omega: 1e6}
        connections: [[push.b, pushed.flange]]
        run: {stop: 1 s}
        """,
        libraries=(
            library("""
            class Push(Component):
                '''A force.'''
                b = Translational()
                drive, omega = Waveform("N"), Parameter("1")

                def law(p, t):
                    return Law(b=-p.drive(t) * p.omega / p.omega)
        """),
        ),
    ).system
    assert system.longest_step == pytest.approx(1 / 5 / 8)
