"""Parameters as a user types them, checked by one frozen pydantic model per class.

    values, faults = read(Spring, raw, "spring", folder)

The model is made from the class's declarations (extra keys forbidden), so validation, the collected
messages and the JSON Schema have one source. What comes out is `Values`: SI floats, words, parts,
tables and waves.
"""

from __future__ import annotations

import contextlib
import functools
import operator
import pathlib
import re
from collections.abc import Callable, Collection, Iterable, Mapping
from typing import Annotated, Any, Literal, cast

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, ValidationError, ValidationInfo, create_model

from fairlead.component.base import Declared, Family
from fairlead.component.effects import in_force, nested, switch
from fairlead.component.given import (
    REQUIRED,
    Block,
    Choice,
    Count,
    Effect,
    Entries,
    File,
    Matrix,
    Name,
    Parameter,
    Part,
    Stations,
    Table,
    Text,
    Waveform,
)  # fmt: skip
from fairlead.component.matrices import matrix_schema, read_matrix
from fairlead.component.members import view
from fairlead.component.mistakes import explain
from fairlead.component.replies import AnswerError
from fairlead.component.tables import file_inside, read_table, table_schema
from fairlead.component.values import Values
from fairlead.component.waveforms import read_waveform, waveform_schema
from fairlead.errors import Fault, Location
from fairlead.netlist.netlist import Value
from fairlead.quantities import NUMBER, digits, wanted, whole, written

NAME = re.compile(r"^[a-z][a-z0-9_]{0,59}$")
STRICT = ConfigDict(extra="forbid", frozen=True, arbitrary_types_allowed=True, hide_input_in_errors=True)


def read(
    kind: type[Declared], raw: Mapping[str, Value], path: str, where: Location, folder: pathlib.Path
) -> tuple[Values | None, list[Fault]]:
    """Values of an instance of `kind` from the netlist, and every mistake in them.

    `path` names the instance in messages; tables in files are looked for below `folder`.
    """
    plain = {name: value.plain() for name, value in raw.items()}
    try:
        model = _validated(kind, plain, folder)
    except ValidationError as error:
        tree = Value(dict(raw), where)
        return None, explain(kind, error.errors(include_url=False), tree, path)
    try:
        values = _values(kind, model)
        return in_force(values), _contradictions(kind, values, raw, path, where)
    except AnswerError as error:
        return None, error.at(where, path)


def validated(kind: type[Declared], plain: Mapping[str, Any], folder: pathlib.Path) -> Values:
    """Values from parameters as written, without their places. Raises pydantic's ValidationError."""
    return in_force(_values(kind, _validated(kind, plain, folder)))


def make(kind: type[Declared], /, **given: Any) -> Values:
    """Values from numbers in SI and ready parts, tables and waves: for composites, tests and tools."""
    return in_force(_values(kind, _validated(kind, nested(kind, given), pathlib.Path())))


def _validated(kind: type[Declared], plain: Mapping[str, Any], folder: pathlib.Path) -> BaseModel:
    """The model of what is written. Raises pydantic's ValidationError.

    A model of all members of a family takes ten times as long to make as one of those that are named. What that one
    takes, the whole takes, and as the same; what it refuses the whole is asked about, for it knows what else there is.
    """
    if (named := _named_members(kind, plain)) is not None:
        with contextlib.suppress(ValidationError):
            model = _model(cast(Any, kind), view(), named)
            return model.model_validate(plain, context={"folder": folder})
    return model_of(kind).model_validate(plain, context={"folder": folder})


def _named_members(kind: type[Declared], plain: Mapping[str, Any]) -> tuple[tuple[str, tuple[str, ...]], ...] | None:
    """Which members the parts of a class are written as, by parameter; None where some part does not say."""
    found = []
    for name, declared in kind.declaration.parameters.items():
        if not isinstance(declared, Part | Stations):
            continue
        family: Any = declared.family
        given = plain.get(name, getattr(declared, "default", REQUIRED))
        values = given if isinstance(declared, Stations) and isinstance(given, list) else [given]
        full = [_with_word(family, one) for one in values if one is not None]
        words = [one.get(family.key) if isinstance(one, Mapping) else None for one in full]
        if not all(isinstance(word, str) and word in family.members for word in words):
            return None
        found.append((name, tuple(word for word in family.members if word in (words or [*family.members][:1]))))
    return tuple(found) or None


def fits_alone(kind: type[Declared], name: str, value: Value, folder: pathlib.Path) -> bool:
    """Whether a parameter takes a value, where no more can be said of it: the class wants others that are not given.

    A model of one parameter takes a tenth of the time that the whole takes to make.
    """
    declared = kind.declaration.parameters
    others = (one for key, one in declared.items() if key != name and not isinstance(one, Block))
    if not any(getattr(one, "default", None) is REQUIRED for one in others):
        return False
    alone: dict[str, Any] = {name: _field(declared[name])}
    with contextlib.suppress(ValidationError):
        create_model(kind.__name__, __config__=STRICT, **alone).model_validate(
            {name: value.plain()}, context={"folder": folder}
        )
        return True
    return False


def model_of(kind: type[Declared]) -> type[BaseModel]:
    """The pydantic model of a class: one field per parameter, its default and its bounds."""
    return _model(cast(Any, kind), view())  # mypy takes the __hash__ of instances for that of the class


@functools.cache
def _model(kind: type[Declared], seen: tuple[int, tuple[int, ...]],
           named: tuple[tuple[str, tuple[str, ...]], ...] = ()) -> type[BaseModel]:  # fmt: skip
    """A member that joins a family later, or is of another library, makes other models of all that may have it.

    With `named` the parts it names have these members of their families only.
    """
    only = dict(named)
    fields: dict[str, Any] = {n: _field(d, only.get(n)) for n, d in kind.declaration.parameters.items()}
    if issubclass(kind, Family) and kind.key:
        fields[kind.key] = (
            Literal[kind.word],
            Field(default=kind.word, description=(kind.__doc__ or kind.word).split("\n")[0]),
        )
    return create_model(kind.__name__, __config__=STRICT, **fields)


def family_type(family: type[Family], only: Collection[str] | None = None) -> Any:
    """The annotated union of all members of a family, or of `only` those, with the bare value as a short form."""
    models = [model_of(member) for word, member in family.members.items() if only is None or word in only]
    union: Any = functools.reduce(operator.or_, models)
    inner = Annotated[union, Field(discriminator=family.key)] if len(models) > 1 else union
    return Annotated[inner, BeforeValidator(functools.partial(_with_word, family))]


def _with_word(family: type[Family], value: Any) -> Any:
    """Write out the short forms: a bare number, a bare word, a map without the word."""
    if isinstance(value, Values):
        declared = value.type.declaration.parameters  # without the derived numbers it has been asked for
        given = {name: one for name, one in value.given.items() if name in declared}
        return {family.key: value.type.word, **given}  # type: ignore[attr-defined]
    if isinstance(value, str) and (value in family.members or value[:1].isalpha()):
        return {family.key: value}
    if not isinstance(value, Mapping) and family.bare is not None:
        return {family.key: family.bare[0], family.bare[1]: value}
    if isinstance(value, Mapping) and family.key not in value and family.default_word:
        return {family.key: family.default_word, **value}
    return value


def _field(declared: Any, only: Collection[str] | None = None) -> tuple[Any, Any]:
    """Annotation and default of one parameter; of a part, with `only` these members of its family."""
    default = ... if getattr(declared, "default", REQUIRED) is REQUIRED else declared.default
    kind: Any
    if isinstance(declared, Parameter):
        bounds: dict[str, Any] = {"gt": declared.above, "ge": declared.least, "lt": declared.below, "le": declared.most}
        limits = Field(**{name: bound for name, bound in bounds.items() if bound is not None})
        schema = {"type": ["number", "string"], **_schema_bounds(declared)}
        read = functools.partial(written, unit=declared.unit, size=declared.above == 0, level=bool(declared.like))
        kind = Annotated[float, BeforeValidator(read), limits, _Schema(schema)]
    elif isinstance(declared, Effect):
        kind = Annotated[Literal["on", "off"], BeforeValidator(switch)]
    elif isinstance(declared, Choice):
        kind = Annotated[Literal[declared.options], BeforeValidator(functools.partial(_option, declared.options))]
    elif isinstance(declared, Count):
        kind = Annotated[int, BeforeValidator(whole), Field(ge=declared.least, le=declared.most)]
    elif isinstance(declared, Name | File | Entries | Text | Matrix):
        kind = _own_words(declared)
    elif isinstance(declared, Part):
        kind = family_type(declared.family, only)
    elif isinstance(declared, Block):
        inner: dict[str, Any] = {name: _field(d) for name, d in declared.parameters.items()}
        kind = create_model("Block", __config__=STRICT, **inner)
        if default is ... and all(not field.is_required() for field in kind.model_fields.values()):
            default = Field(default_factory=kind)
    elif isinstance(declared, Stations):
        kind = list[family_type(declared.family, only)]  # type: ignore[misc]  # a type made at run time
    else:
        kind = _table_type(declared)
    if default is None:
        kind = kind | None
    described = _hover(declared)
    if default is ...:
        return kind, Field(description=described)
    if not isinstance(default, str | int | float | tuple | None):
        return kind, default
    validated: Any = default is not None and not isinstance(default, tuple) and not isinstance(declared, Choice)
    return kind, Field(default=default, description=described, validate_default=validated)


def _hover(declared: Any) -> str:
    """What an editor shows: the sentence, and how to write the quantity."""
    quantity = isinstance(declared, Parameter | Waveform)
    if quantity and (like := getattr(declared, "like", "")):
        return f"{declared.doc} Write a quantity in the unit of what is joined to {like}, or a bare number in SI."
    return f"{declared.doc} {wanted(declared.unit) if quantity else ''}".strip()


def _schema_bounds(declared: Parameter) -> dict[str, float]:
    """The range as a schema says it; it binds bare numbers only, which are in SI."""
    words = {"exclusiveMinimum": declared.above, "minimum": declared.least}
    words |= {"exclusiveMaximum": declared.below, "maximum": declared.most}
    return {word: bound for word, bound in words.items() if bound is not None}


def _table_type(declared: Table | Waveform) -> Any:
    def parse(value: Any, info: ValidationInfo) -> Any:
        if isinstance(declared, Table):
            return read_table(value, declared, (info.context or {}).get("folder", pathlib.Path()))
        return read_waveform(value, declared, (info.context or {}).get("folder", pathlib.Path()))

    schema = table_schema(declared) if isinstance(declared, Table) else waveform_schema(declared)
    return Annotated[Any, BeforeValidator(parse), _Schema(schema)]


def _Schema(schema: dict[str, Any]) -> Any:
    from pydantic import WithJsonSchema

    return WithJsonSchema(schema)


def _named(value: Any) -> str:
    """A lower_snake name. Raises ValueError for anything else."""
    if not isinstance(value, str) or not NAME.match(value):
        raise ValueError("write a name of small letters, digits and underscores")
    return value


def _option(options: tuple[str, ...], value: Any) -> Any:
    """The option that a number or a truth value is meant for, such as "3" for 3; else the value."""
    if isinstance(value, bool):
        return str(value).lower() if str(value).lower() in options else value
    if not isinstance(value, int | float):
        return value
    return next((one for one in options if NUMBER.fullmatch(one) and float(one) == value), value)


def _text(value: Any) -> str:
    """A line of text; a number alone is one too. Raises ValueError for anything else."""
    if isinstance(value, bool) or not isinstance(value, str | int | float):
        raise ValueError("write a text")
    return str(value)


def _own_words(declared: Name | File | Entries | Text | Matrix) -> Any:
    """What is written in words of the user's own."""
    if isinstance(declared, Name):
        return Annotated[str, BeforeValidator(_named), _Schema({"type": "string", "pattern": NAME.pattern})]
    if isinstance(declared, File):
        return Annotated[pathlib.Path, BeforeValidator(_file_of(declared)), _Schema({"type": "string"})]
    if isinstance(declared, Text):
        return Annotated[str, BeforeValidator(_text), _Schema({"type": "string"})]
    if isinstance(declared, Matrix):
        return Annotated[tuple[tuple[float, ...], ...], BeforeValidator(read_matrix), _Schema(matrix_schema())]
    return Annotated[tuple[Any, ...], BeforeValidator(_entries), _Schema({"type": "object"})]


def _file_of(declared: File) -> Callable[[Any, ValidationInfo], pathlib.Path]:
    """Reads the name of a file in the folder of the netlist. What it returns raises TableError."""

    def parse(value: Any, info: ValidationInfo) -> pathlib.Path:
        return (
            value
            if isinstance(value, pathlib.Path)
            else file_inside((info.context or {})["folder"], value, declared.ending)
        )

    return parse


def _entries(value: Any) -> tuple[tuple[str, Any], ...]:
    """The pairs of a map. Raises ValueError for anything else."""
    if isinstance(value, tuple):
        return value
    if not isinstance(value, Mapping):
        raise ValueError("write a map {NAME: VALUE, ...}")
    return tuple(value.items())


def _values(kind: type[Declared], model: BaseModel) -> Values:
    """The model's fields as Values; parts become Values of their own class."""
    given: dict[str, Any] = {}
    for name, declared in kind.declaration.parameters.items():
        value = getattr(model, name)
        if isinstance(declared, Part):
            value = _part(declared.family, value)
        elif isinstance(declared, Stations):
            value = [_part(declared.family, one) for one in value]
        elif isinstance(value, BaseModel):
            value = _block(declared, value)
        given[name] = value
    effects = given.pop("effects", {})
    given |= effects
    prepare = kind.answers.prepare
    values = Values(kind, prepare(given) if prepare else given)
    values.effects = dict(effects)
    return values


def _part(family: Any, value: Any) -> Any:
    if not isinstance(value, BaseModel):
        return value
    return _values(family.members[getattr(value, family.key)], value)


def _block(declared: Block, value: BaseModel) -> dict[str, Any]:
    parts = {n: d.family for n, d in declared.parameters.items() if isinstance(d, Part)}
    return {
        n: _part(parts[n], getattr(value, n)) if n in parts else getattr(value, n) for n in type(value).model_fields
    }


def _contradictions(
    kind: type[Declared], values: Values, raw: Mapping[str, Value], path: str, where: Location
) -> list[Fault]:
    """What the class's own `check(p)` says: (parameter, what is wrong, way out).

    A parameter may be a path such as `stations[2].start`.
    """
    check = kind.answers.check
    faults = said_of(check(values) if check else (), raw, path, where)
    for name, value in values.given.items():
        listed = enumerate(value) if isinstance(value, list) else ()
        parts = [(f"{name}[{k}]", one) for k, one in listed] or [(name, value)]
        for inner_path, one in parts:
            if isinstance(one, Values):
                node = _node(raw, inner_path)
                inner, place = (node.entries, node.where) if node else ({}, where)
                faults += _contradictions(one.type, one, inner, f"{path}.{inner_path}", place)
    return faults


def said_of(
    said: Iterable[tuple[str, str, str]], raw: Mapping[str, Value], path: str, where: Location
) -> list[Fault]:
    """What a class says of its values, each at the place where the parameter stands."""
    return [
        Fault(_place(raw, name, where), f"{path}{'.' + name if name else ''}: {what.removesuffix('.')}.", way_out)
        for name, what, way_out in said
    ]


def _place(raw: Mapping[str, Value], path: str, where: Location) -> Location:
    """Where a parameter stands, or else the nearest of what it stands in."""
    words = path.replace("[", ".[").split(".")
    found = (_node(raw, ".".join(words[:k]).replace(".[", "[")) for k in range(len(words), 0, -1))
    return next((node.where for node in found if node is not None), where)


def _node(raw: Mapping[str, Value], path: str) -> Value | None:
    """The value at a path such as `stations[2].start`; None when nothing is written there."""
    node: Value | None = None
    for step in path.replace("[", ".").replace("]", "").split("."):
        if node is not None and isinstance(node.content, list):
            number = digits(step)
            node = node.content[number] if number is not None and number < len(node.content) else None
        else:
            node = (raw if node is None else node.entries).get(step)
        if node is None:
            return None
    return node
