"""Results made by hand, as a notebook has them: numbers, words, plots; and what may go in as numbers."""

import json
from dataclasses import replace

import numpy as np
import pytest
from diagnosis_cases import diagnosis
from found_law_cases import facts
from hypothesis import given
from hypothesis import strategies as st
from paper_law import TABLE_4

from fitting.numerics.chances import Z_95
from instrument.errors import BadInput
from instrument.facts.identification import IdentificationResult
from instrument.facts.modes import ComplexModeRow, ModesResult
from viscorig.checked import numbers
from viscorig.diagnosis import Diagnosis
from viscorig.facts import Facts
from viscorig.identification import Identification
from viscorig.plots import plot_amplitude, plot_laws, plot_modes, plot_ratios, plot_residual
from viscorig.shown import Shown, columns

MODES = ModesResult(
    modes=(
        ComplexModeRow(frequency_hz=17.7, loss_factor=0.1),
        ComplexModeRow(frequency_hz=60.0, loss_factor=np.nan),
    )
)


# Numbers in


@given(values=st.lists(st.floats(-1e300, 1e300), min_size=1, max_size=6))
def test_numbers_come_in_as_an_array_of_their_own(values):
    given_ = np.array(values)
    found = numbers("x", given_, float)
    np.testing.assert_array_equal(found, given_)
    found[0] = 7.0
    assert given_[0] == values[0]


def test_a_single_number_stands_for_all_points():
    np.testing.assert_array_equal(numbers("x", 2, float, 3), [2.0, 2.0, 2.0])
    np.testing.assert_array_equal(numbers("x", [2j], complex, 2), [2j, 2j])


@pytest.mark.parametrize(
    ("values", "how", "said"),
    [
        ([[1.0], [2.0]], {}, r"x: shape \(2, 1\), expected one dimension"),
        ([], {}, r"x: shape \(0,\), expected one dimension with at least one point"),
        ([1.0, 2.0], {"points": 3}, "x: 2 numbers, expected 3, one a frequency"),
        (["a"], {}, "x: .*, expected numbers"),
        ([1.0, np.nan], {}, r"x\[1\] = nan, expected finite numbers"),
        ([1.0, np.inf], {}, r"x\[1\] = inf, expected finite numbers"),
        ([1.0, 0.0, -1.0], {"above_zero": True}, r"x\[1\] = 0, expected more than 0"),
        ([1.0, -1.0], {"above_zero": True}, r"x\[1\] = -1, expected more than 0"),
        ([1j, 0j], {"above_zero": True}, r"x\[1\] = 0\+0j, expected a phasor that is not zero"),
    ],
)
def test_what_are_no_such_numbers_is_refused_with_the_first_wrong_one(values, how, said):
    dtype = complex if any(isinstance(v, complex) for v in values) else float
    with pytest.raises(BadInput, match=said):
        numbers("x", values, dtype, **how)


def test_a_negative_phasor_is_one():
    assert numbers("x", [-1 + 0j], complex, above_zero=True).tolist() == [-1 + 0j]


# Shown


class Table(Shown):
    """As long as it is asked to be."""

    def __init__(self, rows):
        self.rows = rows

    def to_numpy(self):
        return {"x_m": np.arange(self.rows) / 3, "name": np.array([f"<{k}>" for k in range(self.rows)])}

    def as_dict(self):
        return {"x_m": self.to_numpy()["x_m"], "nothing": np.nan}

    def lines(self):
        return ["a heading", "a line"]


def test_rows_of_a_result_become_columns_with_nan_where_nothing_is():
    found = columns(MODES.modes)
    np.testing.assert_array_equal(found["frequency_hz"], [17.7, 60.0])
    np.testing.assert_array_equal(found["loss_factor"], [0.1, np.nan])
    assert columns([]) == {}


@pytest.mark.parametrize(("rows", "shown"), [(12, 12), (13, 13), (100, 13)])
def test_a_long_table_is_shown_by_its_beginning_and_its_end(rows, shown):
    html = Table(rows)._repr_html_()
    assert html.count("<tr>") == 1 + shown
    assert (html.count("…") > 0) is (rows > 12)
    assert f"&lt;{rows - 1}&gt;" in html
    assert "<td>0.33333</td>" in html
    assert html.startswith("<p><b>a heading</b><br>a line</p>")


def test_an_object_says_its_heading_and_prints_all_its_lines():
    assert repr(Table(1)) == "<Table: a heading>"
    assert str(Table(1)) == "a heading\na line"


def test_json_is_written_as_the_commands_write_it(tmp_path):
    path = Table(2).to_json(tmp_path / "a.json")
    assert json.loads(path.read_text()) == {"x_m": [0.0, pytest.approx(1 / 3)], "nothing": None}
    with pytest.raises(BadInput, match="none"):
        Table(2).to_json(tmp_path / "none" / "a.json")


def test_facts_are_those_of_the_command_with_what_speaks_against_them():
    one = Facts(MODES)
    assert one.as_dict() == MODES.as_json()
    assert one.as_dict()["modes"][1]["loss_factor"] is None
    assert one.warnings == ()
    assert Facts(diagnosis()).warnings == diagnosis().warnings != ()


def test_a_result_tells_doubts_of_its_law_from_other_warnings(identified):
    said = {"warnings": ("look", "the law is in doubt"), "doubts": ("the law is in doubt",)}
    for one in (
        Diagnosis(diagnosis().but(**said)),
        replace(identified, result=identified.result.but(**said)),
    ):
        assert one.doubts == ("the law is in doubt",)
        assert one.warnings == said["warnings"]
    assert identified.doubts == ()


# An identification


@pytest.fixture
def identified(plate):
    given_ = facts(TABLE_4) | {"rms_percent": 1.25, "max_percent": 2.5, "warnings": ["look"], "points": []}
    given_["standard_errors"] = {**given_["standard_errors"], "alpha": None}
    points = [
        {
            "frequency_hz": f,
            "segment": 1,
            "measured_m_s": v,
            "predicted_m_s": 1.01 * v,
            "difference_percent": 1.0,
        }
        for f, v in ((30.0, 0.2), (20.0, 0.1))
    ]
    return Identification(IdentificationResult.model_validate(given_ | {"points": points}), plate)


def test_a_law_has_its_parameters_errors_and_curve(identified):
    assert identified.parameters == dict(zip(TABLE_4.names, TABLE_4.values.tolist(), strict=True))
    assert identified.standard_errors["alpha"] is None
    assert identified.standard_errors["g0_pa"] == pytest.approx(0.03 * TABLE_4.values[0])
    G, eta = TABLE_4.storage_and_loss(2 * np.pi * identified.frequency_hz)
    np.testing.assert_allclose(identified.storage_modulus_pa, G)
    np.testing.assert_allclose(identified.loss_factor, eta)


def test_it_is_a_function_of_frequency_beyond_the_band_too(identified):
    f = np.array([[1.0, 20.0], [1e3, 1e4]])
    np.testing.assert_allclose(identified.modulus_pa(f), TABLE_4.modulus(2 * np.pi * f))


def test_it_says_law_parameters_with_errors_and_what_is_left(identified):
    first, left, warning = identified.lines()
    assert first.startswith("fractional-zener: g0_pa = 270000 ± 8100, ")
    assert first.endswith("alpha = 0.83")
    assert (left, warning) == ("difference in amplitude: rms 1.25 %, largest 2.50 %", "note: look")


def test_it_prints_modulus_and_loss_factor_at_a_few_frequencies_with_their_errors(identified):
    said = str(identified).splitlines()
    assert said[2].split() == ["frequency/Hz", "G'/MPa", "loss", "factor"]
    rows = said[3:-2]
    assert 6 <= len(rows) <= 8
    law = identified.result.law
    for row, known in ((rows[0], law[0]), (rows[-1], law[-1])):
        f, G, plus, G_error, eta, _, eta_error = row.split()
        assert (float(f), plus) == (pytest.approx(known.frequency_hz, abs=0.05), "±")
        assert float(G) == pytest.approx(1e-6 * known.storage_modulus_pa, rel=0.05)
        assert float(G_error) == pytest.approx(1e-6 * known.storage_modulus_standard_error_pa, rel=0.1)
        assert float(eta) == pytest.approx(known.loss_factor, rel=0.05)
        assert float(eta_error) == pytest.approx(known.loss_factor_standard_error, rel=0.1)
    assert said[-1] == "note: look"


def test_measured_and_fitted_amplitudes_are_drawn_in_the_order_of_frequency(identified):
    measured, fitted = identified.plot_fit().lines
    np.testing.assert_allclose(measured.get_data(), [[20, 30], [0.1, 0.2]])
    np.testing.assert_allclose(fitted.get_data(), [[20, 30], [0.101, 0.202]])


def test_its_law_is_drawn_with_both_bands(identified):
    ax = identified.plot()
    left, right = ax.figure.axes
    np.testing.assert_allclose(left.lines[0].get_ydata(), identified.storage_modulus_pa / 1e6)
    np.testing.assert_allclose(right.lines[0].get_ydata(), identified.loss_factor)
    band = left.collections[0].get_paths()[0].vertices[:, 1].max()
    error = identified.to_numpy()["storage_modulus_standard_error_pa"]
    assert band == pytest.approx((identified.storage_modulus_pa + Z_95 * error).max() / 1e6)


# A diagnosis


def test_a_diagnosis_has_its_verdict_effects_and_candidates_best_first():
    found = Diagnosis(diagnosis())
    assert found.verdict == "effect"
    assert found.effects["added_mass"]["mass"] == {"value": 0.008, "standard_error": 1e-4, "unit": "kg"}
    table = found.to_numpy()
    assert table["name"].tolist()[0] == "added_mass"
    np.testing.assert_allclose(table["probability"], [0.82, 0.14, 0.04, 0.0])
    np.testing.assert_allclose(table["delta_bic"], [0.0, 3.5, 6.0, 400.0])


def test_it_says_what_was_left_before_and_after_and_why():
    heading, *rest = Diagnosis(diagnosis()).lines()
    assert heading.startswith("effect: added_mass, mains_hum (rms ")
    before, after = (s.rms_percent for s in diagnosis().stages)
    assert f"rms {before:.3g} % before, {after:.3g} % after" in heading
    assert rest[:2] == list(diagnosis().explanation)
    assert rest[-1] == diagnosis().warnings[-1]


def test_its_laws_before_and_after_are_drawn_after_first():
    found = Diagnosis(diagnosis())
    np.testing.assert_array_equal(found.before["frequency_hz"], found.after["frequency_hz"])
    left = found.plot_law()
    assert [line.get_label() for line in left.lines] == ["G' after", "G' before"]
    after, before = (line.get_linestyle() for line in left.lines)
    assert (after, before) == ("-", "--")


def test_what_is_left_without_and_with_effects_stands_over_the_noise():
    result = diagnosis()
    ax = Diagnosis(result).plot()
    by_name = {line.get_label(): line for line in ax.lines}
    left = sorted((p.frequency_hz, p.stage("after").amplitude_percent) for p in result.points)
    np.testing.assert_allclose(np.transpose(by_name["with effects"].get_data()), left)
    assert "noise, ± 2 std" in [c.get_label() for c in ax.containers]


# Plots by themselves


LAW = {
    "frequency_hz": np.array([10.0, 20.0]),
    "storage_modulus_pa": np.array([1e6, 2e6]),
    "loss_factor": np.array([0.5, 0.6]),
    "storage_modulus_standard_error_pa": np.array([1e4, np.nan]),
    "loss_factor_standard_error": np.array([0.01, 0.02]),
}


def test_a_law_of_unknown_error_has_no_band_and_all_names_one_legend():
    left = plot_laws(None, {"one": LAW, "other": LAW})
    left, right = left.figure.axes
    assert (len(left.collections), len(right.collections)) == (0, 2)
    names = [text.get_text() for text in right.get_legend().get_texts()]
    assert names == ["G' one", "G' other", "η one", "η other"]
    assert left.get_legend() is None


def test_ratios_are_percent_with_their_errors_and_modes_are_stems():
    table = {
        "frequency_hz": np.array([17.7, 60.0]),
        "half_power_ratio": np.array([0.003, np.nan]),
        "half_power_standard_error": np.array([1e-4, np.nan]),
    }
    three = {
        **table,
        **{f"{m}_{k}": table[f"half_power_{k}"] for m in ("a", "b") for k in ("ratio", "standard_error")},
    }
    ax = plot_ratios(None, three, {"half_power": "half power", "a": "A", "b": "B"})
    assert ax.containers[0].lines[0].get_ydata()[0] == pytest.approx(0.3)
    ax = plot_modes(None, columns(MODES.modes))
    np.testing.assert_allclose(ax.containers[0].markerline.get_data()[0], [17.7, 60.0])


def test_plots_go_onto_the_axes_they_are_given():
    ax = plot_amplitude(None, np.array([2.0, 1.0]), np.array([4.0, 3.0]), "o", "measured")
    assert plot_amplitude(ax, np.array([1.0]), np.array([5.0]), "x", "fitted") is ax
    assert ax.lines[0].get_color() != ax.lines[1].get_color()
    assert plot_residual(ax, diagnosis().points, {"before": "a", "after": "b"}) is ax
