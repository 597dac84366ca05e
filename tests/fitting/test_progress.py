"""Work that nobody watches is told all the same."""

from fitting.progress import unheard


def test_a_fraction_that_nobody_asked_for_is_taken():
    assert unheard(0.5) is None
