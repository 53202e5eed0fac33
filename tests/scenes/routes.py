"""Random routes: a line through devices that bend, guide, press and clamp it, hauled or paid out."""

from __future__ import annotations

from tests.scenes.sketch import Sketch

ELEMENT = 0.25  # m; a bend of a metre takes it
GAP = 4 * ELEMENT  # m of free span between two devices


def route(seed: int) -> str:
    """The netlist of a random route."""
    s = Sketch("route", seed)
    wound = s.maybe(0.4)
    stations, end, driven = _stations(s, wound)
    length = end + float(s.number(1, 3)) + (3.0 if wound else 0.0)
    tension = float(s.number(100, 800))
    _line(s, length, tension, start=-3.0 if wound else 0.0)
    s.add("route", "Route", stations=f"[{', '.join(stations)}]")
    s.join("line.path", "route.path")
    _ends(s, tension, wound=wound, driven=driven)
    method = s.pick("hold", "hold", "hold", "binding", "tanh")
    friction = f"method: {method}" + ("" if method == "hold" else f", creep: {s.number(0.02, 0.15)} mm/s")
    engine, accuracy = s.pick("rodas", "stepping", "auto"), s.pick("1e-3", "1e-4")
    run = f"stop: {s.number(0.4, 1)} s, accuracy: {accuracy}, engine: {engine}"
    return s.text(friction=friction, run=run, every="20 ms")


def _stations(s: Sketch, wound: bool) -> tuple[list[str], float, bool]:
    """Devices as text, where the last one ends [m], and whether belts among them drive the line."""
    stations, at, driven = (["{name: drum, type: Winch, radius: 0.65 m}"] if wound else []), 1.5, False
    for k in range(s.pick(1, 2, 2, 3)):
        kind = s.pick("Bend", "Bend", "Pulley", "Tube", "Guide", "Deployer", "Tensiometer")
        if kind == "Deployer" and driven:
            kind = "Bend"
        driven |= kind == "Deployer"
        text, length = _device(s, kind)
        stations.append(f"{{name: {kind.lower()}_{'abcd'[k]}, type: {kind}, start: {at:.4g} m, {text}}}")
        at = round(at + length + GAP, 3)
    return stations, at, driven


def _device(s: Sketch, kind: str) -> tuple[str, float]:
    """Parameters of a device beside its place, and its length along the route [m]."""
    friction = f"friction: {s.curve()}"
    if kind in ("Bend", "Pulley"):
        angle, radius = float(s.number(30, 120)), float(s.number(1, 2))
        return f"angle: {angle} deg, radius: {radius} m, {friction}", angle / 57.29 * radius
    length = float(s.number(1, 2))
    if kind == "Tube":
        return f"length: {length} m, radius: {s.number(1, 3)} m, {friction}", length
    if kind == "Deployer":
        return f"length: {length} m, friction: {s.number(0.4, 0.8)}, clamp: {s.number(500, 3000)} N/m", length
    if kind == "Tensiometer":
        return "length: 0.5 m", 0.5
    return f"length: {length} m, {friction}", length


def _line(s: Sketch, length: float, tension: float, start: float) -> None:
    """A rope, a cable that can push, or an array of hose and core."""
    laid = {"length": f"{length:.4g} m", "element": f"{ELEMENT} m", "start": f"{start} m", "tension": f"{tension} N"}
    if s.maybe(0.2):
        laid["weight"] = f"{s.number(2, 20)} N/m"
    damping = s.number(0.05, 0.5)
    if s.maybe(0.4):
        hose = f"mass: {s.number(1, 3)} kg/m, stiffness: {s.number(5, 20)} kN, damping_ratio: {damping}"
        core = f"mass: {s.number(2, 6)} kg/m, stiffness: {s.number(100, 600)} kN, damping_ratio: {damping}"
        s.add("line", "ArrayModule", **laid, bulkhead_friction=s.curve(), hose=f"{{{hose}}}", core=f"{{{core}}}")
        return
    s.add("line", "Cable", **laid, mass=f"{s.number(0.3, 6)} kg/m", stiffness=f"{s.number(50, 600)} kN",
          damping_ratio=damping, compression=s.pick("none", "carried"))  # fmt: skip


def _ends(s: Sketch, tension: float, *, wound: bool, driven: bool) -> None:
    """What drives the line, and what holds it at its ends."""
    inboard = "route.drum.rim" if wound else "line.inboard"
    speed = f"{s.pick('', '-')}{s.number(0.05, 0.5)}"
    motion = s.pick(f"{{ramp: {{to: {speed} m/s, over: {s.number(0.1, 0.4)} s}}}}",
                    f"{{sine: {{amplitude: {speed} m/s, frequency: {s.number(0.5, 2)} Hz}}}}")  # fmt: skip
    s.add("drive", "MotionSource", velocity=motion)
    if driven:
        belts = next(part for part in s.parts["route"].split("name: ")[1:] if part.startswith("deployer")).split(",")[0]
        s.join(f"route.{belts}.belt", "drive.flange")
        s.add("hold_back", "ForceSource", force=f"-{tension} N")
        s.join(inboard, "hold_back.flange")
    else:
        s.join(inboard, "drive.flange")
    s.add("tow", "ForceSource", force=f"{tension} N")
    s.join("line.outboard", "tow.flange")
