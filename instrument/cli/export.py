"""`viscorig export`: a session to the files of another program."""

from pathlib import Path

import click

from instrument.cli.options import file_argument, json_option
from instrument.cli.output import Output
from instrument.cli.print_run import print_result
from instrument.facts.written import ExportResult
from instrument.interchange.exporting import FORMATS, Format, export_session
from instrument.results.session_result import recorded_result
from instrument.session.contents import contents_of
from instrument.session.storage import SessionFile


@click.command()
@file_argument("session")
@click.option(
    "--to",
    "to",
    type=click.Choice(FORMATS),
    required=True,
    help="uff: data sets 58, 151, 164. csv: for 'viscorig identify' and 'viscorig damping'. mat: MATLAB.",
)
@click.option(
    "--out",
    "folder",
    type=click.Path(path_type=Path, file_okay=False),
    default=Path(),
    help="Where the files go; the current folder otherwise.",
)
@json_option
def export(session: Path, to: Format, folder: Path, json_path: str | None) -> None:
    """SESSION.h5 as universal files, CSV or MATLAB: sweep, hits, damping. Prints the files written."""
    out = Output(json_path)
    with SessionFile(session) as file:
        contents = contents_of(file)
    written = export_session(contents, to, folder)
    for path in written.files:
        out.say(f"wrote {path}")
    for note in written.notes:
        out.say(f"note: {note}")
    result = recorded_result(contents) if contents.points else None
    if result is not None:
        print_result(out, result)
    files = tuple(str(path) for path in written.files)
    out.result(ExportResult(files=files, notes=tuple(written.notes), result=result))
