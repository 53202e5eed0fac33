"""At a point and inside the step from it.

Given `point`: y, the trial end, error weights, D; `run` for what the last step was like.
Does  the error norm and the next step (controller.py), y inside the step (interpolant.py), how far that is off the
      equations (defect.py), y'' beyond its rounding (curvature.py), quadratures over a piece (quadratures.py), which
      speeds follow a stiff law within the step (stiff.py), errors that it does not show: of laws that fade in the step
      (faded.py), of sines that it turns too far (swings.py). Step sizes have few digits (even_steps.py).
Changes no zone, and records nothing.
"""
