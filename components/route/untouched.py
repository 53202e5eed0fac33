"""The surface of a device that the line does not touch, such as belts of a line without friction."""

from fairlead.component import Component, Law, Translational


class Untouched(Component):
    """Takes nothing from the surface it stands for."""

    surface = Translational("a surface that moves")

    def law(p, surface):
        """No force."""
        return Law(surface=0)
