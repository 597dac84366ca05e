"""What a law that is read back takes along of the plate it was found on."""

import pytest

from instrument.results.fit_file import FoundLaw, is_of_first


@pytest.mark.parametrize(
    ("name", "first"),
    [
        ("gain", True),
        ("gain [1]", True),
        ("gain [2]", False),
        ("length [1, 3]", True),
        ("length [2, 3]", False),
        ("pickup_x [pickup 0]", True),
        ("pickup_x [pickup 1]", False),
        ("pickup_x [1, pickup 1]", False),
        ("pickup_x [1, pickup 0]", True),
    ],
)
def test_a_number_says_whose_it_is(name, first):
    assert is_of_first(name) is first


def test_a_law_of_several_files_keeps_the_first_one_s_numbers_and_those_of_all():
    names = ["substrate_young", "gain [1]", "gain [2]"]
    adjusted = [{"name": n, "stated": 1.0, "tolerance": 0.01, "found": 1.02} for n in names]
    nothing = {"law_kind": "constant", "parameters": {}, "standard_errors": {}, "correlations": {}}
    found = FoundLaw.model_validate({**nothing, "adjusted": adjusted})
    assert [one.name for one in found.of_specimen] == names[:2]
