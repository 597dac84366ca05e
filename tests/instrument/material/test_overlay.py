"""A law and somebody's DMA in one figure."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure

from fitting.numerics.chances import Z_95
from instrument.errors import BadInput
from instrument.files.dma_file import DmaTable
from instrument.material.found_law import MaterialLaw
from instrument.material.overlay import save_overlay

F = np.array([10.0, 100.0])
LAW = MaterialLaw(
    "a",
    "b",
    "none",
    "constant",
    {},
    {},
    F,
    np.full(2, 4e6),
    np.full(2, 0.5),
    np.full(2, 1e5),
    np.full(2, 0.02),
)


def table(*temperatures):
    """A row at each."""
    n = len(temperatures)
    one = np.arange(1.0, n + 1)
    unsaid = np.full(n, np.nan)
    return DmaTable(
        Path("dma.csv"), "shear", None, 20 * one, np.array(temperatures), 1e6 * one, one / 10, unsaid, unsaid
    )


@pytest.fixture
def drawn(monkeypatch, tmp_path):
    """The axes of both panels, nothing rendered."""
    figures = []
    monkeypatch.setattr(Figure, "savefig", lambda figure, path, **_: figures.append((figure, path)))

    def draw(law, beside):
        path = save_overlay(law, beside, tmp_path / "new")
        assert figures[-1][1] == path == tmp_path / "new" / "with-dma.png"
        return figures[-1][0].axes

    return draw


def test_the_law_stands_with_its_band_among_the_rows_of_the_table(drawn):
    left, right = drawn(LAW, table(20.0))
    for ax, value, error, rows in ((left, 4.0, 0.1, [1.0]), (right, 0.5, 0.02, [0.1])):
        law, marks = ax.lines
        np.testing.assert_allclose(law.get_ydata(), value)
        np.testing.assert_allclose(marks.get_ydata(), rows)
        band = ax.collections[0].get_paths()[0].vertices[:, 1]
        assert (band.min(), band.max()) == pytest.approx((value - Z_95 * error, value + Z_95 * error))


def test_each_temperature_has_marks_of_its_own_with_its_name(drawn):
    left, _ = drawn(LAW, table(20.0, 30.0, 20.0))
    _, cold, warm = left.lines
    assert (cold.get_label(), warm.get_label()) == ("dma.csv, 20 °C", "dma.csv, 30 °C")
    assert cold.get_marker() != warm.get_marker()
    assert (cold.get_xdata().tolist(), warm.get_xdata().tolist()) == ([20.0, 60.0], [40.0])


def test_a_table_without_temperatures_is_one_set_of_marks(drawn):
    left, _ = drawn(LAW, table(np.nan, np.nan))
    assert [line.get_label() for line in left.lines] == ["identified", "dma.csv"]
    assert left.lines[1].get_xdata().tolist() == [20.0, 40.0]


def test_a_law_without_known_errors_has_no_band(drawn):
    left, right = drawn(replace(LAW, storage_modulus_standard_error_pa=np.array([np.nan, 1.0])), table(20.0))
    assert (len(left.collections), len(right.collections)) == (0, 1)


def test_a_folder_that_cannot_be_made_is_refused(tmp_path):
    (tmp_path / "taken").write_text("a file")
    with pytest.raises(BadInput, match="taken"):
        save_overlay(LAW, table(20.0), tmp_path / "taken" / "below")
