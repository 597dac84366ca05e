"""What speaks against an explanation by itself."""

import pytest
from verdict_cases import POOR_NONE, scored

from fitting.diagnosis.verdict.refusing import against, against_by_checks


@pytest.mark.parametrize(
    ("one", "why"),
    [
        (scored("gain_error", cost=0.0), ""),
        (scored("gain_error", cost=0.0, fails=True), "would leave such data once in"),
        (scored("gain_error", cost=0.0, too_large="gain_error"), ""),
        (scored("gain_error", "tether", cost=0.0, too_large="tether"), "has more of tether"),
        (scored("added_masses", "tether", cost=0.0), "supposes three things at once"),
        (scored("core_law", cost=0.0), "does not predict the segments"),
    ],
)
def test_an_explanation_is_refused_for_one_reason(one, why):
    said = against(POOR_NONE, one, lambda scored: 9.0)
    assert said.startswith(why)
    assert bool(said) == bool(why)


def test_checks_speak_by_the_weakest_of_them():
    assert "(signs)" in against_by_checks(scored("gain_error", cost=0.0, fails=True))
    assert against_by_checks(scored("gain_error", cost=0.0)) == ""
