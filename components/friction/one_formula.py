"""What laws of one formula have in common: no zone tells sticking from sliding."""

from fairlead.components.friction.contact import Contact

from fairlead.component import Zones, guard


class OneFormula(Contact, abstract=True):
    """A contact that is either pressed, `on`, or open."""

    zones = Zones("on", "off")

    @guard("off", to="on", unit="N")
    def lands(p, normal):
        """Pressed again."""
        return normal - 2 * p.lift
