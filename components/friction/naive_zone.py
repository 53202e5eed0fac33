"""The naive two-zone law: the sign of the slip frozen within a step. It fails where it should stick, and says so."""

from fairlead.components.friction.contact import Sliding

from fairlead.component import Zones, guard


class NaiveZone(Sliding):
    """T = +N mu(|v|) in zone forward, -N mu(|v|) in zone backward, plus viscous v; the slip's sign decides.

    forward   v > 0     backward   v < 0     off   N = 0

    Frozen zones make every step smooth, so the step size does not collapse as with the plain sign. But at rest neither
    zone is right. In `forward` the friction drives the block back, in `backward` it drives it on. So the zones do not
    settle, or switch at every step. There is no stiction: `curve` counts only while sliding. The bound on passes, the
    dwell or a budget of steps and switches ends such a run, with the name of this contact.

    Use `hold` to stick exactly, `binding` for many contacts at once. Both have a zone for sticking.

    Source: the two-zone example in Tomlinson, Cooke and Cosserat (2003), DOI 10.1177/095965180321700207, which warns
    of it as well.
    """

    advice = (
        "method naive_zone has no zone for sticking, so at rest neither of its two is right; use method hold, or "
        "binding where many contacts stick."
    )
    can_hold = False
    budget = {"max_steps": 100_000, "max_events": 50_000}
    zones = Zones("forward", "backward", "off", forward=["forward"], backward=["backward"])

    @guard("off", to="forward", unit="N")
    def lands(p, normal):
        """Pressed again; the direction is found at once."""
        return normal - 2 * p.lift

    @guard("forward", to="backward", unit="m/s", mirrored="reverses_forward")
    def reverses_backward(p, a, b, direction):
        """The slip has changed its sign."""
        return -direction * (b.v - a.v)
