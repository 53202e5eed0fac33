"""What `fairlead new` writes: small files that pass their checks as they are, each with what to change in it."""
# ruff: noqa: E501 - names of the user's take the place of longer ones in braces

from dataclasses import dataclass

FRICTION = '''"""Friction law {word}, a method of every contact: fairlead friction 0.4 --method {word} --library {word}.py"""

from fairlead.component import Law, Parameter, Zones, guard, sqrt, tanh, zone
from fairlead.components.friction.contact import Contact


class {kind}(Contact):
    """T = N mu(|v|) tanh(v/creep): make it yours."""

    creep = Parameter("m/s", "Speed over which the sign changes.", default=1e-4, above=0)
    zones = Zones("on", "off")  # what happens in zone "off", and what leads there, every contact knows

    @zone("on")
    def on(p, a, b, grip, pace):
        """Friction against the slip v; `grip` is the normal force and `pace` is 1, but for load and warmth."""
        v = b.v - a.v
        friction = grip * p.curve.coefficient(pace * sqrt(v**2 + p.creep**2)) * tanh(v / p.creep)
        return Law(a=-friction, b=+friction, slip=v, friction=friction, dissipated=friction * v,
                   creep_rate=v * (1 - tanh(v / p.creep) ** 8))  # slow slip is creep

    @guard("off", to="on", unit="N")
    def lands(p, normal):
        """Pressed again."""
        return normal - 2 * p.lift
'''

CURVE = '''"""Friction curve {word}: fairlead friction "{{curve: {word}, level: 0.3, growth: 0.1 s/m}}" --library {word}.py"""

from fairlead.component import Parameter
from fairlead.components.friction.curve import Curve


class {kind}(Curve):
    """mu(v) = level + growth v: make it yours. `stiction` or breakaway(p) say what it takes to begin, if it is more."""

    word = "{word}"
    level = Parameter("1", "Coefficient at rest.", least=0, usual=(0, 2))
    growth = Parameter("s/m", "Growth with speed.", default=0.0, least=0)

    def coefficient(p, v):
        """Friction over normal force at slip speed v >= 0 [m/s]."""
        return p.level + p.growth * v
'''

COMPONENT = '''"""Component {kind}: fairlead check {word}.yaml --library {word}.py, and python {word}.py for its contract."""

from fairlead.component import Component, Law, Output, Parameter, Translational


class {kind}(Component):
    """A spring with a damper beside it: make it yours."""

    a, b = Translational("one end"), Translational("the other end")
    stiffness = Parameter("N/m", "Tension per stretch.", above=0)
    damping = Parameter("N*s/m", "Tension per speed.", default=0.0, least=0)
    tension = Output("N", "Tension, positive when stretched.")

    def law(p, a, b):
        """What the ports take in: the force that acts on the component there."""
        stretch, speed = b.x - a.x, b.v - a.v
        tension = p.stiffness * stretch + p.damping * speed
        return Law(a=-tension, b=+tension, tension=tension,
                   stored=p.stiffness * stretch**2 / 2, dissipated=p.damping * speed**2)


if __name__ == "__main__":
    from fairlead.testing import contract

    contract({kind})
'''

COMPONENT_SCENE = """\
# A mass on {kind}: fairlead run {word}.yaml --library {word}.py
schema: 1
components:
  wall: {{type: Ground}}
  part: {{type: {kind}, stiffness: 100 N/m, damping: 1 N*s/m}}
  block: {{type: Mass, mass: 1 kg, velocity: 0.5 m/s}}
connections:
  - [wall.flange, part.a]
  - [part.b, block.flange]
run: {{stop: 5 s}}
record: {{signals: [block.x, part.tension], plots: [{{signals: [block.x]}}]}}
"""

CONTROLLER = '''"""Controller {kind}, in plain Python: fairlead run {word}.yaml --library {word}.py"""

from fairlead.component import Controller, Input, Output, Parameter


class {kind}(Controller):
    """A force in proportion to the error, with a limit: make it yours. It may do what Python can."""

    reference = Input("m", "Position wanted.", signed=True)
    position = Input("m", "Position.", signed=True)
    speed = Input("m/s", "Speed.", default=0.0, signed=True)
    gain = Parameter("N/m", "Force per error.", above=0)
    damping = Parameter("N*s/m", "Force per speed.", default=0.0, least=0)
    most = Parameter("N", "Largest force.", default=100.0, above=0)
    force = Output("N", "Force asked for; held until the next sample.")

    def sample(self, t, reference, position, speed):
        """Called every `period` with numbers in SI; returns the outputs by name."""
        force = self.gain * (reference - position) - self.damping * speed
        return {{"force": max(-self.most, min(self.most, force))}}
'''

CONTROLLER_SCENE = """\
# A block moved to where it is wanted, against friction: fairlead run {word}.yaml --library {word}.py
schema: 1
components:
  wanted: {{type: SignalSource, value: {{step: {{to: 0.1, at: 0.5 s}}}}}}
  control: {{type: {kind}, period: 5 ms, gain: 200 N/m, damping: 20 N*s/m}}
  drive: {{type: ForceActuator}}
  block: {{type: Mass, mass: 1 kg}}
  eye: {{type: MotionSensor}}
  floor: {{type: Ground}}
  pad: {{type: Contact, normal_force: 10 N, curve: 0.1}}
connections:
  - [floor.flange, pad.a]
  - [pad.b, block.flange, eye.flange, drive.flange]
  - [wanted.signal, control.reference]
  - [eye.x, control.position]
  - [eye.v, control.speed]
  - [control.force, drive.force]
run: {{stop: 3 s}}
record: {{signals: [block.x, control.force], plots: [{{signals: [block.x]}}, {{signals: [control.force]}}]}}
"""

MODEL = """\
# A block pulled over a floor through a spring: fairlead run {word}.yaml --report
schema: 1
description: A block that sticks and slips.
parameters: {{mu: 0.3, speed: 20 mm/s}}   # for expressions below, and --set mu=0.4
components:
  floor: {{type: Ground}}
  block: {{type: Mass, mass: 2 kg}}
  pad: {{type: Contact, normal_force: "{{2*9.81}} N", curve: {{curve: stribeck, stiction: "{{1.3*mu}}", coulomb: "{{mu}}", velocity: 10 mm/s}}}}
  spring: {{type: Spring, stiffness: 400 N/m}}
  hand: {{type: MotionSource, velocity: "{{speed}}"}}
connections:
  - [floor.flange, pad.a]
  - [pad.b, block.flange, spring.a]
  - [spring.b, hand.flange]
run: {{stop: 5 s}}
record:
  signals: [block.x, pad.slip, spring.tension]
  plots: [{{signals: [block.x]}}, {{signals: [spring.tension]}}]
limits: {{spring.tension: {{below: 20 N}}}}
"""

ROUTE = """\
# A line hauled round two bends and a pulley: fairlead statics {word}.yaml, then fairlead run {word}.yaml --report
schema: 1
description: A line on a route.
parameters: {{mu: 0.2, speed: 0.2 m/s, load: 500 N}}
components:
  line: {{type: Cable, length: 12 m, element: 0.15 m, mass: 1 kg/m, stiffness: 500 kN, tension: "{{load}}"}}
  route:
    type: Route
    stations:   # in order along the line; each begins where it is told, else where the one before ends
      - {{type: Bend, name: first, start: 2 m, angle: 45 deg, radius: 1 m, friction: "{{mu}}"}}
      - {{type: Bend, name: second, start: 5 m, angle: 90 deg, radius: 1 m, friction: "{{mu}}"}}
      - {{type: Pulley, name: wheel, start: 9 m, angle: 90 deg, radius: 0.5 m, friction: "{{mu}}"}}
  haul: {{type: MotionSource, velocity: {{ramp: {{to: "{{-speed}}", over: 1 s}}}}}}
  tow: {{type: ForceSource, force: "{{load}}"}}
connections:
  - [haul.flange, line.inboard]
  - [tow.flange, line.outboard]
  - [line.path, route.path]
run: {{stop: 6 s, accuracy: 1e-3}}
record:
  every: 20 ms
  signals: ["line.line[*].tension", "line.node[*].x", haul.force]
  plots: [{{title: Tension, signals: ["line.line[*].tension"]}}]
limits: {{"line.line[*].tension": {{below: 2 kN}}}}
"""


@dataclass(frozen=True)
class Beginning:
    """Files by the end of their name, and what to do with them first."""

    files: dict[str, str]
    then: str


BEGINNINGS = {
    "friction": Beginning(
        {"py": FRICTION}, "in a netlist: method: {word}, and run it with --library {word}.py"
    ),
    "curve": Beginning({"py": CURVE}, "in a netlist: curve: {{curve: {word}, level: 0.3}}, with --library {word}.py"),
    "component": Beginning(
        {"py": COMPONENT, "yaml": COMPONENT_SCENE}, "fairlead run {word}.yaml --library {word}.py; python {word}.py"
    ),
    "controller": Beginning({"py": CONTROLLER, "yaml": CONTROLLER_SCENE}, "fairlead run {word}.yaml --library {word}.py"),
    "model": Beginning({"yaml": MODEL}, "fairlead run {word}.yaml --report"),
    "route": Beginning({"yaml": ROUTE}, "fairlead statics {word}.yaml; fairlead run {word}.yaml --report"),
}
