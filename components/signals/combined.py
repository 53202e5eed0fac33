"""Sums of many signals, each times its factor, from sums of a few."""

from fairlead.components.control.sum import Sum

SUMMANDS = "abcd"  # of a Sum


def combined(scene, name, terms, offset=0.0):
    """Children and joins for offset + sum of factor times signal, and the end that tells it.

    `terms` are (end, factor); what is zero is left out. `name` begins the names of the children.
    """
    waiting = [(end, factor) for end, factor in terms if factor != 0]
    children, joins, total = {}, [], None
    while total is None or waiting:
        room = len(SUMMANDS) - (total is not None)
        taken = ([] if total is None else [(total, 1.0)]) + waiting[:room]
        waiting = waiting[room:]
        gains = {f"gain_{port}": factor for port, (_, factor) in zip(SUMMANDS, taken, strict=False)}
        child = f"{name}{len(children) or ''}"
        children[child] = scene.make(Sum, offset=0.0 if children else offset, **gains)
        joins += [(end, f"{child}.{port}") for port, (end, _) in zip(SUMMANDS, taken, strict=False)]
        total = f"{child}.signal"
    return children, joins, total
