"""Indices of the compiled loop: it asks no array whether one lies outside, so a build of it that does runs here."""

import os
import subprocess
import sys

import pytest

from fairlead.integrate.memory.layout import check_names
from fairlead.integrate.memory.struct import Struct

TRAPS = """
import numba, numpy
from fairlead.integrate.memory.foreign import indices, reals

@numba.cfunc(numba.float64(numba.int64, numba.int64, numba.int64), error_model="numpy", _nrt=False)
def pick(at_values, at_places, k):
    return reals(at_values, 4)[indices(at_places, 2)[k]]

values, places = numpy.arange(4.0), numpy.array([3, {place}])
print(pick.ctypes(values.ctypes.data, places.ctypes.data, 0), flush=True)
pick.ctypes(values.ctypes.data, places.ctypes.data, 1)
"""
RUNS = """
import fairlead
from fairlead.integrate import Run, integrate

for engine, name, stop in (("stepping", "weak_clamp", 4.0), ("stepping", "hundred_blocks", 1.0),
                           ("rodas", "weak_clamp", 4.0), ("rodas", "hundred_blocks", 0.3)):
    outcome = integrate(fairlead.load(name).system, Run(stop=stop, every=0.1, engine=engine))
    print(outcome.status.name, outcome.counters.switches > 0)
"""


def checked(script, folder):
    """Run the script with a loop that traps; its own cache, so that none of this is met elsewhere."""
    environment = os.environ | {"FAIRLEAD_CHECK_INDICES": "1", "FAIRLEAD_CACHE": str(folder)}
    return subprocess.run([sys.executable, "-c", script], env=environment, capture_output=True, text=True)


@pytest.mark.slow
@pytest.mark.parametrize("place", [-1, 4])
def test_an_index_outside_traps_where_the_loop_is_compiled_to(tmp_path, place):
    ended = checked(TRAPS.format(place=place), tmp_path)
    assert ended.stdout == "3.0\n"
    assert ended.returncode != 0


@pytest.mark.slow  # compiles both loops with the question at every index
def test_no_index_lies_outside_in_runs_of_both_engines(tmp_path):
    ended = checked(RUNS, tmp_path)
    assert ended.returncode == 0, ended.stderr
    assert ended.stdout == "FINISHED True\n" * 4


def test_two_structs_with_one_name_are_refused():
    """The arrays of both would be one, as long as the second says, and the loop of the first would write beyond it."""
    with pytest.raises(ValueError, match="second declares slips, which first has"):
        check_names({"first": Struct(reals={"slips": "n"}), "second": Struct(indices={"slips": "n_machines"})})
