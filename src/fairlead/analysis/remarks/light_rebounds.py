"""Stops with a restitution at a node without inertia, which takes no impulse and so gives none back."""

from __future__ import annotations

from collections.abc import Iterator

from fairlead.component.assembly import PortRef
from fairlead.errors import Fault
from fairlead.system.compiled.system import System


def light_rebounds(system: System) -> Iterator[Fault]:
    """One remark for each: what lies behind such a node, as a sensor, is stopped and not thrown back."""
    flat, rebound = system.flat, system.rebound
    for block in system.blocks:
        s = block.kernel.structure
        for unknown in s.rebounds:
            rows = block.flow_index[:, s.targets.index(f"own:{unknown}")].tolist()
            for row, instance in zip(rows, block.instances, strict=True):
                named = (PortRef(instance.path, name) for name in instance.type.declaration.ports)
                groups = ((str(port), flat.groups[flat.place(port)[0]]) for port in named)
                light = [port for port, group in groups if group.free and group.mass <= 0.0]
                if rebound[row] > 0.0 and light:
                    what = f"its restitution gives nothing back, since nothing at {light[0]} has inertia."
                    way_out = "Put a Mass or an Inertia there, or connect it to a body."
                    yield Fault(instance.where, f"{instance.path}: {what}", way_out)
