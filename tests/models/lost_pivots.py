"""A scene in which planned pivots vanish on the way: what is to be solved stays as regular as it was.

Every pair of forces is told by two equations; with `share` s they have the matrix [s 1; 1 -s], of determinant
-(s^2 + 1). The pivots are planned at s = 1. Where s is zero, both are zero.
"""

from __future__ import annotations

PAIR = '''
    class Pair(Component):
        """Two forces told by each other."""
        a, b = Translational("one side"), Translational("the other side")
        share = Waveform("1", "What its own equation has of a force.")
        stiffness = Parameter("N/m", "Of the pair.", above=0)
        first, second = Unknown("N"), Unknown("N")

        def law(p, a, b, t, first, second):
            s, pull = p.share(t), p.stiffness * (b.x - a.x)
            return Law(a=-first, b=first, first=s * first + second - (1 + s) * pull,
                       second=first - s * second - (1 - s) * pull)
'''
"""Both forces are the pull, for every s."""


def lost_pivots(count: int = 12) -> str:
    """A chain of blocks on pads, joined by such pairs, whose shares go from one to zero."""
    floor = ", ".join(f"pad{k}.a" for k in range(count))
    parts, joins = ["floor: {type: Ground}"], [f"[floor.flange, {floor}, pair0.a]"]
    for k in range(count):
        share = f"{{ramp: {{from: 1, to: 0, start: 0.1 s, over: {0.3 + 0.001 * k:.3f} s}}}}"
        parts += [
            f"pair{k}: {{type: Pair, stiffness: {200 + 10 * k} N/m, share: {share}}}",
            f"block{k}: {{type: Mass, mass: 1 kg, velocity: {0.1 * k:.1f} m/s}}",
            f"pad{k}: {{type: Contact, normal_force: 5 N, curve: 0.4}}",
        ]
        joins.append(f"[pair{k}.b, block{k}.flange, pad{k}.b{f', pair{k + 1}.a' if k + 1 < count else ''}]")
    lines = ["components:", *(f"  {part}" for part in parts), "connections:", *(f"  - {join}" for join in joins)]
    return "\n".join([*lines, "run: {stop: 1 s}", ""])
