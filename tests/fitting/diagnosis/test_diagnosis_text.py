"""Words of a diagnosis that say no more than is known."""

import pytest

from fitting.diagnosis.text import how_likely
from fitting.diagnosis.verdict import Judgement


@pytest.mark.parametrize(("none", "words"), [(0.52, "If anything,"), (0.3, "Most likely")])
def test_what_is_named_beside_a_likelier_none_is_not_called_most_likely(none, words):
    names = ("gain_error",)
    said = Judgement("ambiguous", None, {}, probability={(): none, names: 0.35})
    assert how_likely(said, names) == words
