"""Text files are read whole or refused in one line; a misspelt name finds the one that was meant."""

import pytest

from instrument.errors import BadInput
from instrument.files.nearest import nearest
from instrument.files.text import read_text


def test_a_byte_order_mark_is_no_part_of_the_text(tmp_path):
    path = tmp_path / "a.csv"
    path.write_bytes(b"\xef\xbb\xbffrequency_hz\n1\n")
    assert read_text(path) == "frequency_hz\n1\n"


@pytest.mark.parametrize(
    ("content", "said"),
    [
        ("f,v\n1,2\n".encode("utf-16"), "UTF-16 text"),
        (b"f,\xff\n", "byte 2: not UTF-8"),
        (b"f,\0v\n", "byte 2: a NUL byte"),
        (b" \n\n", "the file is empty"),
    ],
)
def test_what_is_no_text_is_refused_by_its_place(tmp_path, content, said):
    path = tmp_path / "a.csv"
    path.write_bytes(content)
    with pytest.raises(BadInput, match=said):
        read_text(path)


def test_a_file_that_cannot_be_opened_is_refused(tmp_path):
    with pytest.raises(BadInput, match=r"no\.csv: No such file"):
        read_text(tmp_path / "no.csv")


def test_a_misspelt_name_finds_the_one_meant_and_a_strange_one_none():
    known = ("frequency_hz", "velocity_m_s", "base_accel_re_m_s2")
    assert nearest("frequncy_hz", known) == "frequency_hz"
    assert nearest("velocity_ms", known) == "velocity_m_s"
    assert nearest("colour", known) is None
