"""Mistakes that are not answered well yet, by name, with what is wrong with the answer. What is mended leaves."""

_EXPRESSION = "told by line and column alone: neither the component nor the parameter is named"
_UNUSUAL = "nothing warns of a value far outside what such a parameter ever is"
_RAW = "an exception of Python from within, without the argument or what is allowed"

_NETLIST = {
    "an expression has a misspelt parameter": _EXPRESSION,
    "an expression is not in quotes": _EXPRESSION,
    "an expression is given a unit twice": _EXPRESSION,
    "an expression uses a function that there is not": _EXPRESSION,
    "an expression divides by zero": _EXPRESSION + ", and there is no way out",
    "a decimal comma in a map of one line": "`5 kg` is taken for a parameter; nobody speaks of a comma",
    "a decimal comma in a scene parameter": "`35` is taken for a name; nobody speaks of a comma or of mu",
    "a bracket is not closed": "the line where the next key stands, a way out about colons; the bracket is not named",
    "a component is indented by one space less": "a way out about colons; nobody speaks of indentation",
    "a colon is missing": "`floor {type` is taken for a name, to be written floor_type",
    "a space is missing behind a colon": "`mass:2 kg` is taken for a misspelt mass; nobody speaks of a space",
    "a mass is text": "text in quotes passes for a number",
    "a friction of 35 for 35 per cent": _UNUSUAL,
    "a clutch of a hundred metres": _UNUSUAL,
    "a line is stretched by more than half of its length": _UNUSUAL,
    "a controller's period is longer than the run": "nothing warns of a time that lies outside of the run",
    "a step comes after the end of the run": "nothing warns of a time that lies outside of the run",
    "a shaft is joined with a rack": "an inner port is named (motor.rotor.shaft), which the user never wrote",
    "an output is joined with an output": "inner names (motor.limit.torque); the input motor.command is not proposed",
}

_COMMAND = {
    "a start value of a misspelt mass": "the name is cut at its dot: initial.blok",
    "a station's name is misspelt": "the names of the stations are not told",
    "compare varies a misspelt parameter": "method is not among what is proposed",
    "compare takes the error from a misspelt signal": "runs, and takes the error of no signal",
}

_COMPONENT = {
    "a unit does not exist": "no unit is proposed, as in a netlist",
    "a default lies outside of its own range": "the netlist is blamed, with `a map of 1`; the class is at fault",
    "the default of a choice is none of its options": "passes",
    "a law reads a variable that its port has not": "an AttributeError of _PortReader; what a port has is not told",
    "a law forgets to return": "`returns 1 flows for 2 ports`; that None came back is not told",
    "a law adds a force and a speed": "passes; the units of a law are not looked at",
    "an output is declared and never told": "passes, even when it is recorded",
    "a state has no rate": "`leaves out ['warm']`; that it wants a rate, and how to write it, is not told",
    "an inertia is text": _RAW,
    "a tie has three members and not four": _RAW,
    "a start is a number and not a pair": "passes, also in a run",
    "a composite joins a child that it has not": _RAW,
    "a curve has no coefficient": "a TraceError in hold.py about stiction; the class and the method are not named",
}

_PYTHON = {
    "a new value with a decimal comma": "the line of the netlist that uses mu is blamed, not mu",
    "new values in a dict": "taken: it is no mistake any more",
    "a table of one name, not of a list": "taken: it is no mistake any more",
    "the parameter of a child is misspelt": "contract never makes the children of a composite",
    "the parameter of a child is a length": "a ValidationError of pydantic, without the class that made the child",
    "a child is made of a name": _RAW,
    "a force has the wrong sign": "the energy does not close, but nobody says which sign to look at",
}

KNOWN = {
    f"{kind}: {name}": reason
    for kind, of_kind in (("netlist", _NETLIST), ("command", _COMMAND), ("component", _COMPONENT), ("python", _PYTHON))
    for name, reason in of_kind.items()
}
