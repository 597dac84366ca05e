"""`viscorig report`: a session as one page."""

from pathlib import Path

import click

from instrument.cli.options import acceleration_option, file_argument, json_option
from instrument.cli.output import Output
from instrument.errors import BadInput
from instrument.facts.written import ReportResult
from instrument.progress import bar
from instrument.report.page import report_page
from instrument.session.contents import contents_of
from instrument.session.storage import SessionFile


@click.command()
@file_argument("session")
@click.option(
    "--out",
    type=click.Path(path_type=Path, dir_okay=False),
    help="The page (.html); beside the session otherwise.",
)
@acceleration_option
@json_option
def report(session: Path, out: Path | None, json_path: str | None) -> None:
    """SESSION.h5 as one self-contained HTML page: figures inside it, nothing fetched from anywhere."""
    output = Output(json_path)
    page = out if out is not None else session.with_suffix(".html")
    if not page.parent.is_dir():
        # Said before the work, not after it.
        raise BadInput(f"{page}: no such folder to write to")
    with SessionFile(session) as file:
        contents = contents_of(file)
    text = report_page(contents, bar)
    try:
        page.write_text(text, encoding="utf-8")
    except OSError as error:
        raise BadInput(f"{page}: {error.strerror or error}") from None
    output.say(f"wrote {page}")
    output.result(ReportResult(report=str(page)))
