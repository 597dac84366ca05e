"""Frequencies as an option has them, and what is said of those that are none."""

import numpy as np
import pytest

from instrument.cli.main import run
from instrument.cli.options import Frequencies
from instrument.files.new_file import write_new


def test_a_range_has_both_ends():
    np.testing.assert_allclose(Frequencies().convert("14:15:0.4", None, None), [14.0, 14.4, 14.8, 15.0])


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("20:14:1", "A = 20 is above B = 14, expected the lower one first"),
        ("14:20:-1", "STEP = -1, expected more than 0 Hz"),
        ("0:1e9:1e-3", "1e+12 frequencies, expected at most 100000: a larger STEP"),
        ("1:1e300:1e-300", "inf frequencies, expected at most 100000: a larger STEP"),
        ("14:20", "expected A:B:STEP or F1,F2,... in Hz"),
    ],
)
def test_a_range_that_is_none_says_why(tmp_path, capsys, text, said):
    plate = write_new("plate", tmp_path / "plate.toml")
    assert run(["predict", str(plate), "--frequencies", text]) == 2
    assert said in capsys.readouterr().err


@pytest.mark.parametrize(
    ("options", "said"),
    [(["--real-modes"], "--real-modes with a beam"), (["--hammer", "a.json"], "--hammer with a beam")],
)
def test_of_options_for_plates_those_given_are_named(tmp_path, capsys, options, said):
    beam = write_new("beam", tmp_path / "beam.toml")
    assert run(["predict", str(beam), "--frequencies", "20,30", *options]) == 2
    assert said in capsys.readouterr().err
