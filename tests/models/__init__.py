"""Whole scenes, from netlist to result, against what is known about them."""
