"""A gear whose losses depend on the direction of power, on its load and on its speed."""

from fairlead.components.rotation.gear import Gear
from fairlead.components.rotation.rubbing import METHODS, Brake
from fairlead.components.rotation.torque_sensor import TorqueSensor

from fairlead.component import (
    Choice,
    Component,
    Composite,
    Expansion,
    Input,
    Law,
    Output,
    Parameter,
    Rotational,
    Table,
    sqrt,
)  # fmt: skip

EFFICIENCY = {
    "efficiency": Parameter("1", "Share that arrives when a drives.", default=None, above=0, most=1),
    "efficiency_points": Table("rad/s", "1", "The same over the speed of a, without sign.", default=None),
    "efficiency_back": Parameter("1", "Share when b drives; 2 - 1/efficiency when not given.", default=None, most=1),
    "back_points": Table("rad/s", "1", "The same over the speed of a.", default=None),
    "bearing": Parameter("N*m", "Dry torque at shaft a without load.", default=0.0, least=0),
    "bearing_points": Table("rad/s", "N*m", "The same over the speed of a.", default=None),
    "round_off": Parameter("N*m", "Torque by which the load counts less: a corner rounded off.", default=1e-6, above=0),
    "slow": Parameter("rad/s", "Speed below which its size is rounded off.", default=1e-3, above=0),
}
"""Of the loss of teeth, which LossyGear hands on."""


class ToothLoss(Component):
    """Loss of teeth at their driving shaft, for a torque T that they carry to the driven one.

        a drives    T w > 0    loss = (1/eta - 1) |T|           eta = efficiency at w
        b drives    T w < 0    loss = (1 - eta_back) |T|

    Both are written as  skew T + level sign(w).  `skew` is half the difference of the two factors: this part is a
    torque without a threshold, and the shaft takes it here. `level` is half the sum of the factors times |T|: this
    part is dry friction, and its level is an output. |T| is sqrt(T^2 + round_off^2) - round_off, whose slope is nowhere
    above one: near no load the gear would else lock itself where its efficiencies do not.
    """

    exempt = {
        "units": "A torque is handed to a contact at a radius of 1 m, as the force there (docs/drives.md).",
        "dissipates": "The skew alone gives back what the friction beside it takes (Pelchen, Schweiger, Otter 2002).",
    }
    shaft = Rotational("driving shaft")
    efficiency, efficiency_points = EFFICIENCY["efficiency"], EFFICIENCY["efficiency_points"]
    efficiency_back, back_points = EFFICIENCY["efficiency_back"], EFFICIENCY["back_points"]
    bearing, bearing_points = EFFICIENCY["bearing"], EFFICIENCY["bearing_points"]
    round_off, slow = EFFICIENCY["round_off"], EFFICIENCY["slow"]
    carried = Input("N*m", "Torque carried on, before the ratio.", signed=True)
    level = Output("N", "Level of the friction at a radius of 1 m.")
    skew = Output("N*m", "The part of the loss that has no threshold.")
    pressed = Output("N*m", "The torque carried on.", rounded_by="round_off")
    asked_with = {"efficiency": 0.8}

    def law(p, shaft, carried):
        """Two factors of the load, and what rubs without it."""
        w = sqrt(shaft.speed**2 + p.slow**2) - p.slow
        drives = 1 / (p.efficiency if p.efficiency_points is None else p.efficiency_points(w)) - 1
        driven = drives
        if p.back_points is not None or p.efficiency_back is not None:
            driven = 1 - (p.efficiency_back if p.back_points is None else p.back_points(w))
        size = sqrt(carried**2 + p.round_off**2) - p.round_off
        rubs = p.bearing if p.bearing_points is None else p.bearing_points(w)
        skew = (drives - driven) / 2 * carried
        return Law(shaft=skew, level=(drives + driven) / 2 * size + rubs, skew=skew, pressed=carried,
                   dissipated=skew * shaft.speed)  # fmt: skip


class LossyGear(Composite):
    """b turns `ratio` times as often as a; teeth take a share of the load, bearings a torque without it.

    For forward turning the torques are

        torque_b = efficiency (torque_a - bearing)/ratio          a drives
        torque_a = efficiency_back ratio torque_b - bearing       b drives

    Between the two the gear sticks, as dry friction does. All three parameters may be given over the speed of a.

    `efficiency_back` of zero or less locks the gear: no torque at b turns it. If it is negative, a must help to let
    the load down. Its default is 2 - 1/efficiency, which friction on one pair of flanks gives. So a gear with an
    efficiency of half or less locks itself.

    Source: Pelchen, Schweiger, Otter 2002, Modeling and simulating the efficiency of gearboxes and of planetary
    gearboxes, 2nd Modelica Conference, 257; of the default, the power screw (Shigley's Mechanical Engineering Design).

    Limits: there is no play (put a Backlash beside it). A load does not follow the driving side of a gear that
    locks itself, if ratio^2 times its inertia is more than that of the driving side over -efficiency_back: let down, it
    is pushed at once, or the gear jams. No motion of rigid parts exists then, so a run ends. Give the load a
    TorsionSpring.
    """

    a = Rotational("driving shaft")
    b = Rotational("driven shaft")
    ratio = Parameter("1", "Turns of b for one turn of a; not zero. 1/30 slows down.")
    efficiency, efficiency_points = EFFICIENCY["efficiency"], EFFICIENCY["efficiency_points"]
    efficiency_back, back_points = EFFICIENCY["efficiency_back"], EFFICIENCY["back_points"]
    bearing, bearing_points = EFFICIENCY["bearing"], EFFICIENCY["bearing_points"]
    round_off, slow = EFFICIENCY["round_off"], EFFICIENCY["slow"]
    method = Choice(METHODS, "Treatment of sticking; the scene's when not given.", default=None)
    hands_on = ("method",)
    torque = Output("N*m", "Torque that the teeth carry, at shaft a, after their loss when a drives.")
    friction = Output("N*m", "Dry part of the loss, at shaft a, positive when it opposes turning forward.")
    skew = Output("N*m", "The other part, which has no threshold; zero unless efficiency_back is given.")

    def check(p):
        """One way of telling each, and shares that are shares."""
        if p.ratio == 0:
            yield "ratio", "ratio is zero", "Hold a shaft with a prescribed motion instead."
        if (p.efficiency is None) == (p.efficiency_points is None):
            yield "", "give either efficiency or efficiency_points", "One share, or shares over speed."
        if p.efficiency_back is not None and p.back_points is not None:
            yield "back_points", "back_points are given beside efficiency_back", "Leave one out."
        for name, lowest in (("efficiency_points", 0.0), ("back_points", None), ("bearing_points", None)):
            table = getattr(p, name)
            if table is None:
                continue
            values, beyond = [*table.terms[:, 0], table(0.0)], table.terms[-1, 1]
            if name == "bearing_points":
                if min(values) < 0:
                    yield name, f"a torque is {min(values):g} N*m", "Give what holds back as positive."
                elif beyond < 0:
                    speed = table.left[-1] - table.terms[-1, 0] / beyond
                    what = f"beyond: line has the torque fall below zero from {speed:.4g} rad/s on"
                    yield name, what, "Leave beyond out, or give points as far as the speed goes."
                continue
            between = "above 0, up to 1" if lowest is not None else "up to 1"
            if max(values) > 1 or (lowest is not None and min(values) <= lowest):
                worst = max(values) if max(values) > 1 else min(values)
                yield name, f"a share is {worst:g}", f"Shares are {between}."
            elif beyond > 0 or (beyond < 0 and lowest is not None):
                end = 1.0 if beyond > 0 else lowest
                speed = table.left[-1] + (end - table.terms[-1, 0]) / beyond
                what = f"beyond: line leads to {end:g} at {speed:.4g} rad/s, and on"
                yield name, what, f"Shares are {between}. Leave beyond out, or give points as far as the speed goes."

    def expand(p, scene):
        """Friction on shaft a, what the teeth carry, and a rigid gear."""
        given = {name: getattr(p, name) for name in EFFICIENCY if getattr(p, name) is not None}
        word = {} if p.method is None else {"method": p.method}
        if p.round_off < EFFICIENCY["round_off"].default:  # a small gear: what holds at all is as much smaller
            word["normal_force"] = p.round_off
        children = {
            "loss": scene.make(ToothLoss, **given),
            "rubbing": scene.make(Brake, radius=1.0, curve=1.0 if loses(p) else 0.0, **word),
            "teeth": scene.make(TorqueSensor),
            "gear": scene.make(Gear, ratio=p.ratio),
        }
        joins = [
            ("rubbing.shaft", "loss.shaft", "teeth.a"), ("teeth.b", "gear.a"), ("teeth.torque", "loss.carried"),
            ("loss.level", "rubbing.normal"),
        ]  # fmt: skip
        shown = {"torque": "teeth.torque", "friction": "rubbing.torque", "skew": "loss.skew"}
        return Expansion(children, joins, {"a": "teeth.a", "b": "gear.b"}, shown)


def loses(p):
    """Whether anything in the parameters EFFICIENCY takes a torque."""
    tables = (p.efficiency_points, p.back_points, p.bearing_points)
    if any(one is not None for one in tables) or p.bearing > 0:
        return True
    return p.efficiency < 1 or p.efficiency_back not in (None, 1.0)
