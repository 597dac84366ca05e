"""One law from files that are not one plate read at one spot."""

import numpy as np
import pytest
from shear_pair_cases import pair, sweep

from instrument.errors import BadInput
from instrument.finding.files_method import FilesMethod
from instrument.finding.identification import identify
from instrument.models.files import File
from instrument.progress import quiet

FILES = [File(sweep(pair(m), points=30), pair(m), name) for m, name in ((0.2533, "a.csv"), (0.573, "b.csv"))]


def test_every_point_given_is_used_or_has_a_reason():
    way = FilesMethod(FILES, None, quiet)
    way.fitted()
    assert len(way.given) == len(way.why_aside) == 60
    np.testing.assert_array_equal(way.sweep.frequency_hz, way.given.frequency_hz[way.why_aside == ""])
    assert way.doubts == ()


@pytest.mark.parametrize("files", [FILES, FILES[:1]])
def test_the_papers_method_is_of_one_plate_alone(files):
    with pytest.raises(BadInput, match="method 'paper': expected one plate read at one spot"):
        identify(files, "paper")
