"""Kinds of stated numbers by what has one of its own."""

from typing import get_args

from fitting.stated.tolerances import IN_FILES, NUMBERS, OF_CHANNELS, OF_THEORY, PLATE, Scope, of_scope


def test_every_number_is_of_one_scope():
    each = [name for scope in get_args(Scope) for name in of_scope(scope)]
    assert sorted(each) == sorted(NUMBERS)


def test_what_is_not_alike_is_of_the_piece_of_how_it_is_held_or_of_how_it_is_read():
    assert of_scope("specimen", "mounting") == ("length", "width", "damping", "mass", "place")
    assert of_scope("temperature", "file", "spot") == ("pickup", "force", "axial")
    assert of_scope("channel", "chain") == OF_CHANNELS


def test_layers_and_what_a_theory_leaves_open_are_alike_wherever_they_are_stated_alike():
    assert set(of_scope("alike")) >= {
        *OF_THEORY,
        *(n for n in PLATE if n not in ("length", "width", "axial")),
    }


def test_what_files_say_of_a_tolerance_and_back_is_the_same():
    for said in IN_FILES.values():
        assert said.from_si * said.to_si == 1
    assert {number.unit for number in NUMBERS.values()} == set(IN_FILES)
