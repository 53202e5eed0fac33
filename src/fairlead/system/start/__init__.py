"""Where and how fast things are at the start, when relations or rigid rows tie them together.

Given a System and what the netlist gives.
Says  a System that begins consistently, or what contradicts what.
"""
