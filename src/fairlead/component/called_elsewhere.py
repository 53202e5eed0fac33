"""What other tools, and plain speech, call the bundled parts: for "Did you mean ...?" where letters do not tell."""

from __future__ import annotations

import re
from collections.abc import Mapping

from fairlead.errors import did_you_mean

CALLED = {
    "AccelerationActuator": "accelerate accelerationsource",
    "Cable": "rope wire line",
    "Cam": "camfollower",
    "CheckValve": "nonreturnvalve",
    "Contact": "friction dryfriction coulombfriction stickslip frictioncontact rubbing",
    "Crank": "crankslider slidercrank crankandslider",
    "Cylinder": "hydrauliccylinder doubleactingcylinder",
    "DcMotor": "motor electricmotor dcpermanentmagnet dcmachine",
    "ElasticGap": "elastogap gap",
    "EndStop": "hardstop translationalhardstop bumpstop",
    "FilteredDerivative": "derivative differentiator",
    "FixedPump": "pump hydraulicpump",
    "ForceSensor": "loadcell",
    "ForceSource": "force constantforce gravity weight",
    "Gear": "idealgear gearratio",
    "Ground": "fixed wall mechanicaltranslationalreference frame",
    "Housing": "mechanicalrotationalreference fixedshaft",
    "Inertia": "flywheel rotor disc disk",
    "Limiter": "saturation saturate",
    "Mass": "body block pointmass slidingmass",
    "MassWithStops": "masswithstopandfriction",
    "MotionSource": "motion prescribedmotion idealtranslationalvelocitysource velocitysource",
    "OneWayClutch": "freewheel unidirectionalclutch sprag overrunningclutch",
    "PiController": "pi limpid",
    "Rack": "rackandpinion idealrollingwheel wheelandaxle idealgearr2t",
    "Resistor": "resistance",
    "RotationSensor": "encoder tachometer speedsensor anglesensor",
    "RotationalStop": "rotationalhardstop",
    "Route": "pulley bend sheave winch deployer tensioner",
    "ShaftFriction": "bearingfriction rotationalfriction",
    "SignalDelay": "delay transportdelay deadtime",
    "SignalGain": "gain amplifier",
    "SignalLag": "firstorder lag lowpass pt1",
    "SignalProduct": "product multiply",
    "SignalSize": "abs absolute",
    "SignalSource": "constant step sine ramp pulse pulses signal setpoint waveform",
    "SignalSwitch": "switch",
    "SignalTable": "lookup lookuptable table combitable1d",
    "SlideFriction": "translationalfriction supportfriction guidefriction",
    "SpringDamper": "kelvinvoigt massspringdamper",
    "Sum": "add add2 add3 feedback subtract difference",
    "TorqueSource": "torque constanttorque",
    "TorsionSpring": "rotationalspring torsionalspring shaft",
}  # fmt: skip
"""Part -> words that are no part here, in small letters without what is between them."""
MEANT = {word: name for name, words in CALLED.items() for word in words.split()}


def similar_type(written: str, types: Mapping[str, object]) -> str:
    """The sentence "Did you mean ...?" for a type that there is not, or nothing."""
    name = MEANT.get(re.sub(r"[\W_]", "", written).lower())
    return f"Did you mean {name}?" if name in types else did_you_mean(written, types)
