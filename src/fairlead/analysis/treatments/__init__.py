"""How a scene is told to treat friction, and which scenes `stepping` may take.

Given netlists and models, never a result.
Does  written.py reads what a netlist writes with its declarations, treatments.py makes the settings that reach every
      contact, stepping_table.py is the table of docs/stepping.md as code, friction_record.py is the part of `run.json`.
Says  settings, tables and sentences; ModelError where a scene cannot be treated so.
"""
