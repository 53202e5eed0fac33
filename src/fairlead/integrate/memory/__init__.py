"""The memory of a run: a struct for each owner, the arena that they lie in, and how compiled code sees it.

Owns  the list of all fields (of_*.py, layout.py); a field belongs to one owner, sizes and facts are copied to others.
Gives Python `Memory` (arena.py): values by name, save, restore; compiled code the structs at an address (foreign.py).
Holds no formula, and knows no other room.
"""
