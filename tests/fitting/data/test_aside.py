"""Why readings take no part."""

import numpy as np

from fitting.data.aside import LOST, reasons


def test_only_what_is_set_aside_has_a_reason_and_any_other_word_fits_in_its_place():
    why = reasons(np.array([True, False]), LOST)
    assert list(why) == [LOST, ""]
    why[1] = "an effect of another package with a long name"
    assert why[1].endswith("long name")
