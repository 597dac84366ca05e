"""What comes from files reaches the terminal as text only."""

import pytest

from instrument.cli.printable import printable


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("\x1b[31mred\x07", "\\x1b[31mred\\x07"),
        ("a\u202etoml.exe", "a\\x202etoml.exe"),
        ("\x9b2J", "\\x9b2J"),
        ("one\ttwo\nthree, 3 µm ± 1 °", "one\ttwo\nthree, 3 µm ± 1 °"),
    ],
)
def test_what_would_steer_a_terminal_is_shown_as_its_code(text, shown):
    assert printable(text) == shown
