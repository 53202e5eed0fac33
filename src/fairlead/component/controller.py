"""A controller in plain Python: called at its sample times only, with numbers.

    class Bang(Controller):
        speed = Input("m/s")
        reference = Parameter("m/s")
        command = Output("1", "Valve command.")

        def sample(self, t, speed):
            return {"command": 1.0 if speed < self.reference else 0.0}

`sample` may do what Python can: branch, keep what it likes in `self`, call other code. What it returns is held
until the next sample. Laws of components are traced and compiled instead, since they are evaluated thousands of
times between two samples; a sampled law (`declare.sampled`) is compiled too, and the faster way for simple ones.
"""

from __future__ import annotations

import inspect
from dataclasses import replace
from typing import Any

from fairlead.component.base import Component
from fairlead.component.class_checks import DeclarationError, source_place
from fairlead.component.declare import Discrete, Law
from fairlead.component.given import Parameter


class Controller(Component, abstract=True):
    """Base of controllers in plain Python: `sample(self, t, ...)`, and `begin(self)` and `end(self)` round a run.

    Arguments of `sample` go by name: `t` and any input (a number in SI) or port (`shaft.speed`). Parameters are
    attributes of `self`. It returns the outputs as a map, or the number alone when there is one. Until the first sample
    an output is its `start`, which others that are sampled at that instant read.
    """

    period = Parameter("s", "Time between samples.", above=0)

    def __init_subclass__(cls, *, abstract: bool = False, **keywords: Any) -> None:
        """Every output is a variable that is held between samples."""
        super().__init_subclass__(abstract=abstract, **keywords)
        if not abstract:
            has = cls.declaration
            held = {name: Discrete(one.unit, one.doc, one.start) for name, one in has.outputs.items()}
            cls.declaration = replace(has, discrete=held, python=True)
            _check(cls)

    def law(p: Any) -> Law:  # noqa: N805
        """Nothing but what is held."""
        return Law()

    def begin(self) -> None:
        """Called before the first sample of a run."""

    def end(self) -> None:
        """Called when a run is over, however it ended; not of one that is stepped from outside."""


def _check(cls: type[Controller]) -> None:
    has, sample = cls.declaration, cls.answers.sample
    if sample is None:
        raise DeclarationError(f"{source_place(cls)}: {cls.__name__}: a Controller needs a method sample(self, t, ...)")
    known = {"t", *has.inputs, *has.ports}
    for name in list(inspect.signature(sample).parameters)[1:]:
        if name not in known:
            raise DeclarationError(f"{source_place(sample)}: sample asks for {name!r}; known: {sorted(known)}")
