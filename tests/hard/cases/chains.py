"""Chains of held contacts, nodes without mass, contacts side by side."""

from __future__ import annotations

import numpy as np

from tests.hard.play import CREEP, PRESLIDING, Broken, Play
from tests.hard.registry import case

SIZES = {"10": {"blocks": 10}, "100": {"blocks": 100}, "300": {"blocks": 300}}


def held_row(blocks: int, load: str, friction: float, stop: float) -> str:
    """Blocks of 10 g on the floor with springs between, pulled apart at both ends by the same load."""
    parts = ["  floor: {type: Ground}", f"  right: {{type: ForceSource, force: {load}}}"]
    joins, floor = [], ["floor.flange"]
    for i in range(blocks):
        parts += [f"  m{i}: {{type: Mass, mass: 10 g, position: 0 m, velocity: 0 m/s}}",
                  f"  c{i}: {{type: Contact, normal_force: {friction!r} N, curve: 1.0}}"]  # fmt: skip
        here = [f"m{i}.flange", f"c{i}.b"]
        floor.append(f"c{i}.a")
        if i:
            parts.append(f"  s{i}: {{type: SpringDamper, stiffness: 1e4 N/m, damping: 20 N*s/m}}")
            here.append(f"s{i}.b")
        if i < blocks - 1:
            here.append(f"s{i + 1}.a")
        if i == blocks - 1:
            here.append("right.flange")
        if i == 0:
            here.append("left.flange")
        joins.append(f"  - [{', '.join(here)}]")
    opposite = load.replace("to: ", "to: -")
    parts.append(f"  left: {{type: ForceSource, force: {opposite}}}")
    joins.append(f"  - [{', '.join(floor)}]")
    tail = ["friction: {method: hold}", f"run: {{stop: {stop!r} s, accuracy: 1e-6}}",
            'record: {signals: ["m*.x", "m*.v", "s*.tension"], every: 0.1 s}']  # fmt: skip
    return "\n".join(["components:", *parts, "connections:", *joins, *tail])


@case(SIZES, cost={"100": "fair", "300": "fair"}, budget=120.0)
def row_of_blocks_pulled_from_both_ends(play: Play, blocks: int) -> None:
    """A row of blocks on the floor is pulled apart slowly; fronts of slipping run in from both ends and stop short.

    Oracle: monotone loading without inertia: the tension falls by one friction per block, T_k = max(F - k, 0) N from
    either end; left and right are mirror images; the middle never moves.
    """
    top = min(blocks / 2 - 1.5, 8.5)
    result = play.run(held_row(blocks, f"{{ramp: {{to: {top!r} N, over: 10 s}}}}", 1.0, 12.0))
    x = np.array([result[f"m{i}.x"] for i in range(blocks)])
    scale = top**2 / 2 / 1e4
    play.near("sum of mirror images", x + x[::-1], 0.0, play.by(1e-3, 2e-2, 2e-2) * scale)
    tension = np.array([result[f"s{i}.tension"][-1] for i in range(1, blocks)])
    exact = np.maximum(top - np.arange(1, blocks), 0.0)
    exact = np.maximum(exact, exact[::-1])
    # The last block of a front is moving when it stops, 0.7 mm/s: inertia has v sqrt(k m) = 7 mN.
    play.near("tension", tension, exact, play.by(0.02, 0.25, 0.5))
    middle = np.abs(x[blocks // 2])
    play.check(middle.max() <= play.by(1e-9, 12 * CREEP, PRESLIDING), f"the middle moved by {middle.max():.2g} m")


@case(SIZES, cost={"100": "fair", "300": "fair"}, budget=120.0)
def contacts_in_a_row_pulled_from_both_ends(play: Play, blocks: int) -> None:
    """Bodies on one another, block on block, a contact between neighbours; the ends are pulled apart with equal force.

    Oracle: every contact carries the same force. It grows to 4 N; only the one in the middle, of 3 N, lets go, at 3 s;
    from there on both halves go apart as one body each, F - 3 N over their mass.
    """
    weak = blocks // 2
    parts, joins = [], []
    for i in range(blocks):
        parts.append(f"  m{i}: {{type: Mass, mass: 1 kg, position: 0 m, velocity: 0 m/s}}")
        here = [f"m{i}.flange"]
        if i:
            strength = 3.0 if i == weak else 4.5
            parts.append(f"  c{i}: {{type: Contact, normal_force: {strength} N, curve: 1.0}}")
            here.append(f"c{i}.b")
        if i < blocks - 1:
            here.append(f"c{i + 1}.a")
        if i in (0, blocks - 1):
            here.append("left.flange" if i == 0 else "right.flange")
        joins.append(f"  - [{', '.join(here)}]")
    parts += ["  left: {type: ForceSource, force: {ramp: {to: -4 N, over: 4 s}}}",
              "  right: {type: ForceSource, force: {ramp: {to: 4 N, over: 4 s}}}"]  # fmt: skip
    tail = ["friction: {method: hold}", "run: {stop: 5 s, accuracy: 1e-6}",
            f"record: {{signals: [\"m*.x\", \"m*.v\", c{weak}.friction], every: 0.1 s}}"]  # fmt: skip
    result = play.run("\n".join(["components:", *parts, "connections:", *joins, *tail]))
    t = result.t
    late = np.clip(t - 3, 0, 1)
    apart = late**3 / 6 + np.maximum(t - 4, 0) * 0.5 + np.maximum(t - 4, 0) ** 2 / 2
    right = apart / (blocks - weak)
    # Creep adds up along a chain of contacts that all carry the force: 0.8 creep a contact.
    within = play.by(1e-6, 5 * CREEP * blocks, 60 * PRESLIDING * blocks)
    play.near("position of the right end", result[f"m{blocks - 1}.x"], right, within)
    momentum = sum(result[f"m{i}.v"] for i in range(blocks))
    play.near("momentum", momentum, 0.0, 1e-6 * blocks)
    if play.treatment == "hold":
        inner = result["m1.x"] - result["m0.x"]
        play.near("slip of a contact that holds", inner, 0.0, 1e-9)


@case({"held": {"speed": 1.0}, "slipping": {"speed": 4.0}})
def node_without_mass(play: Play, speed: float) -> None:
    """A contact on a node without mass, dragged through a damper of 2 N s/m by a drive; the contact holds 5 N.

    Oracle: the node stands still, or goes with the drive less 5 N over the damping.
    """
    text = f"""
    components:
      floor: {{type: Ground}}
      pad: {{type: Contact, normal_force: 10 N, curve: 0.5}}
      link: {{type: Damper, damping: 2 N*s/m}}
      pull: {{type: MotionSource, velocity: {{ramp: {{to: {speed!r} m/s, over: 1 s}}}}}}
    connections: [[floor.flange, pad.a], [pad.b, link.a], [link.b, pull.flange]]
    friction: {{method: hold}}
    run: {{stop: 3 s, accuracy: 1e-6}}
    record: {{every: 10 ms}}
    """
    result = play.run(text)
    drive = np.clip(result.t, 0, 1) * speed
    exact = np.minimum(2 * drive, 5.0)
    play.near("force of the damper", result["link.tension"], exact, play.by(1e-6, 1e-4, 5e-2))
    play.near("slip", result["pad.slip"], np.maximum(drive - 2.5, 0.0), play.by(1e-6, 5 * CREEP, 3e-2))


@case()
def chain_of_nodes_without_mass(play: Play) -> None:
    """Ten nodes without mass, a contact of 1 N on each and dampers of 1 N s/m between, dragged at one end.

    Oracle: force balance at every instant: the nodes slip from the driven end on, the tension falls by 1 N a node, and
    the speed of slipping node k is the drive less the sum of the tensions before it.
    """
    parts, joins, floor = ["  floor: {type: Ground}"], [], ["floor.flange"]
    for i in range(10):
        parts += [
            f"  c{i}: {{type: Contact, normal_force: 1 N, curve: 1.0}}",
            f"  d{i}: {{type: Damper, damping: 1 N*s/m}}",
        ]
        floor.append(f"c{i}.a")
        joins.append(f"  - [c{i}.b, d{i}.a{', d' + str(i - 1) + '.b' if i else ''}]")
    parts.append("  pull: {type: MotionSource, velocity: {ramp: {to: 7 m/s, over: 7 s}}}")
    joins += ["  - [d9.b, pull.flange]", f"  - [{', '.join(floor)}]"]
    tail = ["friction: {method: hold}", "run: {stop: 8 s, accuracy: 1e-6}", "record: {every: 50 ms}"]
    result = play.run("\n".join(["components:", *parts, "connections:", *joins, *tail]))
    drive = float(np.clip(result.t[-1], 0, 7))
    # n nodes slip: tensions T, T-1, ..., T-n >= ... ; node 10-j has speed V - (T + (T-1) + ... j terms), all >= 0.
    for n in range(10):
        # With n slipping and the next held: V = T + (T-1) + ... + (T-n), T-n the tension on the held one, at most 1.
        top = (drive + n * (n + 1) / 2) / (n + 1)
        if top - n <= 1.0:
            break
    tensions = np.array([max(top - j, 0.0) if j <= n else 0.0 for j in range(10)])
    measured = np.array([result[f"d{9 - j}.tension"][-1] for j in range(10)])
    play.near("tension of the dampers", measured, tensions, play.by(1e-6, 1e-3, 5e-2))


DRAGGED = """
    components:
      floor: {type: Ground}
      pad: {type: Contact, normal_force: 10 N, curve: 0.5}
      link: {type: Spring, stiffness: 100 N/m}
      pull: {type: MotionSource, velocity: 0.1 m/s}
    connections: [[floor.flange, pad.a], [pad.b, link.a], [link.b, pull.flange]]
    friction: {method: hold}
    run: {stop: 3 s, accuracy: 1e-6}
    record: {every: 10 ms}
"""


@case(treatments=("hold", "binding"))
def node_without_mass_on_a_spring(play: Play) -> None:
    """A node without mass or damping between a spring and a contact, dragged: the balance says where it is.

    Oracle: the spring carries what holds up to 5 N, at 0.5 s, and 5 N from there on; the node follows at the speed of
    the drive. `stepping` refuses exact hold, and names the contact and the engine to take.
    """
    if refused(play, DRAGGED, "pad"):
        return
    result = play.run(DRAGGED)
    play.near("force of the spring", result["link.tension"], np.minimum(10 * result.t, 5.0), play.by(1e-6, 2e-3))
    late = result.t > 0.51
    play.near("slip", result["pad.slip"][late], 0.1, play.by(1e-6, 1e-4))


@case(treatments=("lugre",))
def node_without_mass_that_nothing_determines(play: Play) -> None:
    """The same with bristles: nothing gives the speed of the node but how their bend falls behind it.

    Oracle: the spring carries 5 N while it is dragged.
    """
    result = play.run(DRAGGED)
    play.near("force of the spring", result["link.tension"], np.minimum(10 * result.t, 5.0), 5e-2)


def refused(play: Play, text: str, part: str) -> bool:
    """True where `stepping` says that it does not take exact hold of nodes without mass, as it must."""
    if (play.engine, play.treatment) != ("stepping", "hold"):
        return False
    try:
        play.ended(text)
    except Broken as broken:
        named = part in broken.reason and "rodas" in broken.reason
        play.check(named, f"refused without the way out: {broken.reason}")
        return True
    play.check(False, "it was not refused")
    return True


NAMES = {"as written": {"body": "body", "pad": "pad"}, "renamed and reordered": {"body": "zz", "pad": "a"}}


@case(NAMES, treatments=("hold", "binding"))
def spring_and_contact_in_series_beside_a_block(play: Play, body: str, pad: str) -> None:
    """A block of 1 kg swings on 300 N/m, and on 500 N/m that a contact of 2 N holds at its other end.

    Oracle: both springs up to 4 mm, in a part of a swing at sqrt(800) 1/s; then the one spring and 2 N, up to the
    place where 1 m/s is spent.
    """
    parts = [f"  {body}: {{type: Mass, mass: 1 kg, velocity: 1 m/s}}",
             "  floor: {type: Ground}", "  main: {type: Spring, stiffness: 300 N/m}",
             "  link: {type: Spring, stiffness: 500 N/m}",
             f"  {pad}: {{type: Contact, normal_force: 4 N, curve: 0.5}}"]  # fmt: skip
    joins = f"connections: [[{pad}.b, link.b], [{body}.flange, link.a, main.b], [floor.flange, {pad}.a, main.a]]"
    tail = ["friction: {method: hold}", "run: {stop: 0.4 s, accuracy: 1e-7}"]
    text = "\n".join(["components:", *(parts if pad == "pad" else parts[::-1]), joins, *tail])
    if refused(play, text, pad):
        return
    result = play.run(text)
    at = 0.004  # 300 x^2 + 2 * 2 N (x - at) + 500 at^2 = m v^2
    turn = (-2 + (4 + 300 * (1.0 - 500 * at**2 + 4 * at)) ** 0.5) / 300
    position = result[f"{body}.x"]
    play.near("first turn", position.max(), turn, play.by(1e-6, 2e-5))
    slid = np.flatnonzero(np.abs(result[f"{pad}.slip"]) > 1e-3)
    begins = float(np.arcsin(at * 800**0.5) / 800**0.5)  # x = sin(w t)/w with both springs, up to 4 mm
    play.near("begin of sliding", result.t[slid[0]], begins, play.by(1e-3, 1e-3))


SIDE = {"3": {"pads": 3}, "30": {"pads": 30}, "300": {"pads": 300}}


@case(SIDE, cost={"300": "fair"}, budget=120.0)
def pads_side_by_side_on_one_block(play: Play, pads: int) -> None:
    """One block on many equal pads: more contacts than the motion can tell apart.

    Oracle: each carries an equal share; together they hold 5 N and let go at once at 1 s under a load of 5 N/s; then
    m v' = 5 t - 5 N.
    """
    parts = ["  floor: {type: Ground}", "  block: {type: Mass, mass: 1 kg, position: 0 m, velocity: 0 m/s}",
             "  pull: {type: ForceSource, force: {drift: {rate: 5 N/s}}}"]  # fmt: skip
    parts += [f"  p{i}: {{type: Contact, normal_force: {10 / pads!r} N, curve: 0.5}}" for i in range(pads)]
    floor = ", ".join(["floor.flange", *(f"p{i}.a" for i in range(pads))])
    block = ", ".join(["block.flange", "pull.flange", *(f"p{i}.b" for i in range(pads))])
    tail = ["friction: {method: hold}", "run: {stop: 2 s, accuracy: 1e-6}",
            'record: {signals: [block.x, "p*.friction"], every: 10 ms}']  # fmt: skip
    result = play.run("\n".join(["components:", *parts, "connections:", f"  - [{floor}]", f"  - [{block}]", *tail]))
    late = np.maximum(result.t - 1, 0)
    ahead = (6 * PRESLIDING / 5) ** (1 / 3) * 2.5
    play.near("position", result["block.x"], 5 * late**3 / 6, play.by(1e-5, 3e-5, ahead))
    forces = result.columns([f"p{i}.friction" for i in range(pads)])
    play.near("share of a pad", forces * pads / 5, forces[:, :1] * pads / 5, play.by(1e-6, 1e-6, 1e-6))
