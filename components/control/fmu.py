"""A component that is an FMU of another maker (FMI 2 or 3, co-simulation)."""

from fairlead.component import Composite, Entries, Expansion, File, Parameter
from fairlead.foreign.block import TIME_LIMIT, block_of
from fairlead.foreign.description import read_fmu
from fairlead.foreign.refusals import Refused
from fairlead.foreign.signals import signals_of, started
from fairlead.foreign.starts import sized, starts_of, unmet

ROUNDED = 1e-9  # by which a communication step may miss a multiple of a fixed step, relative


class Fmu(Composite):
    """An FMU for co-simulation: it gets its inputs every `period`, and its outputs are held in between.

    Its signals are the inputs and outputs of the FMU, in SI, of arrays each element. Events and clocks of FMI 3 are
    handled inside a step. Foreign code runs only where it is allowed (`--allow-fmu`), in a process of its own.

    signals(t) = outputs of the FMU at the last sample.  Source: the standard FMI (docs/howto/foreign_fmu.md). Limits:
    what happens inside a period is not seen by the rest of the scene, nor what the rest does by the FMU.
    """

    file = File("The FMU, relative to the netlist and in its folder or below.", ending=".fmu")
    period = Parameter("s", "Communication step H; that of the FMU's default experiment when not given.", default=None,
                       above=0)  # fmt: skip
    inputs = Entries("Inputs by name: the variable, or {of: VARIABLE, unit: N}; all of them when not given.",
                     default=None)  # fmt: skip
    outputs = Entries("Outputs by name, likewise.", default=None)
    parameters = Entries("Values of parameters of the FMU, by its names; lists for arrays.", default=())
    time_limit = Parameter("s", "Longest that one call of the FMU may take; then its process is ended.",
                           default=TIME_LIMIT, above=0)  # fmt: skip

    def check(p):
        """The file is an FMU that runs here, with the variables and units that the netlist speaks of."""
        try:
            fmu = sized(read_fmu(p.file), p.parameters)
        except Refused as error:
            yield "file", f"{p.file.name} {error.what}", error.way_out
            return
        yield from signals_of(fmu, p.inputs, p.outputs)[1]
        starts, wrong = starts_of(fmu, p.parameters)
        yield from wrong
        step = p.period or fmu.step
        if step is None:
            yield "", f"period is missing; {p.file.name} names no step of its own", "Give the communication step."
        elif fmu.fixed_step and not _is_multiple(step / fmu.fixed_step):
            what = f"{p.file.name} steps by {fmu.fixed_step:g} s, and period = {step:g} s is no multiple of it"
            yield "period" if p.period else "", what, "Give a multiple."
        else:
            for what in unmet(fmu, starts.of_clocks, step):
                told = f"{p.file.name} takes steps of one length only, and {what}"
                yield "period" if p.period else "", told, "Give a period of which it is a multiple."

    def expand(p, scene):
        """One block, whose signals are handed out."""
        fmu = sized(read_fmu(p.file), p.parameters)
        starts = starts_of(fmu, p.parameters)[0]
        signals = started(signals_of(fmu, p.inputs, p.outputs)[0], starts.numbers)
        kind = block_of(fmu, signals, allowed=scene.foreign_code)
        block = scene.make(kind, period=p.period or fmu.step, starts=starts.told, time_limit=p.time_limit)
        names = {one.name: f"fmu.{one.name}" for one in signals.inputs}
        return Expansion({"fmu": block}, [], names, {one.name: f"fmu.{one.name}" for one in signals.outputs})


def _is_multiple(ratio):
    """Whether a ratio is a whole number from 1 on, but for rounding."""
    return round(ratio) >= 1 and abs(ratio - round(ratio)) <= ROUNDED * ratio
