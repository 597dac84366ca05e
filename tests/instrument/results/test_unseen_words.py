from diagnosis_cases import UNSEEN, diagnosis

from instrument.results.unseen_words import UNSEEN_COLUMNS, unseen_row, unseen_title


def test_a_row_says_how_large_it_may_be_and_what_it_would_do():
    row = unseen_row(UNSEEN[0])
    assert row == ("temperature_drift", "warming 2.27 K", "4", "26.9", "7.7", "8.0")
    assert len(row) == len(UNSEEN_COLUMNS)


def test_what_is_there_or_not_has_no_size_and_a_factor_no_unit():
    assert unseen_row(UNSEEN[1])[1] == "-"
    factor = UNSEEN[0].but(parameter="scale", size=1.00042, unit="1")
    assert unseen_row(factor)[1] == "scale 1.0004"


def test_a_number_without_unit_that_is_no_factor_has_three_digits():
    grade = UNSEEN[0].but(parameter="grade_x", size=0.064741, unit="1")
    assert unseen_row(grade)[1] == "grade_x 0.0647"


def test_a_length_is_in_millimetres_and_a_mass_in_grams():
    assert unseen_row(UNSEEN[0].but(parameter="dx", size=0.0002175, unit="m"))[1] == "dx 0.217 mm"
    assert unseen_row(UNSEEN[0].but(parameter="mass", size=0.00047, unit="kg"))[1] == "mass 0.47 g"


def test_the_title_says_beside_what_it_would_not_be_seen():
    """A candidate in the place of what was found has another size than one beside it."""
    assert "if it were there beside added_mass: how far" in unseen_title(diagnosis())
    assert "if it were there: how far" in unseen_title(diagnosis(verdict="none").but(equivalent={}))
