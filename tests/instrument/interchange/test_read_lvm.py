"""LabVIEW measurement files become records of blows."""

import numpy as np
import pytest

from instrument.cli.main import run
from instrument.errors import BadInput
from instrument.files.impact_csv import read_impact_csv
from instrument.interchange.read_lvm import read_lvm_hits

HEAD = "LabVIEW Measurement\nSeparator\tTab\nX_Columns\tOne\n***End_of_Header***\t\n"
SEGMENT = "Channels\t2\t\nSamples\t16\t16\nY_Unit_Label\t{}\nDelta_X\t{}\n***End_of_Header***\t\n"


def written(tmp_path, units="N\tg", steps="0.001\t0.001"):
    rows = "".join(f"{k / 1000}\t{50 * (k == 3)}\t{k}\n" for k in range(16))
    path = tmp_path / "a.lvm"
    path.write_text(HEAD + SEGMENT.format(units, steps) + "X_Value\thammer\tplate\n" + rows)
    return path


def test_a_segment_is_a_hit_in_si_units(tmp_path):
    out = tmp_path / "a.csv"
    assert run(["import", str(written(tmp_path)), "--out", str(out)]) == 0
    (hit,) = read_impact_csv(out)
    assert hit.sample_rate_hz == pytest.approx(1000)
    assert hit.force_n[3] == 50
    np.testing.assert_allclose(hit.responses[0].samples, 9.80665 * np.arange(16))


def test_channels_at_unlike_rates_are_refused(tmp_path):
    with pytest.raises(BadInput, match=r"Delta_X = 0\.001, 0\.002, expected the same"):
        read_lvm_hits(written(tmp_path, steps="0.001\t0.002"))


def test_a_file_without_a_force_says_what_it_has(tmp_path):
    with pytest.raises(BadInput, match=r"found hammer \[V\], plate \[g\], expected a force"):
        read_lvm_hits(written(tmp_path, units="V\tg"))


def test_a_spectrum_is_no_record_in_time(tmp_path):
    path = written(tmp_path)
    path.write_text(path.read_text().replace("Delta_X", "X_Dimension\tFrequency\tFrequency\nDelta_X"))
    with pytest.raises(BadInput, match="X_Dimension 'Frequency', expected Time"):
        read_lvm_hits(path)
