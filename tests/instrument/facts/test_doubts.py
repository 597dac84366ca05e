"""Which remarks of a result are doubts."""

from types import SimpleNamespace as Result

import pytest

from instrument.facts.doubts import doubts_in, doubts_of

OLDER = (
    "stated numbers had to be moved, and the law may be biased beyond its band; see 'viscorig diagnose'",
    "the fit does not follow the data (rms 48 %): check units, level and pickup",
)
"""As files say it that have no key `doubts`."""
OTHER = "alpha lies within two standard errors of its upper bound"


def test_a_result_says_itself_what_is_a_doubt_whatever_its_remarks_say():
    said = Result(warnings=(OTHER, *OLDER), doubts=(OTHER,))
    assert doubts_of(said) == (OTHER,)
    assert doubts_of(Result(warnings=OLDER, doubts=())) == ()
    assert doubts_in({"warnings": [*OLDER], "doubts": []}) == ()


def test_files_of_older_versions_are_read_by_the_words_of_their_time():
    assert doubts_of(Result(warnings=(OTHER, *OLDER), doubts=None)) == OLDER
    assert doubts_in({"warnings": [OTHER, *OLDER]}) == OLDER


@pytest.mark.parametrize("facts", [{}, {"warnings": None}, {"warnings": "words", "doubts": 3}])
def test_a_json_that_is_none_of_ours_has_no_doubts(facts):
    assert doubts_in(facts) == ()
