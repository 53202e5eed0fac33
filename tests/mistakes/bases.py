"""Four small netlists in which the mistakes are made: each is right as it stands."""

PULLER = """\
schema: 1
name: puller
parameters: {mu: 0.3, speed: 50 mm/s}
components:
  floor: {type: Ground}
  block: {type: Mass, mass: 2 kg}
  pad: {type: Contact, normal_force: 20 N, curve: "{mu}"}
  spring: {type: Spring, stiffness: 400 N/m}
  hand: {type: MotionSource, velocity: {ramp: {to: "{speed}", over: 0.5 s}}}
connections:
  - [floor.flange, pad.a]
  - [pad.b, block.flange, spring.a]
  - [spring.b, hand.flange]
initial: {block.x: 0 mm}
run: {stop: 2 s, accuracy: 1e-4}
record: {signals: [block.*, pad.slip, spring.tension], every: 10 ms}
limits: {spring.tension: {below: 20 N}}
"""

HAUL = """\
schema: 1
name: haul
parameters: {mu: 0.35}
components:
  rope: {type: Cable, length: 12 m, element: 0.25 m, start: -6 m, tension: 300 N, mass: 0.8 kg/m, stiffness: 500 kN}
  route:
    type: Route
    stations:
      - {type: Winch, radius: 0.4 m}
      - {type: Straight, length: 1 m}
      - {type: Bend, angle: 90 deg, radius: 1 m, friction: "{mu}"}
      - {name: wheel, type: Pulley, start: 4 m, angle: 45 deg, radius: 0.8 m, friction: 0.5}
  drive: {type: MotionSource, velocity: {ramp: {to: -0.3 m/s, over: 1 s}}}
  load: {type: ForceSource, force: 300 N}
connections:
  - [rope.path, route.path]
  - [drive.flange, route.winch.rim]
  - [load.flange, rope.outboard]
run: {stop: 5 s, accuracy: 1e-3}
record:
  every: 20 ms
  signals: ["rope.line[*].tension", "rope.node[*].x", drive.force]
  plots:
    - {title: Tension, signals: ["rope.line[*].tension"], file: tension.png}
limits: {"rope.line[*].tension": {below: 800 N}}
"""

SERVO = """\
schema: 1
name: servo
parameters: {gain: 20, step: 0.2}
components:
  wanted: {type: SignalSource, value: {step: {to: "{step}", at: 0.1 s}}}
  control: {type: PiController, gain: "{gain}", integral_time: 0.5 s, low: -10, high: 10, period: 10 ms}
  motor: {type: PmDrive, constant: 0.5 N*m/A, most_current: 20 A, inertia: 0.01 kg*m^2}
  screw: {type: Rack, radius: 20 mm}
  table: {type: Mass, mass: 5 kg}
  guide: {type: Contact, normal_force: 50 N, curve: {curve: stribeck, stiction: 0.2, coulomb: 0.15, velocity: 5 mm/s}}
  bed: {type: Ground}
  eye: {type: MotionSensor}
connections:
  - [motor.shaft, screw.pinion]
  - [screw.rack, table.flange, guide.b, eye.flange]
  - [bed.flange, guide.a]
  - [wanted.signal, control.reference]
  - [eye.x, control.measured]
  - [control.command, motor.command]
run: {stop: 2 s}
record: {signals: [eye.x, control.command, motor.torque], every: 5 ms}
"""

DRILL = """\
schema: 1
name: drill
components:
  press: {type: SignalSource, value: {ramp: {to: 2000, over: 1 s}}}
  engine: {type: TorqueSource, torque: 40 N*m}
  flywheel: {type: Inertia, moment: 2 kg*m^2}
  clutch: {type: Clutch, radius: 100 mm, curve: 0.4}
  table: {type: Inertia, moment: 5 kg*m^2}
  string: {type: TorsionSpring, stiffness: 500 N*m/rad, damping: 3 N*m*s/rad}
  bit: {type: Inertia, moment: 1 kg*m^2, angle: 0 rad, speed: 0 rad/s}
  rock: {type: Brake, radius: 150 mm, normal_force: 300 N, curve: {curve: coulomb, stiction: 0.8, coulomb: 0.5}}
connections:
  - [engine.shaft, flywheel.shaft, clutch.a]
  - [press.signal, clutch.normal]
  - [clutch.b, table.shaft, string.a]
  - [string.b, bit.shaft, rock.shaft]
friction: {method: hold}
run: {stop: 10 s}
record: {signals: [bit.speed, table.speed, string.torque]}
"""

BASES = {"puller": PULLER, "haul": HAUL, "servo": SERVO, "drill": DRILL}
