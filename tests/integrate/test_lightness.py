"""What integrating loads: nothing of the rest of fairlead, and no compiler once the loop is cached."""

from __future__ import annotations

import ast
import subprocess
import sys
from pathlib import Path

import pytest

from tests.integrate.problems import belt_block


def loaded_after(statements):
    program = f"{statements}\nimport sys; print(' '.join(sorted(sys.modules)))"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    return done.stdout.split()


def test_importing_the_integrator_loads_numpy_and_nothing_heavier():
    modules = loaded_after("import fairlead.integrate")
    assert not {"numba", "scipy", "sympy", "llvmlite", "xarray", "matplotlib"} & set(modules)


BENEATH = {"fairlead.native", "fairlead.sealed", "fairlead.processor", "fairlead.errors"}
"""What machine code is kept with: the cache, its seals, the processor it is for."""


def test_the_integrator_uses_nothing_of_the_rest_of_fairlead_but_the_cache_of_its_code():
    before = set(loaded_after("import fairlead"))
    after = set(loaded_after("import fairlead, fairlead.integrate"))
    ours = {name for name in after - before if name.startswith("fairlead.")}
    others = {name for name in ours if not name.startswith("fairlead.integrate")}
    assert others <= BENEATH


def test_a_cached_loop_runs_without_numba():
    from fairlead.integrate import Run, integrate

    integrate(belt_block(), Run(stop=0.1))  # compiles, if need be
    start = "from fairlead.integrate.machine_code import compiled_loop; from fairlead.integrate.engines import RODAS; "
    modules = loaded_after(start + "compiled_loop(RODAS)")
    assert "numba" not in modules


@pytest.mark.slow
def test_the_key_of_the_cache_is_made_of_every_file_the_machine_code_is_made_of():
    from fairlead.integrate import machine_code
    from fairlead.integrate.engines import ENGINES

    def behind(*names):
        found, todo = set(), list(names)
        while todo:
            file = folder.joinpath(*todo.pop().split(".")[2:]).with_suffix(".py")
            if file.is_file() and file not in found:
                found.add(file)
                tree = ast.parse(file.read_text(encoding="utf-8"))
                modules = [node.module or "" for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)]
                todo += [m for m in modules if m.startswith("fairlead.integrate.")]
        return found

    def told(*sources):
        return {file for name in (*machine_code.ROOMS, *machine_code.FILES, *sources)
                for file in machine_code.sources_of(name)}  # fmt: skip

    folder = Path(machine_code.__file__).parent
    described = {folder / f"{name}.py" for name in ("problem", "facts", "counters", "engine")}
    # These are shapes and names; nothing of theirs is compiled.
    for engine in ENGINES.values():
        assert behind(engine.module) - described <= told(*engine.sources)
    assert behind("fairlead.integrate.ida.kernels") - described <= told("rodas", "ida/kernels.py")
