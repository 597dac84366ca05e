"""A quantity of a point stands in one table: what is added there is exported, reported and shown."""

from dataclasses import fields

import h5py
import numpy as np
import pytest
from scipy.io import loadmat
from session_cases import SyntheticSession, configuration

from gui.pages.sweep.points import PointsMeasured
from gui.pages.sweep.record_lines import record_lines
from gui.pages.sweep.seen import PaneContents
from instrument.files import point_columns
from instrument.files.column import Column, ShownQuantity
from instrument.files.sweep_file import read_sweep
from instrument.interchange.exporting import export_session
from instrument.report.fitted import ReportedFit
from instrument.report.sweep import sweep_section
from instrument.session.contents import contents_of
from instrument.session.storage import SessionFile
from instrument.stepped_sine.settings import SweepSettings
from instrument.stream.derived import PointMeasured


@pytest.fixture(scope="module")
def session(tmp_path_factory):
    synthetic = SyntheticSession(configuration())
    synthetic.begin()
    synthetic.calibrate()
    synthetic.sweep((1,), steps=4)
    return synthetic.save(tmp_path_factory.mktemp("session"))


@pytest.fixture(scope="module")
def contents(session):
    with SessionFile(session) as file:
        return contents_of(file)


@pytest.fixture
def later(monkeypatch):
    """One quantity more than today, as a later version may have it."""
    later = Column(
        "drive_current_a",
        "A",
        read=lambda rows: np.array([row.point.drive_v / 4 for row in rows]),
        report=ShownQuantity("current / A", lambda row: f"{row.point.drive_v / 4:.6f}"),
        record=ShownQuantity("Current", lambda row: f"{row.point.drive_v / 4:.6f} A"),
    )
    monkeypatch.setattr(point_columns, "COLUMNS", (*point_columns.COLUMNS, later))
    return later


def test_a_quantity_added_to_the_table_is_exported(later, contents, tmp_path):
    wanted = [p.drive_v / 4 for p in contents.measured]
    for to in ("csv", "mat"):
        export_session(contents, to, tmp_path)
    read = read_sweep(tmp_path / f"{contents.configuration.name}.csv")
    assert [float(text) for text in read.unknown[later.name]] == wanted
    mat = loadmat(tmp_path / f"{contents.configuration.name}.mat", squeeze_me=True, simplify_cells=True)
    assert mat["sweep"][later.name].tolist() == wanted
    assert mat["units"]["sweep"][later.name] == "A"


def test_a_quantity_added_to_the_table_is_reported(later, contents):
    table = sweep_section(contents, ReportedFit(None)).blocks[-1]
    assert table.columns[-1] == "current / A"
    assert [row[-1] for row in table.rows] == [f"{p.drive_v / 4:.6f}" for p in contents.measured]


def test_a_quantity_added_to_the_table_is_in_the_windows_record(later, contents):
    settings = SweepSettings()
    seen = PaneContents(PointsMeasured.of(contents.points, settings))
    line = record_lines(seen, 2, settings)[-1]
    assert (line.name, line.value) == ("Current", f"{contents.measured[2].drive_v / 4:.6f} A")


def test_every_number_of_a_point_is_kept_with_a_session_and_drawn(session):
    places_and_words = {"purpose", "range_name", "remarks", "spot_mm", "mass_at_mm"}
    numbers = {f.name for f in fields(PointMeasured)} - places_and_words
    assert {column.field for column in point_columns.stored()} == numbers
    with h5py.File(session) as file:
        assert set(file["points"]) == numbers | {"purpose"}
        assert all(file["points"][name].attrs["units"] for name in numbers)


def test_a_column_of_a_name_stands_once():
    names = [column.name for column in point_columns.COLUMNS]
    assert len(names) == len(set(names))
