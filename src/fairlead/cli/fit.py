"""`fairlead fit`: parameters of a model from measured records, and which law the records prefer."""

import json
import pathlib
from typing import TYPE_CHECKING, Annotated, Any

import typer

from fairlead.cli.options import AsJson, Quiet, Verbose
from fairlead.cli.places import place, refuse_place
from fairlead.cli.terminal import echo

if TYPE_CHECKING:
    from fairlead.studies.fits.fit_file import Asked
    from fairlead.studies.fits.laws import Judged


def fit(
    file: Annotated[pathlib.Path, typer.Argument(help="A fit file: model, records, parameters (docs/studies.md).")],
    compare: Annotated[
        list[str] | None,
        typer.Option(metavar="NAME=A,B", help="Laws to compare, as values of a setting. Repeatable: all pairs."),
    ] = None,
    no_laws: Annotated[bool, typer.Option("--no-laws", help="Do not compare the laws of the fit file.")] = False,
    out: Annotated[
        pathlib.Path | None,
        typer.Option("--out", "-o", metavar="DIR", help="The report goes here. Default: results/NAME-fit."),
    ] = None,
    as_json: AsJson = False,
    quiet: Quiet = False,
    verbose: Verbose = False,
) -> None:
    """Fit parameters to measured records; tell what the records know of them, and which law they prefer."""
    from fairlead.studies.fits import page, report
    from fairlead.studies.fits.fit_file import laws_of_options, read_fit
    from fairlead.studies.fits.laws import compare as compare_laws
    from fairlead.studies.fits.search import errors, prepared
    from fairlead.studies.fits.search import fit as search

    refuse_place("--out", out or pathlib.Path("results") / "fit", folder=True)
    asked = read_fit(file)
    laws = laws_of_options(compare) if compare else () if no_laws else asked.laws
    told = None if quiet or as_json else lambda line: echo(line, err=True)
    judged = compare_laws(asked, laws, told) if laws else []
    law = _law(asked, judged)
    records, targets, chaotic = prepared(asked, law)
    trained = [one for one in targets if one.record.name not in asked.given.leave_out]
    known = next((one.fitted for one in judged if one.law.name == law.name), None)
    fitted = known if known is not None and not asked.given.leave_out else search(asked, trained, law, told)
    found = {one.name: errors(one, fitted.values) for one in records}
    record = report.record_of(asked, fitted, trained, found, chaotic, report.units_of(records))
    if law.name:
        record["law"] = law.name
    if judged:
        record["comparison"] = report.laws_record(judged)
    folder = out or pathlib.Path("results") / f"{records[0].cases.name}-fit"
    lines = list(report.lines_of(record))
    if law.name:
        lines.insert(0, f"law: {law.name}")
    of_laws = list(report.law_lines(judged)) if judged else []
    if as_json:
        echo(json.dumps(record, indent=2))
    elif not quiet:
        for line in [*of_laws, *lines]:
            echo(line)
    place(folder / "fit.json", json.dumps(record, indent=2))
    page.write_page(folder / "fit.html", f"Fit of {records[0].cases.name}", lines, _rows(judged), of_laws[-2:], records,
                    fitted.values)  # fmt: skip
    if not (as_json or quiet):
        echo(f"wrote {folder / 'fit.html'}")


def _law(asked: "Asked", judged: "list[Judged]") -> Any:
    """The law that the records prefer; that of the model where none are compared."""
    from fairlead.studies.fits.fit_file import Law
    from fairlead.studies.fits.laws import preferred

    name = preferred(judged) if judged else ""
    return next((one.law for one in judged if one.law.name == name), Law(""))


def _rows(judged: "list[Judged]") -> Any:
    from fairlead.studies.fits.report import table_of

    return table_of(judged) if judged else None
