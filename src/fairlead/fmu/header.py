"""model.h: the constants of one model, as `c/run.c` and `c/wrapper.c` read them."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Mapping, Sequence

import fairlead.integrate.codes as codes
from fairlead.fmu.image import Image
from fairlead.fmu.machine_code import Code
from fairlead.fmu.tuned import Tuned, kept_words
from fairlead.integrate.memory.layout import PLACES
from fairlead.integrate.problem import Status
from fairlead.outer import Read
from fairlead.outside import LaidOpen

FIELDS = (
    "t", "t_next", "start", "stop", "phase", "rows", "events", "at_y", "context", "call_outputs", "worst", "culprit",
    "dense", "midway", "replanned", "replans", "no_pivots", "factorisations", "reduced_valid", "n", "n_reduced",
    "n_matrix", "at_matrix_starts", "at_matrix_rows", "at_matrix", "at_row_scale", "at_column_scale", "at_row_order",
    "at_column_order", "at_absolute", "at_relative", "at_cap", "overruns",
)  # fmt: skip
"""Single values of the structs, and addresses in them, that the wrapper reads or writes."""
REPLACED = (
    "row_order", "row_place", "matrix_rows", "lower_starts", "lower_rows", "upper_starts", "upper_rows",
    "using_starts", "using_columns", "lower", "upper",
)  # fmt: skip
"""What another order of pivots replaces, as `c/pivots.h` numbers it."""


def header(
    opened: LaidOpen, image: Image, code: Code, *, columns: Sequence[Read],
    names: Mapping[str, Sequence[str]], tuned: Sequence[Tuned], token: str, identifier: str,
) -> str:  # fmt: skip
    """The text. `columns` says what the outputs are of recorded values; `names` are those of each `input`, `output`."""
    own = opened.problem
    piece = {name: own.working.places[name].at for name in ("set_due", "set_values")}
    numbers = {
        "MEMORY_BYTES": image.size, "STATE_BYTES": image.state, "N_LINKS": len(image.links),
        "N_RUNS": len(image.runs), "N_UNKNOWNS": own.n, "N_MACHINES": len(own.machine_names),
        "N_RECORDED": own.n_outputs, "N_OUTPUTS": len(columns), "N_INPUTS": len(names["input"]),
        "N_ENDS": len(opened.limits),
        **{f"AT_{name.upper()}": PLACES[name][0] for name in FIELDS},
        **{f"AT_{name.upper()}": image.piece + at for name, at in piece.items()},
        **{f"STATUS_{name}": value for name, value in _statuses().items()},
        "PHASE_TRY": codes.TRY, "PHASE_SETTLE": codes.SETTLE,
    }  # fmt: skip
    laws = [(which, law) for which, one in enumerate(tuned) for law in one.laws]
    kept = kept_words(opened, image.size, [law for _, law in laws])
    numbers |= {"N_TUNED": len(tuned), "N_FOLLOWERS": len(laws), "N_KEPT": len(kept),
                "KEPT_BYTES": sum(length for _, length in kept)}  # fmt: skip
    lines = ["/* Made by fairlead. */", '#include "image.h"', '#include "tuned.h"']
    lines += [f"#define {name} {value}" for name, value in numbers.items()]
    lines += [f"#define MODEL_TOKEN {_text(token)}", f"#define MODEL_IDENTIFIER {_text(identifier)}"]
    lines.append(f"#define MODEL_PREFIX {identifier}")
    lines += [f"extern HIDDEN void {name}(void);" for name in code.functions]
    lines.append(_array("void (*const model_functions[])(void)", code.functions))
    replaced = [f"{{{k}, {at}}}" for k, name in enumerate(REPLACED) for at in PLACES[f"at_{name}"]]
    lines.append(f"static __attribute__((unused)) const int64_t model_replaced[][2] = {{{', '.join(replaced)}}};")
    starts = itertools.accumulate((len(one.columns) for one in columns), initial=0)
    lines.append(_array("const int model_columns[]", (str(k) for one in columns for k in one.columns)))
    lines.append(_array("const int model_columns_starts[]", map(str, starts)))
    lines.append(_array("const int model_takes_largest[]", (str(int(one.take == "max")) for one in columns)))
    texts = {"unknowns": own.unknown_names, "machines": own.machine_names, **{f"{k}s": v for k, v in names.items()}}
    lines += [_array(f"const char *const model_{what}[]", map(_text, those)) for what, those in texts.items()]
    lines += [
        _table("Parameter model_parameters[]", (
            ", ".join([_text(one.name), *map(_exact, (one.value, one.low, one.high)), one.when]) for one in tuned
        )),
        _table("Follower model_followers[]", (
            f"{law.at}, {which}, {law.law}, {_exact(law.offset)}, {_exact(law.slope)}" for which, law in laws
        )),
        _table("End model_ends[]", (
            ", ".join([str(one.column), _exact(one.sign), _exact(one.most), _text(one.sentence)])
            for one in opened.limits
        )),
        _table("Kept model_kept[]", (f"{at}, {length}" for at, length in kept)),
    ]  # fmt: skip
    return "\n".join(lines) + "\n"


def stubs(code: Code) -> str:
    """C of what the loop names and never reaches."""
    begin = '__attribute__((visibility("hidden"))) void'
    lines = [f"{begin} {name}(void) {{ __builtin_trap(); }}" for name in code.unreached]
    return "\n".join(["/* Named by numba on paths that raise, which the loop does not. */", *lines, ""])


def _statuses() -> Mapping[str, int]:
    """All statuses of a run; the wrapper has a sentence for each that its loop can return."""
    return {status.name: int(status) for status in Status}


def _array(declared: str, values: Iterable[str]) -> str:
    """An array of constants; one entry more, so that none is empty."""
    return f"static __attribute__((unused)) {declared} = {{{', '.join([*values, '0'])}}};"


def _table(declared: str, rows: Iterable[str]) -> str:
    """An array of structs; one entry more, so that none is empty."""
    return f"static __attribute__((unused)) const {declared} = {{{', '.join(f'{{{row}}}' for row in [*rows, '0'])}}};"


def _exact(number: float) -> str:
    """A number in C, to the last bit."""
    return float(number).hex()


def _text(text: str) -> str:
    """A string of C: what is no plain letter stands as the octal numbers of its bytes in UTF-8."""
    safe = (chr(byte) if 32 <= byte < 127 and chr(byte) not in '"\\?%' else f"\\{byte:03o}" for byte in text.encode())
    return f'"{"".join(safe)}"'
