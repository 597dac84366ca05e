"""The report: one page that holds everything, and says what is missing."""

import base64
import re
import shutil
from html import unescape
from html.parser import HTMLParser
from pathlib import Path
from xml.etree import ElementTree

import pytest
from diagnosed_session import diagnosed_session
from diagnosis_cases import diagnosis
from report_pages import page_of, row, section, text_of
from session_cases import GAIN, SyntheticSession, configuration

from instrument.cli.main import run
from instrument.files.acceleration import show_acceleration_in
from instrument.files.column import ColumnPoint
from instrument.files.point_columns import in_report
from instrument.report.setting import rig_section
from instrument.results.diagnosis_words import verdict_line
from instrument.results.session_result import recorded_result
from instrument.results.typeset import quantity, typeset
from instrument.session.contents import contents_of
from instrument.session.storage import SessionFile

SECTIONS = (
    "How it ended",
    "Specimen",
    "Rig",
    "Hammer test of the bare plate",
    "Calibration in place",
    "Sweep of the damped plate",
    "Identification of the core",
    "What the fit cannot explain",
    "Versions",
)


@pytest.fixture(scope="module")
def page(session_path):
    return page_of(session_path)


class Well(HTMLParser):
    """Every tag closed in its turn."""

    void = ("meta", "br", "img", "hr", "link")

    def __init__(self):
        super().__init__()
        self.open = []

    def handle_starttag(self, tag, attrs):
        if tag not in self.void:
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag


# The whole page


def test_it_is_well_formed(page):
    parser = Well()
    parser.feed(page)
    assert parser.open == []


def test_every_section_is_there_in_order(page):
    assert tuple(unescape(t) for t in re.findall(r"<h2>(.*?)</h2>", page)) == (
        *SECTIONS,
        "Notes and signature",
    )


def test_a_report_fetches_nothing_from_elsewhere(page):
    sources = re.findall(r'(?:src|href)="([^"]*)"', page)
    assert all(s.startswith(("data:", "#")) for s in sources)
    assert "url(" not in page
    assert "@import" not in page
    assert "<script" not in page
    assert "default-src 'none'" in unescape(page)


def test_links_lead_to_sections(page):
    anchors = re.findall(r'href="#([^"]*)"', page)
    assert len(anchors) == len(SECTIONS)
    assert all(f'id="{a}"' in page for a in anchors)


def test_figures_are_svg_of_their_own(page):
    figures = re.findall(r'src="data:image/svg\+xml;base64,([^"]*)" alt="([^"]+)"', page)
    assert len(figures) == 7
    assert figures[0][1].startswith("A drawing with: ")
    assert "Storage modulus G' / MPa from" in unescape(" ".join(words for _, words in figures))
    # What is read in the place of a figure is not what stands below it.
    captions = re.findall(r"<figcaption>(.*?)</figcaption>", page)
    assert "The specimen to scale" in captions
    assert not {words for _, words in figures} & set(captions)
    for data, _ in figures:
        root = ElementTree.fromstring(base64.b64decode(data))
        assert root.tag.endswith("svg")


def test_tables_say_what_they_are_and_which_cells_are_heads(page):
    heads = re.findall(r"<th\b[^>]*>", page)
    assert heads
    assert all('scope="col"' in head for head in heads)
    tables = re.findall(r"<table([^>]*)>\s*(<caption[^>]*>.+?</caption>)?", page)
    assert any(caption for _, caption in tables)
    assert all("aria-label" in label or caption for label, caption in tables)


def test_it_is_dark_where_that_is_preferred_and_prints_light(page):
    assert "prefers-color-scheme: dark" in page
    assert "@media print" in page
    # Figures too, and on a screen alone.
    (query,) = re.findall(r"@media ([^{]*) \{\n  figure img \{ filter: invert", page)
    assert query == "screen and (prefers-color-scheme: dark)"


def test_a_page_that_is_printed_has_a_margin(page):
    assert "@page { margin: 18mm; }" in page


def test_foreign_text_is_escaped(page):
    assert "ZN_1 &lt;second&gt; &amp; last" in page
    assert "<second>" not in page


# Its sections


def test_specimen_with_units(page):
    words = section(page, "Specimen")
    assert "thickness / mm" in words
    assert "substrate 1.9 68.9 0.3 2700" in words
    assert "velocity absolute" in words


def test_rig_names_instruments_sensors_and_mounting(page):
    words = section(page, "Rig")
    assert "PDV-100 no. 7" in words
    assert "base 1 10.2 mV/(m/s²) 10 yes no 4711 2026-03-02" in words
    assert "response (0.6 g)" in words
    assert "bolts 6 torque 4.5 N m remounted once" in words


def test_in_g_levels_and_sensitivities_are_in_g(session_path):
    show_acceleration_in("g")
    try:
        with SessionFile(session_path) as file:
            contents = contents_of(file, with_hits=False)
        (_, sensors, *_) = rig_section(contents).blocks
        shown = {s.heading: s.text(ColumnPoint(contents.measured[-1])) for _, s in in_report()}
    finally:
        show_acceleration_in("m/s2")
    # 10.2 mV/(m/s^2) at 9.80665 m/s^2 to the g.
    assert sensors.rows[0][2] == "100.028 mV/g"
    assert shown["level / g"] == "0.5002"


def test_hammer_lists_hits_and_modes(page):
    words = section(page, "Hammer test of the bare plate")
    assert "left out double hit" in words
    assert "The run itself had found the same" in words
    assert "with the coherence of 2 hits" in words
    frequency, ratio, error = row(words, "remarks")[:3]
    assert 17.5 < frequency < 18
    assert ratio == pytest.approx(0.29, rel=0.01)
    assert 0 < error < 0.01


def test_calibration_gives_gain_and_delay_with_errors(page):
    gain, error, delay, _ = row(section(page, "Calibration in place"), "5mm/s/V")[:4]
    assert abs(gain - GAIN) < 4 * error
    assert delay == pytest.approx(1100, abs=1)


def test_sweep_lists_remarks_and_drift(page):
    words = section(page, "Sweep of the damped plate")
    assert "27 steps in 3 segments and 1 sweep at 4.905 m/s²: 27 steps and 4 sentinels, " in words
    assert "8 19 1 weak light: signal level 0.05" in words
    assert words.count("sentinel") >= 4
    assert "All 31 points" in words


def test_identification_gives_the_law_and_its_errors(page):
    words = section(page, "Identification of the core")
    value, error = row(words, "g0 / Pa")[:2]
    assert abs(value - 0.27e6) < 4 * error
    assert "Correlations" in words
    assert "The live identification of the run ended with the same parameters." in words
    assert "95 % bands" in words


def test_what_is_left_is_in_numbers(page):
    words = section(page, "What the fit cannot explain")
    assert "the model has no further effects" in words
    assert row(words, "rms difference in amplitude")[0] < 0.1
    assert 0 < row(words, "chi² per degree of freedom")[0] < 3
    assert "each segment predicted from the others" in words


def test_the_head_has_the_result_in_short(page):
    head = text_of("<body>" + page[page.index("<header>") : page.index("</header>")])
    assert "operator A. Tester" in head
    assert "100 Hz: G' 0.4" in head


def test_the_result_is_the_law_after_the_diagnosis(tmp_path):
    found = diagnosis()
    path = diagnosed_session(tmp_path, diagnosis=found)
    page = page_of(path)
    with SessionFile(path) as file:
        words = recorded_result(contents_of(file, with_hits=False)).words
    head = text_of("<body>" + page[page.index("<header>") : page.index("</header>")])
    assert typeset(words) in head
    assert typeset(verdict_line(found)) in typeset(words)
    assert "the law before the diagnosis" in section(page, "Identification of the core, before the diagnosis")


def test_the_law_to_use_has_its_table_and_parameters_before_the_law_without_the_effect(tmp_path):
    found = diagnosis()
    page = page_of(diagnosed_session(tmp_path, diagnosis=found))
    use = section(page, "Law to use, after the diagnosis")
    before = section(page, "Identification of the core, before the diagnosis")
    assert page.index("Law to use, after the diagnosis</h2>") < page.index("before the diagnosis</h2>")
    assert "This is the law to use." in use
    assert "The law after the diagnosis, with" in use
    parameters = use.split("Parameters after the diagnosis", 1)[1]
    assert all(quantity(name) in parameters for name in found.after.parameters)
    for title in ("the law in the band", "parameters", "correlations of", "residual:"):
        assert f"Before the diagnosis, not to be used: {title}" in before
    # One picture has both laws, where the one to use is.
    drawn = "law before and after the diagnosis; with 95 % bands"
    assert drawn in use
    assert text_of(page).count(drawn) == 1
    assert "Shear modulus and loss factor in the measured band" not in page
    assert "law before and after; " not in page


def test_a_diagnosis_without_an_effect_leaves_one_law_and_marks_none(page):
    assert "Law to use, after the diagnosis" not in page
    assert "not to be used" not in page


def test_a_law_that_nothing_explains_is_doubted_at_the_head_and_wherever_it_is_shown(tmp_path):
    page = page_of(diagnosed_session(tmp_path, diagnosis=diagnosis(verdict="unknown")))
    head = text_of("<body>" + page[page.index("<header>") : page.index("</header>")])
    warned = head.index("Verdict unknown: no law here is to be relied on.")
    assert warned < head.index("loss factor")
    words = section(page, "Identification of the core, before the diagnosis")
    for title in ("The law in the band", "Parameters", "Shear modulus and loss factor in the measured band"):
        at = words.index(title)
        assert "(verdict unknown)" in words[at : at + 110]


# The command


def test_the_page_goes_beside_the_session_and_is_the_same_every_time(capsys, tmp_path, page, session_path):
    path = Path(shutil.copy(session_path, tmp_path))
    assert run(["report", str(path)]) == 0
    written = path.with_suffix(".html")
    assert capsys.readouterr().out.strip() == f"wrote {written}"
    assert written.read_text(encoding="utf-8") == page


def test_sheets_to_print_are_written_beside_the_page_or_instead_of_it(capsys, tmp_path):
    synthetic = SyntheticSession(configuration())
    synthetic.begin()
    path = str(synthetic.save(tmp_path))
    page, beside, instead = (tmp_path / name for name in ("a.html", "a.pdf", "b.pdf"))
    assert run(["report", path, "--out", str(page), "--pdf", str(beside)]) == 0
    assert run(["report", path, "--out", str(instead)]) == 0
    assert capsys.readouterr().out.split("\n")[:3] == [f"wrote {p}" for p in (page, beside, instead)]
    assert page.read_text(encoding="utf-8").startswith("<!doctype html>")
    assert beside.read_bytes()[:5] == instead.read_bytes()[:5] == b"%PDF-"


@pytest.mark.parametrize(
    ("arguments", "word"),
    [
        (["none.h5"], "no such file"),
        (["{session}", "--out", "/none/page.html"], "no such folder"),
        (["{session}", "--pdf", "/none/page.pdf"], "no such folder"),
    ],
)
def test_what_cannot_be_done_is_refused_in_a_line(capsys, session_path, arguments, word):
    filled = [a.format(session=session_path) for a in arguments]
    assert run(["report", *filled]) == 2
    err = capsys.readouterr().err
    assert err.count("\n") == 1
    assert word in err
