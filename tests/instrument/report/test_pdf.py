"""The report on sheets of A4: all of it, inside the margins, page after page."""

import pytest
from matplotlib.figure import Figure
from matplotlib.image import imread
from matplotlib.text import Text

from instrument.report.blocks import FactsBlock, FigureBlock, ReportSection, Sentence, TableBlock
from instrument.report.paper import HEIGHT_MM, INSIDE_MM, MARGIN_MM, WIDTH_MM, broken, width_mm
from instrument.report.pdf import save_pdf, save_pictures, sheets_of

LONG = "a_name_without_a_place_to_break_it_" * 4
COLUMNS = ("step", "f / Hz", "remark")
ROWS = tuple((str(k), f"{500 + k}", "weak light, " * (k % 9)) for k in range(90))


def drawing():
    figure = Figure(figsize=(11.0, 4.0), layout="constrained")
    for ax in figure.subplots(1, 3):
        ax.plot([1, 2, 3], [1e-3, 2e-3, 5e-3], label="measured")
        ax.set_ylabel("|v / a| / ms")
        ax.set_title("Segment")
    figure.legend(*figure.axes[0].get_legend_handles_labels(), loc="outside upper center")
    return figure


@pytest.fixture(scope="module")
def laid():
    sections = (
        ReportSection("Facts", (FactsBlock("Of names", (("name", LONG), (LONG, "short"))),)),
        ReportSection("Said", (Sentence("well " * 60, "warning"), Sentence(f"{LONG} \x1b[2J", "note"))),
        ReportSection("Table", (TableBlock("All points", COLUMNS, ROWS),)),
        ReportSection("Drawn", (FigureBlock(drawing(), "a drawing"), FigureBlock(drawing(), "again"))),
    )
    return sheets_of("A title", (("operator", "A. Tester"),), sections)


def texts(page):
    return [one for one in page.findobj(Text) if one.get_text()]


def test_every_word_lies_inside_the_margins(laid):
    assert any(texts(page) for page in laid.pages)
    for page in laid.pages:
        for one in texts(page):
            x, y = one.get_position()
            wide = width_mm(one.get_text(), one.get_fontsize(), one.get_fontweight() == "bold")
            left = WIDTH_MM * x - (wide if one.get_horizontalalignment() == "right" else 0.0)
            assert MARGIN_MM - 0.2 <= left <= left + wide <= WIDTH_MM - MARGIN_MM + 0.2, one.get_text()
            assert 0.02 < y < 1 - MARGIN_MM / HEIGHT_MM


def test_nothing_is_left_out_and_every_page_has_the_head_of_its_table(laid):
    said = [[one.get_text() for one in texts(page)] for page in laid.pages]
    of_table = [page for page in said if "f / Hz" in page]
    assert len(of_table) > 1
    frequencies = [row[1] for row in ROWS]
    assert [text for page in said for text in page if text in frequencies] == frequencies
    assert [page[-1] for page in said] == [f"page {k} of {len(said)}" for k in range(1, len(said) + 1)]
    assert "measured by, date" in said[-1]


def test_a_table_begins_where_its_first_row_has_room():
    for lines in range(20, 60):
        said = ReportSection("Said", tuple(Sentence("well") for _ in range(lines)))
        table = ReportSection("Table", (TableBlock("Much", ("what", "why"), (("row " * 90, "row"),)),))
        for page in sheets_of("A title", (), (said, table)).pages:
            words = " ".join(one.get_text() for one in texts(page)).split()
            assert ("why" in words) == ("row" in words)


def test_a_head_is_not_broken_within_a_word_where_the_cells_are_long():
    heads = ("step", "explanations_left", *(f"quantity{k} / (m/s)" for k in range(8)))
    cells = ("44", "sentinel", *["1234567890123456789"] * 8)
    section = ReportSection("Table", (TableBlock("Wide", heads, (cells,), words=()),))
    (page,) = sheets_of("A title", (), (section,)).pages
    said = {word for one in texts(page) for word in one.get_text().split()}
    assert {"explanations_left", "quantity0", "quantity7", "(m/s)"} <= said


def test_what_no_paper_shows_is_not_on_it(laid):
    assert any(texts(page) for page in laid.pages)
    assert not any("\x1b" in one.get_text() for page in laid.pages for one in texts(page))


def test_a_figure_and_its_legend_lie_where_there_is_room(laid):
    (page, *_) = [p for p in laid.pages if p._laid]
    page.draw_without_rendering()
    for figure in page._laid:
        figure.draw_without_rendering()
        (legend,) = figure.legends
        boxes = [ax.get_tightbbox() for ax in figure.axes] + [legend.get_window_extent()]
        for box in boxes:
            low, high = box.transformed(figure.transFigure.inverted()).get_points()
            assert MARGIN_MM / WIDTH_MM - 0.01 < low[0] < high[0] < 1 - MARGIN_MM / WIDTH_MM + 0.01
            assert 0.0 < low[1] < high[1] < 1 - MARGIN_MM / HEIGHT_MM + 0.01
        assert not any(ax.get_tightbbox().overlaps(legend.get_window_extent()) for ax in figure.axes)
    tops = [figure.legends[0].get_window_extent().y1 for figure in page._laid]
    assert len(set(tops)) == len(tops)


def test_a_word_longer_than_a_line_is_broken():
    lines = broken(LONG, INSIDE_MM, 9.0)
    assert "".join(lines) == LONG
    assert all(width_mm(line, 9.0) <= INSIDE_MM for line in lines)


def test_the_file_is_a_pdf_of_a4_with_letters_in_it(tmp_path):
    path = tmp_path / "report.pdf"
    save_pdf(path, "A title", (("operator", "A. Tester"),), ())
    raw = path.read_bytes()
    assert raw.startswith(b"%PDF-")
    # 210 by 297 mm in points of 1/72 inch.
    assert b"/MediaBox [ 0 0 595.2755905512 841.8897637795 ]" in raw
    assert b"/FontFile2" in raw


def test_a_picture_of_every_sheet_is_as_large_as_the_paper(tmp_path):
    section = ReportSection("Said", tuple(Sentence("well " * 400) for _ in range(4)))
    names = save_pictures(tmp_path / "sheet.png", "A title", (("operator", "A. Tester"),), (section,))
    assert [name.name for name in names] == [f"sheet-{k:02d}.png" for k in range(1, len(names) + 1)]
    assert len(names) > 1
    for name in names:
        high, wide = imread(name).shape[:2]
        assert (wide, high) == pytest.approx((300 * WIDTH_MM / 25.4, 300 * HEIGHT_MM / 25.4), abs=1)
