"""A `Model` pickles: netlist, values and libraries go along, and it runs to the same bits wherever it arrives."""

import concurrent.futures
import multiprocessing
import pickle
import subprocess
import sys

import numpy as np
import pytest

import fairlead

OWN = """
class Pusher(Component):
    flange = Translational("what is pushed")
    rate = Parameter("N/s", "How fast the force grows.")

    def law(p, flange, t):
        return Law(flange=-p.rate * t, supplied=p.rate * t * flange.v)
"""
PUSHED = """
parameters: {m: 2 kg}
components:
  body: {type: Mass, mass: "{m}"}
  pusher: {type: Pusher, rate: 3 N/s}
connections: [[pusher.flange, body.flange]]
run: {stop: 0.2 s}
"""
ELSEWHERE = """
import pathlib, pickle, sys
model = pickle.loads(pathlib.Path(sys.argv[1]).read_bytes())
pathlib.Path(sys.argv[2]).write_bytes(pickle.dumps(model.run(out=None).columns()))
"""


def rows(model):
    return model.run(out=None).columns()


def test_a_pickled_model_keeps_its_values_and_runs_to_the_same_bits():
    model = fairlead.load("belt", set={"run.stop": "0.5 s", "pad.normal_force": "12 N"})
    want = rows(model)
    again = pickle.loads(pickle.dumps(model))
    assert again.netlist == model.netlist
    assert np.array_equal(rows(again), want, equal_nan=True)


@pytest.mark.slow
def test_nothing_compiled_goes_along():
    model = fairlead.load("hundred_blocks", set={"blocks": "1000"})
    before = len(pickle.dumps(model))
    assert model.system.n > 1000
    assert len(pickle.dumps(model)) == before


def test_a_fresh_process_runs_it_to_the_same_bits_with_its_library(scene, library, tmp_path):
    model = scene(PUSHED, (library(OWN),), m="3 kg")
    want = rows(model)
    assert want.max() > 0
    file, answer = tmp_path / "model.pickle", tmp_path / "answer.pickle"
    file.write_bytes(pickle.dumps(model))
    subprocess.run([sys.executable, "-c", ELSEWHERE, file, answer], check=True, cwd=tmp_path)
    assert np.array_equal(pickle.loads(answer.read_bytes()), want, equal_nan=True)


def test_processes_that_are_spawned_take_it():
    model = fairlead.load("belt", set={"run.stop": "0.2 s"})
    spawn = multiprocessing.get_context("spawn")
    with concurrent.futures.ProcessPoolExecutor(1, mp_context=spawn) as pool:
        assert np.array_equal(pool.submit(rows, model).result(), rows(model), equal_nan=True)
