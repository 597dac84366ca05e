"""`viscorig report`: a session as one page."""

from pathlib import Path

import click

from instrument.cli.options import acceleration_option, file_argument, json_option
from instrument.cli.output import Output
from instrument.errors import BadInput, system_words
from instrument.facts.written import ReportResult
from instrument.files.at_once import write_at_once
from instrument.files.replaceable import PAGE, PDF, PNG, refuse_ending, refuse_to_lose
from instrument.progress import bar
from instrument.report.page import report_of
from instrument.session.contents import contents_of
from instrument.session.storage import SessionFile

_PAGE, _SHEETS = (PAGE, PDF, PNG), (PDF,)
"""What the page may be, and what the sheets beside it."""


@click.command()
@file_argument("session")
@click.option(
    "--out",
    type=click.Path(path_type=Path, dir_okay=False),
    help="The page (.html; .pdf for sheets of A4, .png for a picture of each); beside the session otherwise.",
)
@click.option(
    "--pdf",
    type=click.Path(path_type=Path, dir_okay=False),
    metavar="FILE",
    help="The same on sheets of A4, to be printed and signed.",
)
@acceleration_option
@json_option
def report(session: Path, out: Path | None, pdf: Path | None, json_path: str | None) -> None:
    """SESSION.h5 as one self-contained HTML page: figures inside it, nothing fetched from anywhere."""
    output = Output(json_path)
    page = out if out is not None else session.with_suffix(".html")
    wanted = [page, *([pdf] if pdf is not None else [])]
    for path, kinds in zip(wanted, (_PAGE, _SHEETS), strict=False):
        refuse_ending(path, [ending for kind in kinds for ending in kind.endings])
        if not path.parent.is_dir():
            # Said before the work, not after it.
            raise BadInput(f"{path}: no such folder to write to")
        for kind in kinds:
            if path.suffix.lower() in kind.endings:
                refuse_to_lose(path, kind)
    with SessionFile(session) as file:
        contents = contents_of(file)
    made = report_of(contents, bar)
    sheets: tuple[Path, ...] = ()
    for path in wanted:
        try:
            if path is not pdf and path.suffix.lower() == ".png":
                sheets = made.save_pictures(path)
            elif path is pdf or path.suffix.lower() == ".pdf":
                made.save_pdf(path)
            else:
                write_at_once(path, made.html())
        except OSError as error:
            raise BadInput(f"{path}: {system_words(error)}") from None
        for written in sheets if path is page and sheets else (path,):
            output.say(f"wrote {written}")
    found = ReportResult(report=str(page), pdf=str(pdf) if pdf is not None else None)
    output.result(found.but(sheets=tuple(map(str, sheets))) if sheets else found)
