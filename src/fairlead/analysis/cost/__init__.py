"""What an accuracy or a mesh costs in time, and what it buys.

Given a function that runs a case.
Does  timed_run.py and boxed_runs.py run it under limits, ladder.py over accuracies, meshes.py over meshes;
      references.py, deviation.py and mesh_errors.py compare; choice.py picks.
Says  rows of cost and error; what did not end in its limits is a row too.
"""
