"""Friction coefficient measured over slip speed."""

from fairlead.components.friction.curve import Curve, points_make_sense

from fairlead.component import Table, derived


class Data(Curve):
    """mu(v) from points: straight lines (one zone per interval) or a monotone cubic; constant beyond the last.

    The first point must be at zero speed; its value is the coefficient to start sliding. Points may stand in a file
    of two columns beside the netlist: `points: {file: measured.csv, kind: cubic}`. With `beyond: line` a curve that
    rises at its end goes on rising.
    """

    word = "table"
    points = Table("m/s", "1", "Slip speed and coefficient, first point at zero speed.")

    def coefficient(p, v):
        """The interval in force decides."""
        return p.points(v)

    @derived
    def rest(p):
        """Coefficient at zero speed."""
        return p.points(0.0)

    def breakaway(p):
        """Coefficient at zero speed."""
        return p.rest

    def scale(p):
        """The first interval."""
        inner = p.points.rows[1:, 0]
        return float(inner[1] - inner[0]) if len(inner) > 1 else None

    def check(p):
        """Speeds from zero on, no negative coefficient."""
        yield from Curve.check(p)
        yield from points_make_sense("points", p.points)
