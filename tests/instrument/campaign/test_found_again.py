"""Cases of the campaign on solid plates whose cause a search once passed by."""

import pytest

from instrument.campaign.plates.cases import draw_case
from instrument.campaign.plates.judged import diagnosed

PASSED_BY = {
    "a spot and a length far beyond their tolerances did a clamp line's work": ("clamp_line", 1300001),
    "two masses explained all before a free treatment was looked for": ("treatment_not_gripped", 1400029),
}


@pytest.mark.long
@pytest.mark.parametrize(("name", "seed"), PASSED_BY.values(), ids=PASSED_BY)
def test_what_was_passed_by_is_found(name, seed):
    answer = diagnosed(draw_case(name, seed))
    assert answer.verdict == "effect"
    assert answer.effects == (name,)
