"""What line that moves as one body in the sea gives up: tensions in the route, beside those with line that stretches.

    python benchmarks/sea_forms.py          two minutes; prints the table of docs/routes.md

Tension of hose and core together just outboard of bend B, at accuracy 1e-4: its mean while the speed is steady, its
extremes over the run; the lowest tension of the hose anywhere in the route, and the greatest de-registration there.
"""

from __future__ import annotations

import pathlib
import shutil
import tempfile
import warnings
from typing import NamedTuple

import numpy as np
from machine import machine

import fairlead

MODELS = pathlib.Path(__file__).parent.parent / "models"
LONG = '"line.core[*].tension", "line.hose_node[*].x"'
WANTED = '"line.core[*].tension", "line.hose_node[*].x", "line.hose[*].tension", "line.registration[*].d"'
DEPLOYED = {"line.start": "-86 m", "line.profile": "statics", "speed": "0.5 m/s", "run.stop": "45 s",
            "belts.velocity.trapezoid.stay": "25 s"}  # fmt: skip
BRISK = {"belts.velocity.trapezoid.rise": "1 s", "belts.velocity.trapezoid.fall": "1 s"}
FORMS = {"distributed": {"form": "distributed"}, "rigid": {"form": "rigid"},
         "rigid, margin 5 m": {"form": "rigid", "margin": "5 m"}}  # fmt: skip


class Scene(NamedTuple):
    """A model with settings; which station its sea is and where it begins; the place looked at; when all is steady."""

    name: str
    model: str
    settings: dict[str, str]
    station: int
    sea: float  # m
    place: float  # m
    steady: tuple[float, float]  # s


SCENES = (
    Scene("200 m out, 0.5 m/s in 10 s", "long_deployment", DEPLOYED, 4, 13.0, 12.7, (20.0, 35.0)),
    Scene("200 m out, 0.5 m/s in 1 s", "long_deployment", DEPLOYED | BRISK, 4, 13.0, 12.7, (11.0, 26.0)),
    Scene("`guidance_route`, one module", "guidance_route", {}, 5, 10.0, 9.5, (36.0, 47.0)),
)


class Seen(NamedTuple):
    """One row."""

    steady: float  # N
    least: float
    most: float
    hose: float
    apart: float  # m


def seen(scene: Scene, form: str) -> Seen:
    """Run a scene with one form of the sea."""
    given = {f"route.stations[{scene.station}].{key}": word for key, word in FORMS[form].items()}
    given |= {"run.accuracy": "1e-4", "record.every": "20 ms"}
    with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        path = pathlib.Path(folder)
        shutil.copytree(MODELS / "parts", path / "parts")
        text = (MODELS / f"{scene.model}.yaml").read_text(encoding="utf-8").replace(LONG, WANTED)
        (path / "scene.yaml").write_text(text, encoding="utf-8")
        result = fairlead.load(path / "scene.yaml", set={**scene.settings, **given}).run(out=path / "run", check=False)
        if result.status != "finished":
            raise SystemExit(f"{scene.name}, {form}: {result.run['sentence']}")
        hose, core = (result.columns(result.match(f"line.{layer}[*].tension")) for layer in ("hose", "core"))
        x, slips = result.columns(result.match("line.hose_node[*].x")), result.match("line.registration[*].d")
        apart, t = np.abs(result.columns(slips)), np.asarray(result.t)
    middle = (x[:, 1:] + x[:, :-1]) / 2
    tension = np.array([np.interp(scene.place, *row) for row in zip(middle, hose + core, strict=True)])
    even = np.interp(np.linspace(*scene.steady, 1000), t, tension)
    inside = (middle > 0) & (middle < scene.sea)
    where = x[:, [int(name[name.index("[") + 1 : name.index("]")]) for name in slips]]
    in_route = (where > 0) & (where < scene.sea)
    return Seen(even.mean(), tension.min(), tension.max(), hose[inside].min(), apart[in_route].max())


def main() -> None:
    """Print the table."""
    print(machine())
    print("| scene | the line out there | steady N | lowest N | greatest N | hose, lowest N | de-registered mm |")
    print("| --- | --- | --- | --- | --- | --- | --- |")
    for scene in SCENES:
        for form in FORMS:
            if form == "rigid" and scene.model == "guidance_route":
                continue  # its one module is longer than what is paid out
            one = seen(scene, form)
            print(f"| {scene.name} | {form} | {one.steady:.1f} | {one.least:.0f} | {one.most:.0f} | {one.hose:.1f} | "
                  f"{1e3 * one.apart:.1f} |", flush=True)  # fmt: skip


if __name__ == "__main__":
    main()
