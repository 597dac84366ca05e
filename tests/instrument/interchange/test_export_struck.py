"""Blows on the treated plate written as files of their own, and read back."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from sessions import configuration, point
from struck_cases import struck

from instrument.files.specimen_file import read_specimen
from instrument.files.sweep_file import read_sweep
from instrument.interchange.csv_export import export_csv
from instrument.interchange.files_of import files_of
from instrument.session.contents import Contents
from instrument.session.points import sweep_of


@pytest.mark.parametrize("held", ["free", "clamped"])
def test_blows_on_the_treated_plate_come_back_as_the_file_that_was_diagnosed(tmp_path, held):
    found = struck(held)
    contents = Contents(Path("a.h5"), configuration(), struck=[found])
    points = [point(1, 20.0)]
    (_, diagnosed) = files_of(sweep_of(points), points, contents.specimen, [found])
    names = [p.name for p in export_csv(contents, tmp_path)]
    assert names[:2] == ["test-struck-1.csv", "test-struck-1-specimen.toml"]
    read = read_specimen(tmp_path / names[1])
    assert replace(read, tolerances={}) == replace(diagnosed.specimen, tolerances={}, reads=read.reads)
    for name in ("gain", "delay"):
        assert read.tolerances[name] == pytest.approx(diagnosed.specimen.tolerances[name])
    sweep = read_sweep(tmp_path / names[0]).sweep(read.drive_amplitude, read.drive)
    np.testing.assert_array_equal(sweep.frequency_hz, diagnosed.sweep.frequency_hz)
    np.testing.assert_array_equal(sweep.response_m_s, diagnosed.sweep.response_m_s)
    np.testing.assert_array_equal(sweep.std_m_s, diagnosed.sweep.std_m_s)
