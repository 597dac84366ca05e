"""An effect is in all of the data, or in one file, spot or segment of them."""

import pytest

from fitting.diagnosis.several.parts_with import part_with

SEGMENT = {"factor": 1.05, "from": 85.0, "to": 115.0, "level": 0.0}


@pytest.mark.parametrize(
    ("name", "values", "is_all"),
    [
        ("added_mass", {"mass": 5e-3}, True),
        ("added_mass", {"mass": 5e-3, "file": 0.0}, True),
        ("added_mass", {"mass": 5e-3, "file": 2.0}, False),
        ("temperature_difference", {"warmer": 2.0, "file": -1.0}, False),
        ("gain_error", {"factor": 1.1, "pickup": -1.0}, True),
        ("gain_error", {"factor": 1.1, "pickup": 0.0}, False),
        ("segment_gain", SEGMENT, False),
        ("an effect of a package that is gone", {"from": 1.0, "to": 2.0}, True),
    ],
)
def test_it_is_of_a_part_or_of_all(name, values, is_all):
    assert part_with(name, values).is_all == is_all


def test_points_have_it_by_their_file_spot_and_frequency():
    segment = part_with("segment_gain", SEGMENT)
    assert [segment.has(f, None, None) for f in (84.0, 85.0, 115.0, 116.0)] == [False, True, True, False]
    second = part_with("gain_error", {"factor": 1.1, "file": 2.0, "pickup": 1.0})
    assert second.has(50.0, 2, 1)
    assert not second.has(50.0, 2, 0)
    assert not second.has(50.0, 1, 1)
    assert part_with("clamp_line", {"dlength": 1e-3, "file": -1.0}).has(50.0, 3, None)
