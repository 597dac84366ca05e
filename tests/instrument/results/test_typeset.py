"""How a page or a window prints a terminal's words."""

import pytest

from instrument.results.typeset import capitalised, heading, note, typeset


def test_a_page_prints_what_a_terminal_writes_in_ascii_and_leaves_names_alone():
    assert typeset("k 2 +- 1 N/m^3, 0.3 -> 0.4 m/s^2") == "k 2 ± 1 N/m³, 0.3 → 0.4 m/s²"
    assert typeset("delay 1160.46 +- 1 us tells us") == "delay 1160.46 ± 1 µs tells us"
    assert typeset("a->b^2+-c.toml") == "a->b^2+-c.toml"


def test_a_number_has_the_same_exponent_with_an_error_and_without():
    assert typeset("elastic (2.7e+13 N/m^3 of clamped face).") == "elastic (2.7e13 N/m³ of clamped face)."
    assert typeset("-3e-05 and 4e+05.") == "-3e-5 and 4e5."
    assert typeset("1.044e-16, 2e13, run1e+05, 1e+05.toml") == "1.044e-16, 2e13, run1e+05, 1e+05.toml"


@pytest.mark.parametrize(
    ("said", "printed"),
    [
        ("the residual is large", "The residual is large"),
        ("ginf_pa and tau_s are correlated", "ginf_pa and tau_s are correlated"),
        ("", ""),
    ],
)
def test_a_sentence_begins_with_a_capital_and_a_name_with_its_own_letter(said, printed):
    assert capitalised(said) == printed


def test_a_note_names_parameters_without_their_unit_and_other_keys_whole():
    said = "ginf_pa and tau_s are correlated -0.994; g_1_pa is not; settle.most_s = 4 s"
    assert note(said) == "ginf and tau are correlated -0.994; g_1 is not; settle.most_s = 4 s."


def test_a_heading_has_room_about_its_unit():
    assert heading("loss factor by/%") == "loss factor by / %"
