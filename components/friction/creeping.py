"""Contacts that creep in proportion to their load: how fast they may, as a speed or as a share of load lost."""

import math

from fairlead.components.friction.contact import Contact, with_lift
from fairlead.components.friction.curve import load_factor, stays_in_place

from fairlead.component import Block, Parameter

USUAL = 1e-4  # m/s; creep when neither it nor a leak is given
RANGE = (1e-15, 10.0)  # m/s; between these the creep that goes with a leak is looked for
HALVINGS = 200  # of that range, on a logarithmic scale; many more than a double has digits
AGREE = 1e-6  # relative difference of two creeps that are one number

LEAK = {
    "share": Parameter("1", "Part of the load that may be lost.", above=0, below=1),
    "time": Parameter("s", "Time in which it may be lost.", above=0),
    "stiffness": Parameter("N/m", "Stiffness of what loads the contact.", above=0),
    "normal_force": Parameter("N", "Normal force meanwhile; the contact's when absent.", default=None, above=0),
}


class Creeping(Contact, abstract=True):
    """A contact that sticks by a steep line T = g0 v, so that a spring k loses its load as exp(-k t/g0).

    Instead of `creep` one may say what one can bear: `leak: {share: 1 %, time: 10 s, stiffness: 10 kN/m}`. Then
    g0 = -k time/ln(1 - share), and `creep` is the one that gives this slope.
    """

    sticks_below, creeps = "creep", True
    creep = Parameter("m/s", "Slip speed that scales the line; 0.1 mm/s without a leak.", default=None, above=0)
    leak = Block(LEAK, "Instead of creep: the load that may be lost while the contact sticks.", default=None)

    def check(p):
        """The curve stays where it is; a leak wants a normal force, and no creep beside it."""
        yield from stays_in_place(p)
        if p.leak is None:
            return
        if p.leak.normal_force is None and p.normal_force is None:
            yield "leak", "the normal force is a signal here", "Give leak.normal_force, at which this shall hold."
            return
        wanted = creep_of_leak(p.type, {**p.given, "leak": vars(p.leak)})
        if wanted is None or abs(wanted - p.creep) > AGREE * p.creep:
            yield "leak", "both leak and creep are given", "Leave one of them out, here or in the friction block."


def with_creep(kind, given):
    """What an instance of `kind` is given, with its lift, and its creep: as said, of its leak, or the usual one."""
    given = with_lift(given)
    return {**given, "creep": given["creep"] or creep_of_leak(kind, given) or USUAL}


def creep_of_leak(kind, given):
    """The creep [m/s] with which a contact leaks as much as it may; None without a leak or its normal force."""
    leak = given["leak"]
    normal = leak and (leak["normal_force"] or given["normal_force"])
    if not normal:
        return None
    grip = normal * load_factor(given["curve"], normal / given["extent"], given["lift"] / given["extent"])
    slope = -leak["stiffness"] * leak["time"] / math.log1p(-leak["share"])
    low, high = map(math.log, RANGE)
    for _ in range(HALVINGS):  # the slope falls as the creep grows
        middle = (low + high) / 2
        low, high = (middle, high) if grip * kind.slope(given, math.exp(middle)) > slope else (low, middle)
    return math.exp((low + high) / 2)
