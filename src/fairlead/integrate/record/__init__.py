"""What a run records, into buffers that Python empties.

Given `recorder` and the point. Does rows on a grid, at ends of steps, inside them and at both sides of an event
      (rows.py), without slip and where stiff laws balance (between.py), zone changes.
Says  there_is_room before anything is written that cannot be taken back.
"""
