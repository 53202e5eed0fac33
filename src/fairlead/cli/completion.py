"""What a shell offers when Tab is pressed: models, types, names for --set, signals.

What cannot be read offers nothing; nothing is run or compiled for it, and no code of a library is loaded.
`fairlead --install-completion` tells the shell.
"""

import pathlib
from collections.abc import Iterable, Iterator
from typing import Any

import typer

MOST = 500


def netlists(incomplete: str) -> list[str]:
    """Bundled models, and files that end in .yaml."""
    from fairlead.netlist.files import bundled_models, named_by_folder

    found: list[str] = [*named_by_folder()] if "/" in incomplete else [*bundled_models()]
    folder, _, begin = incomplete.rpartition("/")
    here = pathlib.Path(folder or ("/" if incomplete.startswith("/") else "."))
    if here.is_dir():
        front = f"{folder}/" if "/" in incomplete else ""
        files = sorted(here.iterdir())
        found += [f"{front}{file.name}" for file in files if file.suffix in (".yaml", ".yml")]
        found += [f"{front}{file.name}/" for file in files if begin and file.is_dir() and file.name[0] != "."]
    return _fitting(found, incomplete)


def subjects(incomplete: str) -> list[str]:
    """What `describe` knows: types, and netlists."""
    from fairlead.component.bundled import bundled

    types = [*bundled()] if incomplete[:1].isupper() or not incomplete else []
    return _fitting(["types", *types], incomplete) + netlists(incomplete)


def settings(ctx: typer.Context, incomplete: str) -> list[str]:
    """Names for --set, with an equals sign behind them."""
    if "=" in incomplete:
        return []
    return _fitting((f"{name}=" for name in _names(_netlist(ctx))), incomplete)


def parameters(ctx: typer.Context, incomplete: str) -> list[str]:
    """Names of parameters, the last of several with commas between them."""
    before, comma, last = incomplete.rpartition(",")
    others = ("run.", "friction.", "record.", "initial.", "limits.")
    names = (name for name in _names(_netlist(ctx)) if not name.startswith(others))
    return [f"{before}{comma}{name}" for name in _fitting(names, last)]


def platforms(incomplete: str) -> list[str]:
    """Systems that libraries are made for."""
    from fairlead.fmu.platforms import PLATFORMS

    return _fitting(PLATFORMS, incomplete)


def signals(ctx: typer.Context, incomplete: str) -> list[str]:
    """Signals of the netlist."""
    from fairlead.analysis.record.declared_signals import signals_of
    from fairlead.component.bundled import bundled
    from fairlead.component.instantiate import instantiate

    netlist = _netlist(ctx)
    if netlist is None:
        return []
    assembly, _ = instantiate(netlist, bundled())
    return _fitting((signal.name for signal in signals_of(assembly)), incomplete)


def _fitting(names: Iterable[str], incomplete: str) -> list[str]:
    return [name for name in dict.fromkeys(names) if name.startswith(incomplete)][:MOST]


def _netlist(ctx: typer.Context) -> Any:
    """The netlist that has been typed already; None when there is none, or it cannot be read."""
    from fairlead.errors import FairleadError
    from fairlead.netlist.load import survey

    params = ctx.params or {}
    typed = [params.get("netlist") or params.get("subject"), *ctx.args]  # the latter before an option without a value
    for word in typed:
        try:
            found = survey(str(word))[0] if word and not str(word).startswith("-") else None
        except (FairleadError, OSError):
            found = None
        if found is not None:
            return found
    return None


def _names(netlist: Any) -> Iterator[str]:
    """Scene parameters, parameters of components, and the keys of the blocks that --set reaches."""
    from fairlead.component.bundled import bundled
    from fairlead.component.scene import is_head
    from fairlead.netlist.settings import RunSettings

    if netlist is None:
        return
    yield from netlist.parameters
    types = bundled()
    for entry in netlist.components.values():
        kind = types.get(entry.type)
        members = kind.members.values() if kind is not None and is_head(kind) else (kind,) if kind is not None else ()
        declared = dict.fromkeys(name for member in members for name in member.declaration.parameters)
        choosing = [kind.key] if kind is not None and is_head(kind) else []
        yield from (f"{entry.name}.{name}" for name in (*choosing, *declared))
    yield from (f"run.{name}" for name in RunSettings.model_fields)
    yield from ("friction.method", "friction.creep", "record.every")
    yield from (f"initial.{name}" for name in netlist.initial)
    yield from (f"limits.{name}.{side}" for name in netlist.limits for side in ("above", "below"))
