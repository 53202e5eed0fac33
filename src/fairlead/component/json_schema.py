"""JSON Schema (draft-07) of netlists, for completion, hover texts and red squiggles in an editor.

    schema = json_schema(types)

Its one source are the pydantic models that validate: `netlist.schema.Document` and the model of every component
class. It is made for netlists as they are typed: any value may be an expression such as "{2*mu} N", and what
depends on another place of the file (the friction method of the scene) is not judged here but by `fairlead check`.
"""

from __future__ import annotations

import inspect
from collections.abc import Mapping
from typing import Any

from fairlead.component.base import Declared, Family
from fairlead.component.given import SWITCH, Block, Part, Stations
from fairlead.component.parameters import model_of
from fairlead.component.scene import FRAMEWORK_EFFECTS, is_head
from fairlead.netlist.schema import Document

DRAFT = "http://json-schema.org/draft-07/schema#"
Schema = dict[str, Any]

EXPRESSION: Schema = {"type": "string", "pattern": r"\{.*\}"}
QUANTITY = r"^\s*[-+]?(\d|\.\d)|\{"  # a number comes first, or there is an expression somewhere
RENAMED = {"gt": "exclusiveMinimum", "ge": "minimum", "lt": "exclusiveMaximum", "le": "maximum",
           "dependentRequired": "dependencies", "dependentSchemas": "dependencies"}  # fmt: skip
DROPPED = {"title", "discriminator", "default", "$defs", "$schema"}  # a default of ours is in SI, not as one types it
NAMES_INSIDE = ("properties", "patternProperties", "dependencies", "definitions")  # keys there are names of users


def json_schema(types: Mapping[str, type[Declared]]) -> Schema:
    """The schema of a netlist that may use `types`."""
    definitions: dict[str, Schema] = {}
    chosen = {name: _component(name, kind, definitions) for name, kind in sorted(types.items())}
    definitions |= chosen
    definitions["component"] = {
        "type": "object",
        "required": ["type"],
        "properties": {"type": {"enum": list(chosen), "description": "Name of the component class, such as Spring."}},
        "allOf": [_when("type", name, {"$ref": f"#/definitions/{name}"}) for name in chosen],
    }
    whole = draft7(Document.model_json_schema(by_alias=True))
    blocks = whole["properties"]
    _replace_values(blocks["components"], {"$ref": "#/definitions/component"})
    blocks["friction"] |= _scene_friction(types)
    blocks["effects"] |= {"properties": _scene_effects(types)}
    for block in blocks.values():  # `friction:` with nothing behind it is an empty block
        if block.get("type") == "object" and block is not blocks["run"]:
            block["type"] = ["object", "null"]
    return {"$schema": DRAFT, "title": "A fairlead netlist", **whole, "definitions": definitions}


def draft7(schema: Schema) -> Schema:
    """What pydantic emits (2020-12) as draft-07, for values that may be expressions.

    References are written out, since draft-07 ignores what stands beside one; `prefixItems` become `items`;
    words and numbers may be expressions; a quantity begins with a number.
    """
    return _convert(schema, schema.get("$defs", {}))


def _convert(node: Any, known: Mapping[str, Any]) -> Any:
    if isinstance(node, list):
        return [_convert(item, known) for item in node]
    if not isinstance(node, dict):
        return node
    if "$ref" in node:
        node = {**known[node["$ref"].rpartition("/")[2]], **{k: v for k, v in node.items() if k != "$ref"}}
    made: Schema = {}
    for key, value in node.items():
        if key in NAMES_INSIDE:
            made[key] = {name: _convert(inner, known) for name, inner in value.items()}
        elif key not in DROPPED:
            made[RENAMED.get(key, key)] = _convert(value, known)
    if "prefixItems" in made:
        rest = made.pop("items", None)
        made |= {"items": made.pop("prefixItems")} | ({} if rest is None else {"additionalItems": rest})
    return _or_expression(made)


def _or_expression(node: Schema) -> Schema:
    """A scalar of a netlist may be an expression instead."""
    said = {key: node[key] for key in ("description",) if key in node}
    if node.get("type") == ["number", "string"]:
        return {"pattern": QUANTITY, **node}
    if "enum" in node or "const" in node or node.get("type") in ("number", "integer", "boolean"):
        return {**said, "anyOf": [{k: v for k, v in node.items() if k != "description"}, EXPRESSION]}
    return node


def _component(name: str, kind: type[Declared], definitions: dict[str, Schema]) -> Schema:
    """A component with the `type` that names it; a family by the word that selects the member."""
    if is_head(kind):
        made = _members(kind, definitions)
    else:
        made = _parameters(kind, definitions)
    typed = {"const": name}
    for closed in (made, *(choice["then"] for choice in made.get("allOf", ()))):
        closed["properties"] = {"type": typed, **closed["properties"]}
    return made


def _parameters(kind: type[Declared], definitions: dict[str, Schema]) -> Schema:
    """The parameters of one class; those that take a part refer to the schema of its family."""
    made = draft7(model_of(kind).model_json_schema())
    _refer(made.get("properties", {}), kind.declaration.parameters, definitions)
    return {"properties": {}, **made, "description": inspect.getdoc(kind) or kind.__name__}


def _refer(properties: Schema, declared: Mapping[str, Any], definitions: dict[str, Schema]) -> None:
    for name, one in declared.items():
        said = {"description": one.doc} if getattr(one, "doc", "") else {}
        if isinstance(one, Part):
            properties[name] = {**said, "allOf": [_family(one.family, definitions)]}
        elif isinstance(one, Stations):
            properties[name] = {**said, "type": "array", "items": _family(one.family, definitions)}
        elif isinstance(one, Block):
            forms = properties[name].get("anyOf", ())  # one that may be left out is a map or null
            block = next((form for form in forms if "properties" in form), properties[name])
            _refer(block["properties"], one.parameters, definitions)


def _family(family: type[Family], definitions: dict[str, Schema]) -> Schema:
    """Reference to the schema of a family, which is made when first asked for; with its short forms."""
    name = family.__name__
    if name not in definitions:
        definitions[name] = {}  # a member may take a part of the same family
        forms = [_members(family, definitions)]
        if family.bare is not None:  # a value alone stands for one parameter of one member
            word, parameter = family.bare
            forms.append(_parameters(family.members[word], definitions)["properties"][parameter])
        forms.append({"enum": list(family.members)})
        forms.append(EXPRESSION)
        definitions[name] = {"description": inspect.getdoc(family) or name, "anyOf": forms}
    return {"$ref": f"#/definitions/{name}"}


def _members(family: type[Family], definitions: dict[str, Schema]) -> Schema:
    """A map whose key word selects the member; without the word, anything that some member knows."""
    members = {word: _parameters(member, definitions) for word, member in family.members.items()}
    word_schema = {"enum": list(members), "description": f"One of {', '.join(members)}."}
    everything: Schema = {}
    for member in members.values():
        everything |= {name: {**schema} for name, schema in member["properties"].items()}
    everything[family.key] = word_schema if family.key == "type" else {"anyOf": [word_schema, EXPRESSION]}
    needed = [set(member.get("required", ())) for member in members.values()]
    required = set.intersection(*needed) | (set() if _may_be_silent(family) else {family.key})
    return {
        "type": "object",
        "description": inspect.getdoc(family) or family.__name__,
        "properties": everything,
        "required": sorted(required),
        "additionalProperties": False,
        "allOf": [_when(family.key, word, member) for word, member in members.items()],
    }


def _may_be_silent(family: type[Family]) -> bool:
    """True when the netlist need not name the member."""
    return bool(family.default_word) or len(family.members) == 1


def _when(key: str, word: str, then: Schema) -> Schema:
    return {"if": {"properties": {key: {"const": word}}, "required": [key]}, "then": then}


def _replace_values(block: Schema, by: Schema) -> None:
    """Let the values of a map, whatever their names, be what `by` says."""
    if "patternProperties" in block:
        block["patternProperties"] = dict.fromkeys(block["patternProperties"], by)
        block["additionalProperties"] = False
    else:
        block["additionalProperties"] = by


def _scene_effects(types: Mapping[str, type[Declared]]) -> Schema:
    """Every effect that some class knows; a composite in a user's file may have children with more."""
    found = {name: effect.doc for kind in types.values() for name, effect in kind.declaration.effects.items()}
    either: Schema = {"anyOf": [{"enum": [*SWITCH, True, False]}, EXPRESSION]}
    named = {name: {**either, "description": doc} for name, doc in sorted(found.items())}
    return {**dict.fromkeys(FRAMEWORK_EFFECTS, either), **named}


def _scene_friction(types: Mapping[str, type[Declared]]) -> Schema:
    """Settings for all contacts of a scene: whatever some member of a family of components knows."""
    heads: list[Any] = [kind for kind in types.values() if is_head(kind)]
    found: Schema = {}
    for head in heads:
        found |= _members(head, {})["properties"]
    return {"properties": found, "additionalProperties": False} if heads else {}
