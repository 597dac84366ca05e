"""The JSON of a hammer test, and what is none."""

import json

import numpy as np
import pytest

from instrument.errors import BadInput
from instrument.files.hammer_file import read_hammer

MODE = {"frequency_hz": 17.6, "damping_ratio": 0.0029}


def written(tmp_path, content):
    path = tmp_path / "h.json"
    path.write_text(json.dumps(content))
    return path


def test_accepted_modes_are_read_with_their_ratios_where_there_are_some(tmp_path):
    modes = [MODE, {"frequency_hz": 40.0, "damping_ratio": None}, {"frequency_hz": 90.0, "accepted": False}]
    found = read_hammer(written(tmp_path, {"modes": modes}))
    np.testing.assert_array_equal(found.frequency_hz, [17.6, 40.0])
    np.testing.assert_array_equal(found.ratios, [0.0029, np.nan])


@pytest.mark.parametrize(
    ("content", "said"),
    [
        ([], "the whole: no object"),
        (None, "the whole: no object"),
        ("abc", "the whole: no object"),
        ({}, "modes: field required"),
        ({"modes": [3]}, r"modes\.0: no object"),
        ({"modes": [MODE | {"accepted": "yes"}]}, r"modes\.0\.accepted: input should be a valid boolean"),
        ({"modes": [MODE | {"frequency_hz": 1e300}]}, r"modes\.0\.frequency_hz: .* 1000000"),
        ({"modes": [MODE | {"damping_ratio": 0.29}]}, "a fraction of critical, not percent"),
        # As `viscorig modes` writes it of the treated plate.
        ({"modes": [{"frequency_hz": 20.3, "loss_factor": 0.1}]}, "no damping_ratio"),
    ],
)
def test_what_is_no_hammer_test_is_one_line(tmp_path, content, said):
    with pytest.raises(BadInput, match=said) as caught:
        read_hammer(written(tmp_path, content))
    assert "expected the JSON of 'viscorig damping'" in str(caught.value)


def test_a_file_that_is_not_json_is_told_what_is_expected(tmp_path):
    (tmp_path / "a.json").write_text("no json")
    said = r"a\.json: line 1: not JSON \(.*\), expected the JSON of 'viscorig damping', or a session"
    with pytest.raises(BadInput, match=said):
        read_hammer(tmp_path / "a.json")


def test_an_accepted_mode_without_any_damping_is_refused(tmp_path):
    still = {"frequency_hz": 40.0, "damping_ratio": 0}
    said = r"h\.json: modes\.1\.damping_ratio: 0 at 40 Hz, no plate rings for ever: expected .* or null"
    with pytest.raises(BadInput, match=said):
        read_hammer(written(tmp_path, {"modes": [MODE, still]}))
    assert len(read_hammer(written(tmp_path, {"modes": [MODE, still | {"accepted": False}]})).ratios) == 1
