"""What is installed is what is on disk: the package list, the data, and a wheel that runs elsewhere."""

import os
import pathlib
import shutil
import subprocess
import sys
import tomllib
import venv
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SETUPTOOLS = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["setuptools"]
PACKAGES = {"src/fairlead": "fairlead", "components": "fairlead.components", "models": "fairlead.models"}


def packages_on_disk() -> set[str]:
    """Dotted names of all folders with an `__init__.py`, as they are called once installed."""
    return {
        ".".join((name, *file.parent.relative_to(ROOT / folder).parts))
        for folder, name in PACKAGES.items()
        for file in (ROOT / folder).rglob("__init__.py")
    }


def test_pyproject_lists_exactly_the_packages_on_disk() -> None:
    assert sorted(SETUPTOOLS["packages"]) == sorted(packages_on_disk())


def test_every_folder_with_code_is_a_package() -> None:
    folders = {file.parent for top in PACKAGES for file in (ROOT / top).rglob("*.py")}
    assert not [folder for folder in folders if not (folder / "__init__.py").is_file()]


@dataclass(frozen=True)
class Elsewhere:
    """A clean environment outside the tree with our wheel installed, and a user's folder to work in."""

    folder: pathlib.Path

    @property
    def user(self) -> pathlib.Path:
        """Where the commands are called."""
        return self.folder / "user"

    @property
    def python(self) -> pathlib.Path:
        """The interpreter of the clean environment."""
        return self.folder / "env" / ("Scripts" if os.name == "nt" else "bin") / "python"

    def call(self, *words: str | pathlib.Path) -> str:
        """Output of `python words`, which must succeed, with nothing of this session's Python set-up."""
        variables = {key: value for key, value in os.environ.items() if not key.startswith("PYTHON")}
        return succeed(self.python, *words, cwd=self.user, env={**variables, "MPLBACKEND": "Agg"})

    def fairlead(self, *words: str) -> str:
        """Output of the installed command, which must succeed."""
        return self.call("-m", "fairlead", *words)


def succeed(*command: str | pathlib.Path, **settings: Any) -> str:
    """Standard output of a command that must end well; its words are shown when it does not."""
    words = [str(word) for word in command]
    done = subprocess.run(words, stdin=subprocess.DEVNULL, capture_output=True, text=True, **settings)
    assert done.returncode == 0, f"{words}\n{done.stdout}\n{done.stderr}"
    return done.stdout


def build_wheel(folder: pathlib.Path) -> pathlib.Path:
    """A wheel made from a copy of the sources: setuptools would leave a `build/` in the tree and reuse it."""
    copy = folder / "sources"
    for name in ("src", "components", "models", "building"):
        shutil.copytree(ROOT / name, copy / name, ignore=shutil.ignore_patterns("__pycache__", "*.egg-info"))
    for name in ("pyproject.toml", "README.md", "LICENSE"):
        shutil.copy(ROOT / name, copy)
    pip_wheel = (sys.executable, "-m", "pip", "wheel", "--quiet", "--no-deps", "--wheel-dir", folder)
    succeed(*pip_wheel, copy, cwd=folder)
    (wheel,) = folder.glob("fairlead-*.whl")
    return wheel


@pytest.fixture(scope="module", autouse=True)
def pip_is_patient() -> Iterator[None]:
    """An index that does not answer at once is asked again."""
    with pytest.MonkeyPatch.context() as settings:
        settings.setenv("PIP_RETRIES", "20")
        settings.setenv("PIP_DEFAULT_TIMEOUT", "60")
        yield


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> pathlib.Path:
    """Our wheel; building it compiles the engine, so it is built once."""
    return build_wheel(tmp_path_factory.mktemp("wheel"))


@pytest.fixture(scope="module")
def elsewhere(tmp_path_factory: pytest.TempPathFactory, request: pytest.FixtureRequest) -> Elsewhere:
    """Our wheel in a clean environment; its folder has a blank in its name, as folders have."""
    place = Elsewhere(tmp_path_factory.mktemp("else where"))
    place.user.mkdir()
    venv.create(place.folder / "env", with_pip=True)
    fetch = [place.python, "-m", "pip", "download", "--no-deps", "--dest", place.folder / "fetched"]
    answer = subprocess.run([*fetch, "setuptools"], capture_output=True, text=True)
    if answer.returncode:
        pytest.skip(f"no package index can be reached: {answer.stderr[-300:]}")
    wheel = request.getfixturevalue("wheel")
    place.call("-m", "pip", "install", "--quiet", f"{wheel}[ida]")
    return place


OWN_COMPONENT = '''
"""A component in a user's own file."""
from fairlead.component import Component, Law, Parameter, Translational

class HardeningSpring(Component):
    """A spring that grows stiffer as it is stretched."""
    a, b = Translational("one end"), Translational("the other end")
    stiffness = Parameter("N/m", "Tension per stretch, for small stretch.", above=0)
    hardening = Parameter("1/m^2", "Growth of the stiffness.", default=0.0)

    def law(p, a, b):
        s = b.x - a.x
        tension = p.stiffness * s * (1 + p.hardening * s**2)
        return Law(a=-tension, b=+tension, stored=p.stiffness * s**2 * (1 / 2 + p.hardening * s**2 / 4))
'''

OWN_MODEL = """
schema: 1
name: own
components:
  wall: {type: Ground}
  spring: {type: HardeningSpring, stiffness: 10 N/m, hardening: 2}
  block: {type: Mass, mass: 1 kg}
  push: {type: ForceSource, force: 1 N}
connections:
  - [wall.flange, spring.a]
  - [spring.b, block.flange, push.flange]
run: {stop: 1 s}
"""



@pytest.mark.slow
def test_an_installed_wheel_runs_a_bundled_model_by_name(elsewhere: Elsewhere) -> None:
    elsewhere.fairlead("run", "belt", "--out", "belt result")
    assert {"run.json", "series.nc"} <= {file.name for file in (elsewhere.user / "belt result").iterdir()}


WITHOUT_NUMBA = """
import importlib.util
import fairlead

assert importlib.util.find_spec("numba") is None
for engine in ("rodas", "stepping", "ida"):
    result = fairlead.load("belt", set={"run.engine": engine}).run(out=None)
    print(engine, result.status, result.run["switches"] > 0)
"""


@pytest.mark.slow
def test_an_installed_wheel_runs_each_engine_without_numba(elsewhere: Elsewhere) -> None:
    said = elsewhere.call("-c", WITHOUT_NUMBA)
    assert said.splitlines() == [f"{engine} finished True" for engine in ("rodas", "stepping", "ida")]


FIRST_RUN = """
import os
import sys
import tempfile

os.environ["FAIRLEAD_CACHE"] = tempfile.mkdtemp()
import fairlead

print(fairlead.load("belt").run(out=None).status)
for heavy in ("numba", "sympy"):
    assert heavy not in sys.modules, heavy
"""


@pytest.mark.slow
def test_the_first_run_of_an_installed_wheel_traces_no_law_of_a_bundled_part(elsewhere: Elsewhere) -> None:
    assert elsewhere.call("-c", FIRST_RUN).strip() == "finished"


@pytest.mark.slow
def test_an_installed_wheel_takes_a_component_from_a_users_file(elsewhere: Elsewhere) -> None:
    (elsewhere.user / "parts.py").write_text(OWN_COMPONENT)
    (elsewhere.user / "own.yaml").write_text(OWN_MODEL)
    elsewhere.fairlead("check", "own.yaml", "--library", "parts.py")
    assert "HardeningSpring" in elsewhere.fairlead("schema", "--library", "parts.py")
    assert "hardening" in elsewhere.fairlead("describe", "HardeningSpring", "--library", "parts.py")
    elsewhere.fairlead("run", "own.yaml", "--library", "parts.py", "--out", "own result")
    assert (elsewhere.user / "own result" / "run.json").is_file()


USES_IT = """
import fairlead

reveal_type(fairlead.load("belt").run(out=None))
fairlead.load("belt").run(acuracy=1e-2)
reveal_type(fairlead.RunError)
"""


@pytest.mark.slow
@pytest.mark.parametrize("mode", ["wheel", "editable"])
def test_a_type_checker_resolves_an_installed_and_an_editable_package(
    tmp_path: pathlib.Path, mode: str, request: pytest.FixtureRequest
) -> None:
    """The editable one as docs/python.md installs it: mypy cannot follow the import hook of setuptools' usual mode."""
    pytest.importorskip("mypy", reason="mypy comes with the extra lint")
    venv.create(tmp_path / "env", with_pip=True)
    place = Elsewhere(tmp_path)
    place.user.mkdir()
    fetch = [place.python, "-m", "pip", "download", "--no-deps", "--dest", tmp_path / "fetched", "setuptools"]
    if subprocess.run(fetch, capture_output=True).returncode:
        pytest.skip("no package index can be reached")
    wheel = request.getfixturevalue("wheel")
    strict = ("--config-settings", "editable_mode=strict", "--editable", wheel.parent / "sources")
    place.call("-m", "pip", "install", "--quiet", "--no-deps", *((wheel,) if mode == "wheel" else strict))
    (place.user / "use.py").write_text(USES_IT, encoding="utf-8")
    command = [sys.executable, "-m", "mypy", "--python-executable", place.python, "--cache-dir", tmp_path, "use.py"]
    said = subprocess.run(command, cwd=place.user, capture_output=True, text=True).stdout
    assert 'Revealed type is "fairlead.result.Result"' in said, said
    assert 'Unexpected keyword argument "acuracy" for "run" of "Model"; did you mean "accuracy"?' in said
    assert said.count("error:") == 1
