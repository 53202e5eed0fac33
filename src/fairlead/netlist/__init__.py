"""The first stage: a YAML netlist becomes a frozen `Netlist` in which every entry knows its place."""
