"""What is said of the keys of a block: the string below a field of its class.

    class RunSettings(Strict):
        stop: Seconds
        \"\"\"Time at which the run ends.\"\"\"

pydantic can read these when it makes a class, which takes longer than a short run solves. Here they are read when
somebody asks: the JSON Schema, for the hover texts of editors, and messages.
"""

from __future__ import annotations

import ast
import functools
import inspect
import textwrap
from itertools import pairwise
from typing import Any

from pydantic import BaseModel


@functools.cache
def said_of(model: type[BaseModel]) -> dict[str, str]:
    """The sentences by field, those of base classes too; nothing where there is no source."""
    said: dict[str, str] = {}
    for base in reversed(model.__mro__):
        if issubclass(base, BaseModel) and base is not BaseModel:
            said |= _in_the_body_of(base)
    return said


def _in_the_body_of(kind: type) -> dict[str, str]:
    try:
        tree = ast.parse(textwrap.dedent(inspect.getsource(kind)))
    except (OSError, TypeError, SyntaxError):
        return {}
    body = tree.body[0].body if isinstance(tree.body[0], ast.ClassDef) else []
    return {
        field.target.id: inspect.cleandoc(text.value.value)
        for field, text in pairwise(body)
        if isinstance(field, ast.AnnAssign) and isinstance(field.target, ast.Name)
        and isinstance(text, ast.Expr) and isinstance(text.value, ast.Constant) and isinstance(text.value.value, str)
    }  # fmt: skip


def say(schema: dict[str, Any], model: type[BaseModel]) -> None:
    """Put the sentences into the JSON Schema of a class (`json_schema_extra` of its configuration)."""
    for name, text in said_of(model).items():
        field = model.model_fields.get(name)
        known = schema.get("properties", {}).get(field.alias or name) if field else None
        if known is not None and field is not None and field.description is None:
            known["description"] = f"{text} {known.get('description', '')}".strip()  # and how to write the quantity
