"""How near a run came to the limits of its line.

Given the tables of a result, and statics for comparison.
Does  margins.py per station and over the run, ruck.py for rucking, limits_again.py for the limits of the netlist;
      quasi_static.py and hose_against_statics.py compare a run with statics, settled.py its halves with each other.
Says  a row for each limit or place; it runs nothing.
"""
