"""Text files are read whole or refused in one line; a misspelt name finds the one that was meant."""

import os

import pytest

from instrument.errors import BadInput
from instrument.files import text
from instrument.files.experiment_file import read_experiment
from instrument.files.nearest import nearest
from instrument.files.records import Named, read_records
from instrument.files.structure_file import read_structure
from instrument.files.table import read_rows
from instrument.files.text import read_text
from instrument.interchange.decoded import decoded
from instrument.interchange.read_csv import read_csv
from instrument.interchange.readers import read_foreign
from instrument.session.storage import SessionFile


def test_a_byte_order_mark_is_no_part_of_the_text(tmp_path):
    path = tmp_path / "a.csv"
    path.write_bytes(b"\xef\xbb\xbffrequency_hz\n1\n")
    assert read_text(path) == "frequency_hz\n1\n"


def test_a_lone_carriage_return_ends_a_line_and_other_line_ends_stay(tmp_path):
    path = tmp_path / "a.csv"
    path.write_bytes(b"f,v\r1,2\r\n3,4\n")
    assert read_text(path) == "f,v\n1,2\r\n3,4\n"


@pytest.mark.parametrize(
    ("content", "said"),
    [
        ("f,v\n1,2\n".encode("utf-16"), "UTF-16 text"),
        (b"f,\xff\n", "byte 2: not UTF-8"),
        (b"f,\0v\n", "byte 2: a NUL byte"),
        (b"\x89PNG\r\n\x1a\n", "a picture, expected text"),
        (b"%PDF-1.7\n", "a PDF document, expected text"),
        (b"f,\xff\0\n", "a binary file, expected text"),
        (b" \n\n", "the file is empty"),
    ],
)
def test_what_is_no_text_is_refused_by_its_place(tmp_path, content, said):
    path = tmp_path / "a.csv"
    path.write_bytes(content)
    with pytest.raises(BadInput, match=said):
        read_text(path)


def test_a_folder_is_no_file(tmp_path):
    with pytest.raises(BadInput, match="a folder, expected a file"):
        read_text(tmp_path)


def test_a_file_that_cannot_be_opened_is_refused(tmp_path):
    with pytest.raises(BadInput, match=r"no\.csv: No such file"):
        read_text(tmp_path / "no.csv")


def test_a_misspelt_name_finds_the_one_meant_and_a_strange_one_none():
    known = ("frequency_hz", "velocity_m_s", "base_accel_re_m_s2")
    assert nearest("frequncy_hz", known) == "frequency_hz"
    assert nearest("velocity_ms", known) == "velocity_m_s"
    assert nearest("colour", known) is None


def test_a_pipe_is_refused_and_not_waited_for(tmp_path):
    os.mkfifo(tmp_path / "a.csv")
    with pytest.raises(BadInput, match=r"a\.csv: a pipe or a device, expected a file"):
        read_text(tmp_path / "a.csv")
    with pytest.raises(BadInput, match="expected a file"):
        SessionFile(tmp_path / "a.csv")


def test_a_link_to_itself_is_no_file(tmp_path):
    (tmp_path / "a.csv").symlink_to("a.csv")
    with pytest.raises(BadInput, match=r"a\.csv: "):
        read_text(tmp_path / "a.csv")


@pytest.mark.parametrize(
    ("name", "said"),
    [
        (
            "a.csv",
            r'expected UTF-8: save it as such \("CSV UTF-8"\), or .viscorig import. reads',
        ),
        ("a.toml", "UTF-16 text, expected UTF-8: save it as such$"),
    ],
)
def test_utf_16_is_told_the_cure_of_its_kind_of_file(tmp_path, name, said):
    (tmp_path / name).write_text('title = "x"\n', encoding="utf-16")
    with pytest.raises(BadInput, match=said):
        read_text(tmp_path / name)


@pytest.mark.parametrize(
    ("name", "content", "said"),
    [
        ("a.csv", b"PK\x03\x04..xl/workbook.xml", "an Excel workbook, expected text: save it as CSV"),
        ("a.csv", b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1..", "an Excel workbook, expected text: save it as CSV"),
        ("a.toml", b"PK\x03\x04..xl/workbook.xml", "an Excel workbook, expected text$"),
        ("a.csv", b"PK\x03\x04..", "a packed archive, expected text$"),
    ],
)
@pytest.mark.parametrize("read", [read_text, decoded])
def test_a_workbook_is_called_one_whatever_its_name(tmp_path, read, name, content, said):
    (tmp_path / name).write_bytes(content)
    with pytest.raises(BadInput, match=said):
        read(tmp_path / name)


def test_a_workbook_is_known_by_its_ending_where_no_reader_takes_it(tmp_path):
    (tmp_path / "a.xlsx").write_bytes(b"PK\x03\x04")
    for read in (read_foreign, lambda path: read_records(path, Named())):
        with pytest.raises(BadInput, match=r"a\.xlsx: an Excel workbook, expected text: save it as CSV"):
            read(tmp_path / "a.xlsx")


def test_an_endless_line_is_refused_before_it_is_split(tmp_path, monkeypatch):
    monkeypatch.setattr(text, "LONGEST_LINE", 100)
    path = tmp_path / "a.csv"
    path.write_text("frequency_hz,velocity_m_s\n" + "1," * 51)
    for read in (read_rows, read_csv):
        with pytest.raises(BadInput, match=r"a\.csv: line 2: 102 letters, expected at most 100"):
            read(path)


def test_what_is_too_large_for_toml_is_refused_unread(tmp_path):
    path = tmp_path / "a.toml"
    path.write_text("# more than anybody writes by hand\n" * 30_000)
    for read in (read_structure, read_experiment):
        with pytest.raises(BadInput, match=r"a\.toml: 1050000 bytes, expected at most 1000000"):
            read(path)


def test_a_session_is_no_impact_record_and_its_hits_can_be_written(tmp_path):
    (tmp_path / "a b.h5").write_bytes(b"x")
    with pytest.raises(
        BadInput, match=r"a session, .*: viscorig export '.*/a b\.h5' --to csv writes its hits"
    ):
        read_records(tmp_path / "a b.h5", Named())
