"""Reference motion of the single bend cut into more and more elements, by scipy on equations of its own.

The bundled `single_bend` (mu 0.35, 2 s: the ramp of the haul and a second after it) by scipy's Radau on
`bend_equations.py`, with a creep so small that the contacts hold as far as any benchmark asks. One number is
taken from fairlead's reading of the netlist: an element of the bundled line has the stiffness EA over its free
length, where the equations have EA over its length under the tension of the start, 1.6e-3 less for the hose.

    python benchmarks/bend_reference.py --elements 50      seconds; 200: minutes; 800: half an hour

Stored are all positions every 0.1 s in `data/bend_elements_<N>.npz`, with how far a coarser run is from them.
"""

import argparse
import json

import numpy as np
from bend_equations import Bend
from bend_scene import BendScene
from independent_bend import integrate
from peers import DATA

STOP, SAMPLE, FINE = 2.0, 0.1, 0.02  # [s]; FINE: what the engine samples at
CREEP, RTOL = 1e-6, 1e-8
COARSER = {"creep": 1e-5, "rtol": 1e-7}


def bend(elements: int, creep: float) -> Bend:
    """The equations with the stiffness of the bundled model."""
    scene = BendScene(creep=creep, elements=elements, stop=STOP)
    made = Bend(scene, "line")
    for layer, share in (("hose", scene.hose_share), ("core", 1.0 - scene.hose_share)):
        tension = scene.outboard * share
        stiffness = (getattr(scene, f"{layer}_stiffness") + tension) / scene.pitch
        setattr(made, f"{layer}_k", stiffness)
        setattr(made, f"{layer}_rest", scene.pitch - tension / stiffness)
    return made


def motion(elements: int, creep: float, rtol: float, wall: float = 36_000.0) -> tuple[np.ndarray, np.ndarray, dict]:
    """Times (21,), positions (21, 2 N + 2) of hose and core nodes from inboard to outboard, and counters."""
    record, count = integrate(bend(elements, creep), "Radau", rtol, FINE, wall)
    every = round(SAMPLE / FINE)
    return record.time[::every], np.concatenate([record.hose, record.core], axis=1)[::every], count


def main() -> None:
    """Command line: compute and store one bend."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--elements", type=int, default=50)
    elements = parser.parse_args().elements
    t, positions, count = motion(elements, CREEP, RTOL)
    _, coarser, _ = motion(elements, **COARSER)
    statement = {
        "engine": "scipy Radau", "elements": elements, "creep_m_per_s": CREEP, "rtol": RTOL, "counters": count,
        "coarser": COARSER, "difference_to_coarser_m": float(np.abs(coarser - positions).max()),
    }  # fmt: skip
    text = json.dumps(statement)
    np.savez_compressed(DATA / f"bend_elements_{elements}.npz", t=t, positions=positions, statement=text)
    print(text)


if __name__ == "__main__":
    main()
