"""A session's report on sheets of A4: the sections of the page, to be printed and signed."""

from collections.abc import Sequence
from pathlib import Path

import matplotlib as mpl
from matplotlib.backends.backend_pdf import PdfPages

from instrument.files.at_once import at_once
from instrument.report.blocks import FactsBlock, FigureBlock, ReportSection, Sentence, TableBlock
from instrument.report.paper import INSIDE_MM, MARGIN_MM, Sheets, broken, line_mm, width_mm
from instrument.results.typeset import typeset

_TITLE_PT, _HEAD_PT, _TEXT_PT, _TABLE_PT, _LEAST_PT = 15.0, 11.5, 9.0, 7.5, 6.0
_KEPT_MM = 28.0
"""Under a heading, on the same page."""
_BETWEEN_MM = 4.0
"""Columns of a table."""
_GROUNDS = {"note": ("#f4f7fa", "#0b63a5"), "warning": ("#fdf1e3", "#c2571a")}
_PAPER_DPI = 300
"""What a laser printer shows."""
_NOTES_MM, _SIGN_MM = 60.0, 14.0
_HAIR_MM = 0.1
"""That a column is wider than its text."""


def save_pdf(
    path: Path, title: str, header: Sequence[tuple[str, str]], sections: Sequence[ReportSection]
) -> None:
    """Write the pages. Raises `BadInput`."""
    sheets = sheets_of(title, header, sections)
    with (
        mpl.rc_context({"pdf.fonttype": 42}),
        at_once(path) as draft,
        PdfPages(draft, metadata={"Title": title, "Creator": "viscorig"}) as pdf,
    ):
        for page in sheets.pages:
            pdf.savefig(page)


def save_pictures(
    path: Path, title: str, header: Sequence[tuple[str, str]], sections: Sequence[ReportSection]
) -> tuple[Path, ...]:
    """Sheets of A4 as pictures for paper: NAME-01.png and so on. Raises `BadInput`."""
    pages = sheets_of(title, header, sections).pages
    names = tuple(path.with_name(f"{path.stem}-{k:02d}{path.suffix}") for k in range(1, len(pages) + 1))
    # Letters fitted to the pixels would be wider than the lines they were broken into.
    with mpl.rc_context({"text.hinting": "no_hinting"}):
        for name, page in zip(names, pages, strict=True):
            # Kept for as long as printing takes: small is not worth the time.
            with at_once(name) as draft:
                page.savefig(draft, format="png", dpi=_PAPER_DPI, pil_kwargs={"compress_level": 1})
    return names


def sheets_of(title: str, header: Sequence[tuple[str, str]], sections: Sequence[ReportSection]) -> Sheets:
    """Everything laid out: head, sections, room for notes and signatures."""
    sheets = Sheets()
    for line in broken(title, INSIDE_MM, _TITLE_PT, bold=True):
        sheets.text(MARGIN_MM, line, _TITLE_PT, bold=True)
        sheets.gap(line_mm(_TITLE_PT))
    sheets.gap(2.0)
    _facts(sheets, FactsBlock("", tuple(header)))
    for section in sections:
        _head(sheets, section.title)
        for block in section.blocks:
            match block:
                case Sentence():
                    _sentence(sheets, block)
                case FactsBlock():
                    _facts(sheets, block)
                case TableBlock():
                    _table(sheets, block)
                case FigureBlock():
                    _picture(sheets, block)
    _signed(sheets)
    sheets.foot(title)
    return sheets


def _head(sheets: Sheets, title: str) -> None:
    sheets.gap(5.0)
    sheets.need(_KEPT_MM)
    sheets.text(MARGIN_MM, title, _HEAD_PT, bold=True)
    sheets.gap(line_mm(_HEAD_PT))
    sheets.rule()
    sheets.gap(2.0)


def _subtitle(sheets: Sheets, title: str, below_mm: float = 12.0) -> None:
    """With what has to stand below it on the same page, also where there is no title."""
    lines = broken(title, INSIDE_MM, _TEXT_PT, bold=True) if title else []
    sheets.need(len(lines) * line_mm(_TEXT_PT) + below_mm)
    for line in lines:
        sheets.text(MARGIN_MM, line, _TEXT_PT, bold=True)
        sheets.gap(line_mm(_TEXT_PT))
    sheets.gap(0.8 if lines else 0.0)


def _sentence(sheets: Sheets, sentence: Sentence) -> None:
    ground = _GROUNDS.get(sentence.tone)
    inset = 4.0 if ground else 0.0
    lines = broken(typeset(sentence.text), INSIDE_MM - 2 * inset, _TEXT_PT)
    high = len(lines) * line_mm(_TEXT_PT)
    sheets.need(high + 3.0)
    if ground:
        sheets.box(MARGIN_MM, INSIDE_MM, high + 2.0, ground[0])
        sheets.box(MARGIN_MM, 0.8, high + 2.0, ground[1])
        sheets.gap(0.8)
    for line in lines:
        sheets.text(MARGIN_MM + inset, line, _TEXT_PT)
        sheets.gap(line_mm(_TEXT_PT))
    sheets.gap(2.5)


def _facts(sheets: Sheets, facts: FactsBlock) -> None:
    _subtitle(sheets, facts.title)
    names = min(max((width_mm(name, _TEXT_PT) for name, _ in facts.rows), default=0.0), 0.4 * INSIDE_MM)
    at = names + _BETWEEN_MM
    for name, value in facts.rows:
        left = broken(name, names, _TEXT_PT)
        right = broken(typeset(value), INSIDE_MM - at, _TEXT_PT)
        sheets.need(max(len(left), len(right)) * line_mm(_TEXT_PT))
        for k in range(max(len(left), len(right))):
            if k < len(left):
                sheets.text(MARGIN_MM, left[k], _TEXT_PT, soft=True)
            if k < len(right):
                sheets.text(MARGIN_MM + at, right[k], _TEXT_PT)
            sheets.gap(line_mm(_TEXT_PT))
    sheets.gap(3.0)


def _table(sheets: Sheets, table: TableBlock) -> None:
    rows = [[typeset(cell) for cell in row] for row in table.rows]
    cells = [table.columns, *rows]
    size, widths = _widths(cells)
    natural = _natural(cells, size)
    # Numbers end below each other; what had to be broken into lines reads from the left.
    right = [
        k > 0 and widths[k] >= natural[k] and table.columns[k] not in table.words for k in range(len(widths))
    ]
    head = _row_lines(table.columns, widths, size, bold=True)
    every = [_row_lines(row, widths, size) for row in rows]
    first_mm = _row_mm(head, size) + (_row_mm(every[0], size) if every else 0.0)
    _subtitle(sheets, table.title, first_mm)
    _row(sheets, head, widths, right, size, bold=True)
    for lines in every:
        if sheets.need(_row_mm(lines, size)):
            _row(sheets, head, widths, right, size, bold=True)
        _row(sheets, lines, widths, right, size)
    sheets.gap(3.0)


def _widths(cells: Sequence[Sequence[str]]) -> tuple[float, list[float]]:
    """Size of type and widths of columns in mm: smaller type first, then the widest are broken."""
    size = _TABLE_PT
    while True:
        natural = _natural(cells, size)
        room = INSIDE_MM - _BETWEEN_MM * (len(natural) - 1)
        if sum(natural) <= room:
            return size, natural
        if size <= _LEAST_PT:
            break
        size -= 0.5
    # No head is broken within a word, where there is room for that.
    least = [
        max(_HAIR_MM + width_mm(word, size, bold=True) for word in text.split() or [""]) for text in cells[0]
    ]
    if sum(least) > room:
        least = [0.0] * len(natural)
    most = max(natural)
    while sum(widths := [min(w, max(most, low)) for w, low in zip(natural, least, strict=True)]) > room:
        most *= 0.97
    return size, widths


def _natural(cells: Sequence[Sequence[str]], size: float) -> list[float]:
    """Of columns in one line each. A hair wider, or rounding breaks what fits."""
    return [
        _HAIR_MM + max(width_mm(text, size, bold=k == 0) for k, text in enumerate(column))
        for column in zip(*cells, strict=True)
    ]


def _row_lines(
    row: Sequence[str], widths: Sequence[float], size: float, *, bold: bool = False
) -> list[list[str]]:
    return [broken(text, width, size, bold) for text, width in zip(row, widths, strict=True)]


def _row_mm(lines: Sequence[Sequence[str]], size: float) -> float:
    return max(len(one) for one in lines) * line_mm(size) + 0.8


def _row(
    sheets: Sheets,
    lines: Sequence[Sequence[str]],
    widths: Sequence[float],
    right: Sequence[bool],
    size: float,
    *,
    bold: bool = False,
) -> None:
    for k in range(max(len(one) for one in lines)):
        x = MARGIN_MM
        for text, width, ends in zip(lines, widths, right, strict=True):
            if k < len(text):
                sheets.text(x + width * ends, text[k], size, bold=bold, right=ends)
            x += width + _BETWEEN_MM
        sheets.gap(line_mm(size))
    sheets.gap(0.4)
    sheets.rule()
    sheets.gap(0.4)


def _picture(sheets: Sheets, picture: FigureBlock) -> None:
    sheets.figure(picture.figure)
    for line in broken(picture.title, INSIDE_MM, _TABLE_PT):
        sheets.text(MARGIN_MM, line, _TABLE_PT, soft=True)
        sheets.gap(line_mm(_TABLE_PT))
    sheets.gap(3.0)


def _signed(sheets: Sheets) -> None:
    sheets.gap(5.0)
    sheets.need(_NOTES_MM + 2 * _SIGN_MM + 14.0)
    _head(sheets, "Notes and signature")
    sheets.box(MARGIN_MM, INSIDE_MM, _NOTES_MM, "#bbbbbb", filled=False)
    sheets.gap(_NOTES_MM)
    for said in ("measured by, date", "checked by, date"):
        sheets.gap(_SIGN_MM - line_mm(_TEXT_PT))
        sheets.text(MARGIN_MM, said, _TEXT_PT, soft=True)
        sheets.gap(line_mm(_TEXT_PT))
        sheets.rule(MARGIN_MM + 40.0, INSIDE_MM - 40.0, "#000000")
