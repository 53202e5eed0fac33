"""What all verbs share: how an error, a warning or Ctrl-C becomes a message and an exit code.

A mistake in a netlist is told without a traceback, in the words of the error. An exception that no
stage foresaw is a mistake of fairlead: the user gets a short text to send, and with -v the traceback.
"""

import contextlib
import itertools
import json
import os
import pathlib
import sys
import traceback
import warnings
from collections.abc import Iterator
from typing import Any

import typer
import typer.core

from fairlead.cli.exit_codes import INTERRUPTED, UNFORESEEN
from fairlead.cli.terminal import echo
from fairlead.errors import FairleadError, Fault, ModelError, printable

MOST_FAULTS_TOLD = 1000
"""In JSON; on the screen it is a tenth of that, and the text of `error` says how many there are."""


USAGE_ERRORS = typer.BadParameter.__mro__[2]
"""ClickException, of the click that typer brings along or, in older versions, imports."""


class Verbs(typer.core.TyperGroup):
    """The verbs; Ctrl-C before one of them has begun ends as it does later."""

    def make_context(self, *given: Any, **more: Any) -> Any:
        """Read the arguments. Raises typer.Exit when that is interrupted."""
        with _told():
            return super().make_context(*given, **more)

    def invoke(self, ctx: Any) -> Any:
        """Call the verb. Raises typer.Exit when finding it is interrupted."""
        with _told():
            return super().invoke(ctx)


@contextlib.contextmanager
def _told() -> Iterator[None]:
    """What ends before a verb has begun: Ctrl-C, and usage errors, which typer prints with what was typed in them."""
    try:
        yield
    except KeyboardInterrupt as error:
        echo("interrupted", err=True)
        raise typer.Exit(INTERRUPTED) from error
    except Exception as error:
        if isinstance(error, USAGE_ERRORS):
            text = printable(f"{error.format_message()}{_meant_to_set(error)}{_loose_unit(error)}")  # type: ignore[attr-defined]
            error.format_message = lambda: text  # type: ignore[attr-defined]
        raise


def _meant_to_set(error: Exception) -> str:
    """A hint for who types a parameter as if it were an option, where the verb has `--set`."""
    name, command = getattr(error, "option_name", ""), getattr(getattr(error, "ctx", None), "command", None)
    near = [one for one in getattr(error, "possibilities", None) or () if one.startswith(name)]
    if near or not name.startswith("--") or not any("--set" in one.opts for one in getattr(command, "params", ())):
        return ""
    from fairlead.netlist.settings import RunSettings

    block = "run." if name[2:].replace("-", "_") in RunSettings.model_fields else ""
    return f"\nA value of the scene is given by --set {block}{name[2:].replace('-', '_')}=VALUE."


def _loose_unit(error: Exception) -> str:
    """A hint for who types a quantity as two words, so that its unit is one too many."""
    from fairlead.quantities import QuantityError, parse_unit

    last = str(getattr(error, "message", "")).rpartition("(")[2].rstrip(")").split(" ")[0]
    if "unexpected extra argument" not in str(getattr(error, "message", "")) or not last:
        return ""
    try:
        parse_unit(last)
    except QuantityError:
        return ""
    return f"\nA number and its unit are one value: put them in quotes, as in '3 {last}'."


class Verb(typer.core.TyperCommand):
    """A command whose failures end in one of the documented exit codes."""

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        """Read the arguments. Raises typer.BadParameter for an option that names a file or folder by nothing.

        A variable of the shell that is not set leaves nothing; as a path that would be the working folder.
        """
        given = list(args)
        rest: list[str] = super().parse_args(ctx, args)
        for option in self.params:
            path = isinstance(ctx.params.get(option.name or ""), pathlib.Path)
            for name in option.opts if path and option.opts[0].startswith("-") else ():
                if f"{name}=" in given or (name, "") in itertools.pairwise(given):
                    raise typer.BadParameter(f"{name} is given no name. Is a variable of the shell not set?", ctx=ctx)
        return rest

    def invoke(self, ctx: Any) -> Any:
        """Call the verb; translate what it raises.

        Raises:
            typer.Exit: with the exit code of the failure.
        """
        as_json, verbose = ctx.params.get("as_json", False), ctx.params.get("verbose", False)
        try:
            with warnings.catch_warnings():
                warnings.showwarning = _show_warning
                return super().invoke(ctx)
        except FairleadError as error:
            echo(_as_json(error) if as_json else str(error), err=not as_json)
            if verbose:
                echo(traceback.format_exc(), err=True)
            raise typer.Exit(error.exit_code) from error
        except Exception as error:
            if _belongs_to_typer(error):
                raise
            if told := _of_disk(error, ctx.params) or _of_changed_results(ctx.params):
                echo(_as_json(told) if as_json else str(told), err=not as_json)
                raise typer.Exit(told.exit_code) from error
            echo(_report_text(error, verbose), err=True)
            raise typer.Exit(UNFORESEEN) from error


def fault_record(fault: Fault) -> dict[str, object]:
    """A fault as JSON: file, line and column are null when it has no place in a file."""
    where = fault.where
    return {
        "file": where.file if where else None,
        "line": where.line if where else None,
        "column": where.column if where else None,
        "what": fault.what,
        "way_out": fault.way_out,
    }


def _as_json(error: FairleadError) -> str:
    all_faults = error.faults if isinstance(error, ModelError) else ()
    faults = [fault_record(fault) for fault in all_faults[:MOST_FAULTS_TOLD]]
    told = {"ok": False, "exit_code": error.exit_code, "error": str(error), "faults": faults, "warnings": []}
    return json.dumps(told, indent=2)


def _of_disk(error: Exception, given: dict[str, Any]) -> FairleadError | None:
    """The sentence about a disk that refuses a place that was named, or the default one; None for other errors."""
    if not isinstance(error, OSError) or not isinstance(error.filename, str | bytes):
        return None
    from fairlead.cli.places import told_of_disk

    file = pathlib.Path(os.fsdecode(error.filename)).absolute()
    words = [one for each in given.values() for one in (each if isinstance(each, list) else [each])]
    named = [one for one in words if isinstance(one, pathlib.Path)]
    named += [pathlib.Path(one) for one in words if isinstance(one, str) and one and pathlib.Path(one).is_dir()]
    if any(one.absolute() in (file, *file.parents) for one in (*named, pathlib.Path("results"))):
        return FairleadError(told_of_disk(file, error))
    return None


def _of_changed_results(given: dict[str, Any]) -> FairleadError | None:
    """The sentence about a run.json that was changed since its run, which a verb that reads it may not survive."""
    words = [one for each in given.values() for one in (each if isinstance(each, list | tuple) else [each])]
    folders = [pathlib.Path(one) for one in words if isinstance(one, str | pathlib.Path)]
    if not any(map(_holds_a_run, folders)):
        return None
    from fairlead.results import run_file
    from fairlead.results.damage import DamagedResultsError

    what = "its entries are not those that the run left (SHA-256), and one of them cannot be used."
    return next((DamagedResultsError(one / run_file.RUN_FILE, what) for one in folders if run_file.is_changed(one)),
                None)  # fmt: skip


def _holds_a_run(folder: pathlib.Path) -> bool:
    try:
        return (folder / "run.json").is_file()
    except OSError:  # too long for a name
        return False


def _belongs_to_typer(error: Exception) -> bool:
    """Usage errors and exits are printed by typer; a closed pipe (`| head`) is nobody's mistake."""
    return isinstance(error, typer.Exit | typer.Abort | BrokenPipeError | USAGE_ERRORS)


def _report_text(error: Exception, verbose: bool) -> str:
    """What to send when fairlead itself is wrong; -v adds the traceback."""
    import importlib.metadata
    import platform

    last = traceback.extract_tb(error.__traceback__)[-1]
    head = (
        "This is a mistake in fairlead, not in your netlist. Please send these lines and the netlist to the\n"
        "fairlead developers (CONTRIBUTING.md says where):\n"
        f"    {type(error).__name__}: {error}\n"
        f"    in {last.name}, {last.filename}:{last.lineno}\n"
        f"    fairlead {importlib.metadata.version('fairlead')}, Python {platform.python_version()}, "
        f"{platform.platform()}\n"
        f"    command: fairlead {' '.join(sys.argv[1:])}"
    )
    if verbose:
        return f"{head}\n\n{''.join(traceback.format_exception(error))}"
    return f"{head}\nThe same command with -v adds the traceback."


def _show_warning(message: Warning | str, category: type[Warning], *_: Any, **__: Any) -> None:
    """One line on standard error, without the line of ours that happened to notice."""
    echo(f"warning: {message}", err=True)
