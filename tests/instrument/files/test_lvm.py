"""What the headers of a LabVIEW text say of its samples."""

import numpy as np
import pytest

from instrument.errors import BadInput
from instrument.files.lvm import Layout, SegmentHeader, read_lvm

ONE_TIME = Layout.of(["Separator\tTab", "X_Columns\tOne"])
SAID = {"Channels": "2", "Samples": "8\t8", "Y_Unit_Label": "N", "Delta_X": "0.5\t0.5", "X_Dimension": "Time"}
NAMES = "X_Value\tF\ta\tComment"


def header(layout=ONE_TIME, names=NAMES, **changed):
    return SegmentHeader.of([f"{key}\t{value}" for key, value in (SAID | changed).items()], names, layout)


def test_a_header_names_channels_and_their_units():
    found = header()
    assert (found.names, found.units) == (("F", "a"), ("N", ""))
    assert (found.step_s, found.samples) == (0.5, 8)


def test_with_a_time_of_its_own_for_each_channel_every_second_column_is_one():
    found = header(Layout.of(["X_Columns\tMulti"]), "X_Value\tF\tX_Value\ta\tComment")
    assert found.names == ("F", "a")


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        ({"Channels": "two"}, "segment without Channels or Delta_X"),
        ({"Delta_X": "nan"}, "segment without Channels or Delta_X"),
        ({"X_Dimension": "Frequency"}, "X_Dimension 'Frequency', expected Time"),
        ({"Channels": "9"}, "9 channels, expected as many as the names below"),
        ({"Delta_X": "-1\t-1"}, "Delta_X = -1, expected more than 0"),
        ({"Delta_X": "0.5\t0.25"}, "Delta_X = 0.5, 0.25, expected the same of every channel"),
    ],
)
def test_a_header_that_cannot_be_followed_is_refused(changed, said):
    with pytest.raises(BadInput, match=said):
        header(**changed)


@pytest.mark.parametrize(("count", "pieces"), [(8, 1), (24, 3), (12, 1)])
def test_one_header_stands_for_as_many_segments_as_are_whole(count, pieces):
    samples = np.arange(2.0 * count).reshape(count, 2)
    blocks = header().split(samples)
    assert len(blocks) == pieces
    assert np.array_equal(np.vstack([block.samples for block in blocks]), samples)
    assert {block.sample_rate_hz for block in blocks} == {2.0}


def test_a_file_that_ends_with_a_header_is_refused_in_a_line(tmp_path):
    path, end = tmp_path / "a.lvm", "***End_of_Header***"
    path.write_text("\n".join(["LabVIEW Measurement", end, "Channels\t1", "Delta_X\t0.5", end]))
    with pytest.raises(BadInput, match=r"a\.lvm: line 5: 0 samples in the segment, expected more"):
        read_lvm(path)
