"""The page of the command line, from the commands themselves."""

from __future__ import annotations

import enum
import pathlib
import re
import typing
from typing import Any

from generate.tables import fence, table


def pages() -> dict[str, str]:
    """commands.md, with a heading for every verb."""
    import typer

    from fairlead.cli import app

    group: Any = typer.main.get_command(app)
    context = group.make_context("fairlead", [], resilient_parsing=True)
    lines = ["# Commands", "", "This page is written from the commands; `fairlead VERB --help` says the same.",
             "[The netlist](../netlist.md) lists the exit codes.", ""]  # fmt: skip
    for name in group.list_commands(context):
        lines += _verb(name, group.get_command(context, name), context)
    return {"commands.md": "\n".join(lines)}


def _verb(name: str, command: Any, above: Any) -> list[str]:
    context = command.make_context(name, [], parent=above, resilient_parsing=True)
    usage = command.get_usage(context).replace("Usage: ", "").strip()
    lines = [f"## fairlead {name}", "", re.sub(r"(?m)^(\s*)#", r"\1\\#", command.help or ""), "", *fence("text", usage)]
    kinds = typing.get_type_hints(command.callback)
    arguments = [one for one in command.params if one.param_type_name == "argument"]
    options = [one for one in command.params if one.param_type_name == "option" and not getattr(one, "hidden", False)]
    lines += table(("argument", "what"), ((f"`{one.metavar or one.name}`", one.help or "") for one in arguments))
    lines += table(("option", "value", "what"), (_option(one, kinds.get(one.name)) for one in options))
    return lines


def _option(option: Any, kind: Any) -> tuple[str, str, str]:
    value = "" if option.is_flag else f"`{option.metavar or _word(kind)}`"
    return ", ".join(f"`{text}`" for text in [*option.opts, *option.secondary_opts]), value, option.help or ""


def _word(kind: Any) -> str:
    """The words of a choice, else what sort of value an option takes."""
    inner = [one for one in typing.get_args(kind) if one is not type(None)]
    if inner:
        return _word(inner[0])
    if isinstance(kind, type) and issubclass(kind, enum.Enum):
        return "|".join(str(one.value) for one in kind)
    return "FILE" if kind is pathlib.Path else getattr(kind, "__name__", "value")
