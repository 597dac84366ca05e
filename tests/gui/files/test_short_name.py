from gui.files.short_name import MOST_LETTERS, short_name


def test_a_name_that_has_room_stays_as_it_is():
    name = "experiment-20261127T100038Z.h5"
    assert short_name(name) == name
    assert short_name("x" * MOST_LETTERS) == "x" * MOST_LETTERS


def test_a_long_one_keeps_how_it_begins_and_how_it_ends():
    name = "plate with everything that is known of it" * 3 + ", run 12.h5"
    short = short_name(name)
    assert len(short) == MOST_LETTERS
    begins, ends = short.split("\u2026")
    assert name.startswith(begins)
    assert name.endswith(ends)
    assert ends.endswith("run 12.h5")
    assert len(short_name(name, 9)) == 9
