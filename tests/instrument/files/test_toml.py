"""Faults of a file in one line, in this program's words."""

import pytest
from pydantic import Field

from instrument.errors import BadInput
from instrument.files.toml import Positive, TomlTable, document_faults, parse_document, read_document


class Part(TomlTable):
    count: int = 1


class Small(TomlTable):
    number: Positive = 1.0
    count: int = 1
    on: bool = True
    name: str = ""
    several: tuple[float, ...] = ()
    young_gpa: Positive = 1.0
    part: list[Part] = Field(default_factory=list)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ('number = "0.3"', "number: '0.3', expected a number"),
        ("number = -1.0", "number: -1.0, expected a number greater than 0"),
        ("number = 7e10", "number: 70000000000.0, expected a number less than or equal to 1000000000"),
        (
            "young_gpa = 7e10",
            "young_gpa: 70000000000.0, expected a number less than or equal to 1000000000: is it in Pa?",
        ),
        ("number = nan", "number: nan, expected a finite number"),
        ("number = inf", "number: inf, expected a finite number"),
        ("count = 1.5", "count: 1.5, expected a whole number"),
        ("on = 1", "on: 1, expected true or false"),
        ("name = 3", "name: 3, expected text in quotes"),
        ("several = 3.0", "several: 3.0, expected a list"),
        ("[[part]]\n[[part]]\ncount = 1.5", "part, number 2, count: 1.5, expected a whole number"),
        ("part = [3]", "part, number 1: 3, expected a table"),
    ],
)
def test_what_was_expected_is_said_plainly(tmp_path, text, said):
    with pytest.raises(BadInput) as refused:
        parse_document(tmp_path / "a.toml", text, Small)
    assert str(refused.value) == f"{tmp_path / 'a.toml'}: {said}"


@pytest.mark.parametrize("end", ["\r", "\n", "\r\n"])
def test_a_file_is_read_whatever_ends_its_lines(tmp_path, end):
    path = tmp_path / "a.toml"
    path.write_bytes(end.join(["# a comment", "number = 2.5", "[[part]]", "count = 3", ""]).encode())
    read = read_document(path, Small)
    assert (read.number, read.part[0].count) == (2.5, 3)
    assert document_faults(path, Small) == []


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("count = 1\n\ncount  = 2  # again\nname = 'x'\n", "line 3: count stands twice, expected it once"),
        ("count = 1\ncount = 2", "line 2: count stands twice"),
        ("[part]\ncount = 1\n[part]\n", r"line 3: \[part\] stands twice"),
        ("[[part]]\ncount = 1\ncount = 2\n\n", "line 3: count stands twice"),
    ],
)
def test_a_key_that_stands_twice_is_named(tmp_path, text, said):
    (tmp_path / "a.toml").write_text(text)
    with pytest.raises(BadInput, match=rf"a\.toml: {said}"):
        read_document(tmp_path / "a.toml", Small)
    assert said.replace("\\", "") in document_faults(tmp_path / "a.toml", Small)[0]
