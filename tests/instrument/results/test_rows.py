"""Rows of results, read off fits made by hand, and how their figures are drawn."""

import json
from types import SimpleNamespace

import numpy as np
import pytest
from matplotlib.figure import Figure

from fitting.identification.adjusted import Adjusted
from fitting.identification.result import LawBand
from instrument.results.adjusted_words import adjusted_rows, more_adjusted
from instrument.results.budget_from import budget_from
from instrument.results.drawing import from_zero, in_rows, panels
from instrument.results.modal_from import mean_temperature
from instrument.results.modes_from import modes_from
from instrument.results.prediction_from import of_spots, prediction_from
from instrument.results.rows_from import adjusted_from, law_rows_from

PULLED = [
    Adjusted("pickup_x", 250.0, 0.5, 250.1, 0.3, 0.2, "mm"),
    Adjusted("gain", 1.0, 0.02, 0.96, 0.01, -2.0, "1"),
    Adjusted("length", 300.0, 0.5, 300.5, 0.3, 1.0, "mm"),
]


def test_stated_numbers_are_listed_the_most_moved_first_and_the_rest_is_counted():
    specimen = SimpleNamespace(tolerances={"length": 5e-4})
    rows = adjusted_rows(PULLED, specimen, most=2)
    assert [row[0] for row in rows] == ["gain", "length / mm"]
    assert [row[-2:] for row in rows] == [["-2.00", "typical"], ["+1.00", "named"]]
    assert more_adjusted(PULLED, most=2) == "1 more moved by 0.20 tolerances or less"
    assert more_adjusted(PULLED) == ""
    assert [one.found for one in adjusted_from(PULLED)] == [250.1, 0.96, 300.5]


def test_a_law_has_a_row_a_frequency_and_null_where_no_error_is_known():
    band = LawBand(
        *(np.array([a, b]) for a, b in ((10, 20.0), (1e5, 2e5), (0.5, 0.6), (1e3, np.nan), (0.1, 0.2)))
    )
    first, second = law_rows_from(band)
    assert (first.frequency_hz, first.storage_modulus_standard_error_pa) == (10.0, 1e3)
    assert second.as_json()["storage_modulus_standard_error_pa"] is None


def test_a_budget_s_largest_source_comes_first_at_each_frequency():
    sources = {"noise": np.array([0.01, 0.03]), "thickness": np.array([0.02, 0.01])}
    loss = {"noise": np.array([0.1, 0.2]), "thickness": np.array([0.3, 0.4])}
    budget = SimpleNamespace(
        frequency_hz=np.array([10.0, 20.0]),
        storage_relative=sources,
        loss_factor=loss,
        total=lambda parts: np.sqrt(sum(p**2 for p in parts.values())),
    )
    low, high = budget_from(budget)
    assert [s.source for s in low.sources] == ["thickness", "noise"]
    assert [s.source for s in high.sources] == ["noise", "thickness"]
    assert low.sources[0].loss_factor == 0.3
    assert low.storage_modulus_standard_error_percent == pytest.approx(100 * np.hypot(0.01, 0.02))


def test_modes_beyond_the_law_s_table_are_noted():
    modes = [SimpleNamespace(frequency_hz=f, loss_factor=0.1) for f in (10.0, 500.0)]
    law = SimpleNamespace(outside=lambda f: "beyond" if f.max() > 100 else "")
    assert modes_from(modes, law).notes == ("beyond",)
    assert modes_from(modes[:1], law).notes == ()
    assert [row.frequency_hz for row in modes_from(modes).modes] == [10.0, 500.0]
    (note,) = modes_from(modes, along=[False, True]).notes
    assert note.startswith("mode 2 at 500 Hz goes along the beam")


def test_predictions_of_several_spots_are_numbered_one_is_not():
    f = np.array([10.0, 20.0])
    each = [prediction_from(f, np.array([z, 2 * z]), "", "a remark") for z in (1j, -3.0 + 0j)]
    assert each[0].notes == ("a remark",)
    assert of_spots(each[:1]) is each[0]
    both = of_spots(each)
    assert [p.pickup for p in both.points] == [0, 0, 1, 1]
    assert len(json.dumps(both.as_json())) > len(json.dumps(each[0].as_json()))


def test_temperatures_of_tables_are_averaged_over_rows_that_state_one():
    tables = [
        SimpleNamespace(temperature_c=t) for t in (np.array([10.0, 20.0, 30.0]), None, np.array([40.0]))
    ]
    assert mean_temperature(tables) == 25.0
    assert mean_temperature(tables[1:2]) is None


def test_panels_are_shared_out_evenly_four_a_figure_at_most():
    assert [len(row) for row in in_rows(range(9))] == [3, 3, 3]
    assert [len(row) for row in in_rows(range(4))] == [4]
    assert in_rows([]) == []
    figure, axes = panels(2, 3, 4.0)
    assert isinstance(figure, Figure)
    assert [len(row) for row in axes] == [3, 3]
    from_zero(axes[0][0], np.array([1.0, np.nan, 5.0]))
    assert axes[0][0].get_ylim() == pytest.approx((0.0, 5.4))
