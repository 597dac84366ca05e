"""The sections of a report, one by one, of a session made by hand."""

import base64
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from matplotlib.figure import Figure
from session_cases import GAIN

from fitting.data.aside import LOST, reasons
from instrument.errors import NOT_SILENT
from instrument.files.acceleration import show_acceleration_in
from instrument.interchange.point_table import columns
from instrument.interchange.read_session import read_session
from instrument.report.blocks import FigureBlock, Sentence, TableBlock
from instrument.report.calibration import calibration_section
from instrument.report.ending import ending_section, missing_parts
from instrument.report.fitted import ReportedFit
from instrument.report.hammer import hammer_section
from instrument.report.measured import segments_of
from instrument.report.picture import as_svg
from instrument.report.sweep import sweep_section
from instrument.report.sweep_figures import quality_figure, response_figures
from instrument.results.set_aside import NAME
from instrument.session.points import sweep_of
from instrument.stream.raw import SessionEnded


def blocks(section, kind):
    return [block for block in section.blocks if isinstance(block, kind)]


HIT_SHORT = "The hammer test has 2 good hits of 3 asked for."


def test_a_double_hit_is_missing_and_without_a_hammer_test_nothing_is(contents):
    assert missing_parts(contents) == [HIT_SHORT]
    config = contents.configuration
    asked = config.model_copy(update={"experiment": config.experiment.model_copy(update={"hammer": None})})
    first, second = blocks(ending_section(replace(contents, configuration=asked)), Sentence)
    assert first.text == "The run came to its planned end."
    assert second.text == "Everything the experiment asked for was measured."


def test_each_way_to_end_has_its_sentence(contents):
    def first(ended):
        return ending_section(replace(contents, ended=ended)).blocks[0].text

    assert first(None).startswith("The recording stops without an end")
    assert first(SessionEnded("stopped by the user", "")) == "The user stopped the run."
    assert first(SessionEnded("stopped safely", "too hot")) == "The rig stopped itself: too hot"
    assert (
        first(SessionEnded(NOT_SILENT, "SWITCH IT OFF: no word")) == f"SWITCH IT OFF: no word ({NOT_SILENT})."
    )


def test_what_was_not_measured_is_said_part_by_part(contents):
    bare = replace(contents, hits=[], calibrations={}, segments={})
    assert missing_parts(bare) == [
        "No hammer test was made.",
        "The vibrometer was not calibrated in place.",
        "No sweep was made.",
    ]
    key = next(iter(contents.segments))
    cut = {**contents.segments, key: replace(contents.segments[key], ended=False)}
    short, said = missing_parts(replace(contents, segments=cut))
    assert short == HIT_SHORT
    assert said.startswith(f"Segment {key[1]} of sweep {key[0]} is not complete: ")
    del cut[key]
    assert missing_parts(replace(contents, segments=cut)) == [
        HIT_SHORT,
        f"Segment {key[1]} of sweep {key[0]} was not begun.",
    ]


def test_a_calibration_is_a_row_a_range_and_nothing_is_left_of_its_points(contents):
    section = calibration_section(contents)
    (table,), (picture,) = blocks(section, TableBlock), blocks(section, FigureBlock)
    assert [row[0] for row in table.rows] == list(contents.calibrations)
    assert float(table.rows[0][1].split()[0]) == pytest.approx(GAIN, rel=0.01)
    gain, _ = picture.figure.axes
    for line in gain.lines[: len(contents.calibrations)]:
        assert np.abs(line.get_ydata()).max() < 1.0
    none = calibration_section(replace(contents, calibrations={}))
    assert "not calibrated in place" in none.blocks[0].text


def test_a_hit_left_out_says_why_and_the_run_had_found_the_same(contents):
    section = hammer_section(contents)
    hits, modes = blocks(section, TableBlock)
    assert len(hits.rows) == len(contents.hits)
    assert len(modes.rows) == len(contents.damping.result.modes)
    said = [block.text for block in blocks(section, Sentence)]
    assert "The run itself had found the same from these hits." in said
    none = hammer_section(replace(contents, hits=[]))
    assert none.blocks[0].text == "There is no hammer test in this session."
    pair = SimpleNamespace(specimen=SimpleNamespace(kind="shear-pair"), hits=[])
    assert hammer_section(pair).title == "Hammer test"


def test_a_page_without_a_fit_says_so_and_draws_what_was_measured(contents):
    section = sweep_section(contents, ReportedFit(None, "no law"))
    pictures = blocks(section, FigureBlock)
    assert "no model is drawn, as there is no fit" in pictures[0].title
    assert ReportedFit(None).over_base(np.array([20.0])) is None
    assert len(blocks(section, TableBlock)[-1].rows) == len(contents.measured)
    empty = sweep_section(replace(contents, points=[]), ReportedFit(None))
    assert empty.blocks[0].text == "There is no point of a sweep in this session."


def test_what_a_fit_set_aside_is_drawn_and_listed_apart(contents):
    n = len(contents.measured)
    lost = reasons(np.arange(n) == 4, LOST)
    sweep = sweep_of(contents.measured)
    fit = SimpleNamespace(given=sweep, why_aside=lost)
    without_model = SimpleNamespace(
        fit=None, points_set_aside=ReportedFit(fit).points_set_aside, over_base=lambda f: None
    )
    section = sweep_section(contents, without_model)
    (table,) = (b for b in blocks(section, TableBlock) if "set aside" in b.title)
    assert table.title == "1 reading set aside, not fitted"
    assert [row[0] for row in table.rows] == [str(contents.measured[4].step)]
    figure = blocks(section, FigureBlock)[0].figure
    drawn = [line for ax in figure.axes for line in ax.lines if line.get_label() == NAME]
    assert [line.get_xdata().tolist() for line in drawn] == 2 * [[contents.measured[4].frequency_hz]]


def test_quality_is_drawn_point_after_point(contents):
    _, control, _, _ = quality_figure(contents).axes
    drawn = control.lines[0]
    assert drawn.get_xdata().tolist() == [p.step for p in contents.measured]
    assert drawn.get_ydata() == pytest.approx([p.control_error_percent for p in contents.measured])


@pytest.mark.parametrize(("unit", "under", "m_s2"), [("m/s2", "(m/s\u00b2)", 1.0), ("g", "g", 9.80665)])
def test_velocity_over_acceleration_is_drawn_in_the_unit_on_its_axis(contents, unit, under, m_s2):
    (first, *_) = segments_of(contents)
    show_acceleration_in(unit)
    try:
        above = response_figures([first], ReportedFit(None))[0].axes[0]
    finally:
        show_acceleration_in("m/s2")
    assert above.get_ylabel() == f"|v/a| / (mm/s)/{under}"
    drawn = next(c for c in above.containers if c.get_label().startswith("measured")).lines[0]
    assert drawn.get_ydata() == pytest.approx(1e3 * m_s2 * np.abs(first.over_base[first.kept]))


def test_steps_that_do_not_begin_at_one_are_explained(contents):
    def caption(first_step):
        points = [
            replace(p, point=replace(p.point, step=first_step + k)) for k, p in enumerate(contents.points)
        ]
        section = sweep_section(replace(contents, points=points), ReportedFit(None))
        return next(f.title for f in blocks(section, FigureBlock) if "How well" in f.title)

    assert caption(44).endswith("; steps 1 to 43 of the run were its loop check and calibration")
    assert caption(1).endswith("in the order of measuring")


def test_a_picture_is_the_same_bytes_for_the_same_figure():
    def made(y):
        figure = Figure(figsize=(1, 1))
        figure.add_axes((0, 0, 1, y)).set_axis_off()
        figure.axes[0].plot([0, 1])
        return as_svg(figure)

    head, _, body = made(1).partition(",")
    assert head == "data:image/svg+xml;base64"
    assert b"<svg" in base64.b64decode(body)
    assert made(1) == made(1) != made(0.5)


def test_what_is_exported_and_read_beside_is_what_was_measured(contents, session_path):
    by_name = {c.name: c for c in columns(contents)}
    assert len(by_name["frequency_hz"].values) == len(contents.points)
    assert by_name["frequency_hz"].unit == "Hz"
    (beside,) = read_session(session_path).sweeps
    steps = [t.point for t in contents.points if t.point.purpose == "step"]
    assert beside["frequency_hz"].tolist() == [p.frequency_hz for p in steps]
    assert beside["velocity_im_m_s"].tolist() == [p.velocity_m_s.imag for p in steps]
