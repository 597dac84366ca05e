"""What a page says of an identification, of a session and a fit made by hand."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from diagnosis_cases import diagnosis as diagnosed
from diagnosis_cases import sweep
from matplotlib.figure import Figure
from paper_law import TABLE_4
from result_cases import identification

from fitting.data.aside import LOST, reasons
from fitting.data.noise import Noise
from fitting.identification.adjusted import Adjusted
from fitting.identification.fit import Fit
from fitting.identification.result import Identification, law_band
from fitting.identification.uncertainty import Uncertainty
from fitting.identification.validation import HeldOutSegment, Validation
from instrument.files.specimen_file import read_specimen
from instrument.finding.identification import Identified
from instrument.models.files import File
from instrument.paper_case import case_file
from instrument.report.blocks import FactsBlock, FigureBlock, Sentence, TableBlock
from instrument.report.fitted import ReportedFit
from instrument.report.identification import (
    identification_section,
    result_in_short,
    session_result,
    unexplained_section,
)
from instrument.report.law_figures import law_figure, residual_figures
from instrument.report.measured import Measured
from instrument.results.set_aside import NAME

SWEEP = sweep()
PLATE = read_specimen(case_file("zn1.toml"))
PULLED = (Adjusted("gain", 1.0, 0.02, 0.96, 0.01, -2.0, "1"),)


def found(std=0.01, *, noise="stated", adjusted=(), warnings=(), bound=None, **validation):
    """A law whose every parameter is known to a percent."""
    n = len(TABLE_4.values)
    uncertainty = Uncertainty(std**2 * np.eye(n), bound or {}, 1.25)
    v = SWEEP.response_m_s
    difference = np.tile([3.0, -4.0], len(v) // 2)
    return Identification(
        "direct",
        TABLE_4,
        Fit(
            TABLE_4,
            np.zeros(2 * len(v)),
            np.zeros((2 * len(v), n)),
            v,
            5,
            6,
            converged=True,
            adjusted=adjusted,
        ),
        uncertainty,
        Noise(np.abs(v), noise),
        np.abs(v),
        np.abs(v) * (1 + difference / 100),
        difference,
        Validation(**validation),
        law_band(SWEEP, TABLE_4, uncertainty),
        warnings,
    )


def reported(result, bare=None, specimen=PLATE, aside=0):
    why = reasons(np.arange(len(SWEEP)) < aside, LOST)
    taken = SWEEP.take(why == "")
    return ReportedFit(
        Identified(result, (File(SWEEP, specimen),), taken, SWEEP, why, 0.0, 0.0, 0.0, bare=bare)
    )


def contents(*, live=None, diagnosis=None, points=(), struck=()):
    """Of a session: what the run itself had found, its points, spectra of the struck plate."""
    return SimpleNamespace(fit=live, diagnosis=diagnosis, points=points, measured=points, struck=struck)


def live(parameters, points=0):
    result = identification(
        law_kind=TABLE_4.kind, parameters=parameters, points=[], standard_errors={}, correlations={}
    )
    return SimpleNamespace(result=result, message="")


def section(result, **what):
    made = identification_section(contents(**what), reported(result))
    tables = [b for b in made.blocks if isinstance(b, TableBlock)]
    return made, tables, [b.text for b in made.blocks if isinstance(b, Sentence)]


@pytest.fixture(autouse=True)
def _no_points(monkeypatch):
    """Residuals have a figure of their own test."""
    monkeypatch.setattr("instrument.report.identification.segments_of", lambda contents, aside: [])


def test_a_page_without_a_law_says_why():
    made = identification_section(contents(), ReportedFit(None, "two points are too few"))
    assert [b.text for b in made.blocks] == ["No law could be identified: two points are too few."]
    assert unexplained_section(ReportedFit(None)).blocks[0].text == "There is no fit to say it of."


def test_a_law_has_its_parameters_with_errors_and_says_which_sits_at_a_bound():
    _, (_, parameters, correlations), said = section(found(bound={"alpha": "upper"}))
    assert said[0].startswith("fractional-zener law from 30 points by direct least squares, without a hammer")
    rows = {row[0]: row[1:] for row in parameters.rows}
    assert len(rows) == 4
    (alpha,) = (row for name, row in rows.items() if row[-1])
    assert (alpha[1], alpha[2]) == ("-", "at its upper bound")
    assert sorted(row[1] for row in rows.values()) == ["-", "1", "1", "1"]
    assert [row[1 + k] for k, row in enumerate(correlations.rows)] == 4 * ["+1.000"]


def test_a_page_counts_what_was_set_aside_apart():
    made = identification_section(contents(), reported(found(), aside=2))
    assert made.blocks[0].text.startswith("fractional-zener law from 28 points (2 set aside) by direct")


def test_the_law_in_the_band_is_a_few_rows_with_both_ends():
    _, (band, *_), _ = section(found())
    assert len(band.rows) <= 11
    assert (band.rows[0][0], band.rows[-1][0]) == ("18", "300")
    G, eta = TABLE_4.storage_and_loss(2 * np.pi * np.array([18.0]))
    assert float(band.rows[0][1].split()[0]) == pytest.approx(G[0] / 1e6, rel=0.01)
    assert float(band.rows[0][2].split()[0]) == pytest.approx(eta[0], rel=0.05)


def test_stated_numbers_are_listed_where_a_fit_has_moved_them():
    specimen = SimpleNamespace(kind="plate", tolerances={})
    made = identification_section(contents(), reported(found(adjusted=PULLED), specimen=specimen))
    moved = made.blocks[
        [getattr(b, "title", "") for b in made.blocks].index(
            "Stated numbers the data moved, most moved first"
        )
    ]
    assert [row[0] for row in moved.rows] == ["gain"]
    assert not [b for b in section(found())[1] if b.title.startswith("Stated numbers")]


VALUES = dict(zip(TABLE_4.names, TABLE_4.values.tolist(), strict=True))


@pytest.mark.parametrize(
    ("run", "points", "said"),
    [
        (None, 0, "The run itself made no fit; this one was made for the page."),
        (SimpleNamespace(result=None, message="no phase"), 0, "The run's own last fit failed: no phase."),
        (live(VALUES), 3, "The run's own last fit had 0 of 3 points."),
        (live(VALUES), 0, "The live identification of the run ended with the same parameters."),
        (
            live({**VALUES, "alpha": 1.03 * VALUES["alpha"]}),
            0,
            "The run's own fit differs by up to 3 % in a parameter.",
        ),
    ],
)
def test_the_page_s_law_is_compared_with_the_run_s_own(run, points, said):
    assert section(found(), live=run, points=points * (None,))[2][-1] == said


def test_a_run_that_struck_the_plate_fitted_without_these_spectra():
    run = live({**VALUES, "alpha": 1.03 * VALUES["alpha"]})
    said = section(found(), live=run, struck=["spectrum"])[2][-1]
    assert said == "The run's own last fit was without the spectra of the struck plate."


@pytest.mark.parametrize(
    ("verdict", "said"),
    [
        ("unknown", "The law may be far off its band"),
        (
            "effect",
            "the law before the diagnosis, which found an effect that the model lacked. The law to use",
        ),
        (
            "ambiguous",
            "lacked something, and cannot tell what of several: added_mass or spot_offset. The law",
        ),
    ],
)
def test_after_a_diagnosis_the_law_is_called_what_it_is(verdict, said):
    diagnosis = SimpleNamespace(result=diagnosed(verdict=verdict))
    made, _, sentences = section(found(warnings=("a remark",)), diagnosis=diagnosis)
    assert made.title.endswith("before the diagnosis")
    assert said in sentences[1]
    assert sentences[2] == "A remark."
    assert section(found())[0].title == "Identification of the core"


def test_no_effect_is_said_to_be_found_where_none_is_likelier():
    ambiguous = diagnosed(verdict="ambiguous").but(equivalent={"added_mass": ("added_mass", "none")})
    (first, *rest) = ambiguous.candidates
    likelier = (first.but(probability=0.02), *rest[:-1], rest[-1].but(probability=0.9))
    found_none = SimpleNamespace(result=ambiguous.but(candidates=likelier))
    assert "found no effect likelier than none" in section(found(), diagnosis=found_none)[2][1]


def test_what_is_left_is_three_numbers_and_each_segment_from_the_others():
    held = (HeldOutSegment(1, 2.5, 0.1), HeldOutSegment(2, 1.25, 0.2))
    made = unexplained_section(reported(found(held_out=held, held_out_rms_percent=2.0)))
    (facts,) = (b for b in made.blocks if isinstance(b, FactsBlock))
    assert dict(facts.rows) == {
        "rms difference in amplitude": "3.54 %",
        "largest difference in amplitude": "4 %",
        "chi² per degree of freedom": "1.25",
        "each segment predicted from the others": "2 % rms",
    }
    (table,) = (b for b in made.blocks if isinstance(b, TableBlock))
    assert [row[:2] for row in table.rows] == [("1", "2.5"), ("2", "1.25")]
    for source, words in (("unknown", "not known: the noise is not"), ("misfit", "none: readings count by")):
        rows = dict(unexplained_section(reported(found(noise=source))).blocks[1].rows)
        assert rows["chi² per degree of freedom"].startswith(words)


def test_why_nothing_is_held_out_is_said():
    made = unexplained_section(reported(found()))
    (facts,) = (b for b in made.blocks if isinstance(b, FactsBlock))
    assert dict(facts.rows)["error on data held out"].startswith("none: ")


def test_the_model_of_a_pair_is_not_called_a_plate():
    pair = SimpleNamespace(kind="shear-pair")
    of_pair = reported(found(), specimen=pair)
    first = unexplained_section(of_pair).blocks[0]
    assert "hammer" not in identification_section(contents(), of_pair).blocks[0].text
    assert first.text == "Before: the model has no further effects than the shear pair and its core."


def test_the_law_to_sign_is_the_recorded_one_unless_the_run_left_none_of_all_its_points(monkeypatch):
    recorded = SimpleNamespace(is_complete=True, points=9, words="G' 0.4 MPa; rms 1 %")
    monkeypatch.setattr("instrument.report.identification.recorded_result", lambda contents: recorded)
    assert session_result(contents(), ReportedFit(None)) is recorded
    assert "0.4" in result_in_short(contents(), ReportedFit(None))
    recorded.is_complete = False
    assert session_result(contents(), ReportedFit(None)) is recorded
    recorded.points = 0
    assert session_result(contents(), ReportedFit(None, "no points")).words == "no law identified: no points"


# Figures


def test_the_law_is_drawn_with_its_band_and_ticks_where_it_was_measured():
    left, right = law_figure(reported(found()).fit).axes
    band = found().band
    for ax, value in ((left, band.storage_modulus_pa / 1e6), (right, band.loss_factor)):
        law, ticks = ax.lines
        np.testing.assert_allclose(law.get_ydata(), value)
        np.testing.assert_allclose(ticks.get_xdata(), SWEEP.frequency_hz)
        assert len(ax.collections) == 1
    assert left.get_ylim()[0] == 0
    unknown = law_figure(reported(found(std=np.nan)).fit)
    assert not unknown.axes[0].collections


def test_a_residual_is_the_model_less_what_was_measured_beside_the_noise():
    f = np.array([20.0, 30.0])
    measured = Measured(1, f, np.array([1.0, 1.0j]), np.array([0.01, 0.02]), (), np.ones(2, bool))
    model = SimpleNamespace(over_base=lambda at: np.array([1.1, 1.0j * np.exp(0.1j)]))
    (figure,) = residual_figures([measured], model)
    above, below = figure.axes
    np.testing.assert_allclose(above.lines[0].get_ydata(), [10.0, 0.0], atol=1e-9)
    np.testing.assert_allclose(below.lines[0].get_ydata(), [0.0, np.degrees(0.1)], atol=1e-9)
    noise = above.collections[0].get_paths()[0].vertices[:, 1]
    assert (noise.min(), noise.max()) == pytest.approx((-4.0, 4.0))
    assert len(residual_figures(5 * [measured], model)) == 2
    assert residual_figures([], model) == []


def test_what_was_read_elsewhere_has_no_residual_of_the_plate_as_stated():
    f = np.array([20.0, 30.0])
    measured = Measured(1, f, np.array([1.0, 1.0j]), np.array([0.01, 0.02]), (), np.ones(2, bool))
    model = SimpleNamespace(over_base=lambda at: np.full(len(at), 1.1 + 0j))
    with_mass = replace(measured, elsewhere="5 g at 280, 100 mm")
    (figure,) = residual_figures([measured, with_mass], model)
    assert len(figure.axes) == 2


def test_a_residual_says_which_points_it_leaves_out(monkeypatch):
    measured = Measured(1, np.array([20.0]), np.ones(1), np.ones(1), (), np.ones(1, bool))
    anew = replace(measured, elsewhere="clamped anew")
    where = "instrument.report.identification"
    for segments, said in (
        ([measured], "segment"),
        ([measured, anew, anew], "segment; without what was measured otherwise (clamped anew)"),
    ):
        monkeypatch.setattr(f"{where}.segments_of", lambda contents, aside, them=segments: them)
        monkeypatch.setattr(f"{where}.residual_figures", lambda segments, fitted: [Figure()])
        made, _, _ = section(found())
        (caption,) = (b.title for b in made.blocks if isinstance(b, FigureBlock) and "Residual" in b.title)
        assert caption == f"Residual: model less measurement, by {said}"


def test_what_is_set_aside_has_no_residual_and_is_marked_at_the_foot():
    f, kept = np.array([20.0, 25.0, 30.0]), np.array([True, False, True])
    measured = Measured(1, f, np.array([1.0, 1e-3, 1.0j]), np.full(3, 0.01), (), kept)
    model = SimpleNamespace(over_base=lambda at: np.full(len(at), 1.1 + 0j))
    (figure,) = residual_figures([measured], model)
    for ax in figure.axes:
        by_name = {line.get_label(): line for line in ax.lines}
        assert list(by_name["model less measured"].get_xdata()) == [20.0, 30.0]
        assert list(by_name[NAME].get_xdata()) == [25.0]
    assert NAME in [text.get_text() for text in figure.legends[0].get_texts()]


def test_a_section_has_the_law_s_picture_with_what_its_bands_are():
    for std, said in ((0.01, "with 95 % bands"), (np.nan, "without bands")):
        made, *_ = section(found(std=std))
        (picture,) = (b for b in made.blocks if isinstance(b, FigureBlock))
        assert said in picture.title
