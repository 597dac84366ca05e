"""What stands where a file is to be written: kept, unless it was written so before."""

import json
import os
import re
from pathlib import Path

import pytest

from instrument.errors import BadInput
from instrument.files.replaceable import (
    JSON,
    PDF,
    Written,
    refuse_another_json,
    refuse_another_text,
    refuse_ending,
    refuse_for_json,
    refuse_to_lose,
)


@pytest.mark.parametrize("content", [b"", b'{"law": []}\n', b'\xef\xbb\xbf\n {"law": []}'])
def test_a_result_is_written_over_whatever_its_name(tmp_path, content):
    for name in ("found.json", "found.txt", "found"):
        (tmp_path / name).write_bytes(content)
        refuse_for_json(tmp_path / name)


@pytest.mark.parametrize("name", ["a.h5", "a.TOML", "a.csv", "a.uff", "a.mat", "batch.jsonl", "a.png"])
def test_a_result_has_no_ending_of_another_kind(tmp_path, name):
    said = f"{name}: ending '{os.path.splitext(name)[1]}', expected .json"
    with pytest.raises(BadInput, match=re.escape(said)):
        refuse_for_json(tmp_path / name)


def test_what_stands_there_is_named(tmp_path):
    for name, content, what in (
        ("a.json", b"\x89HDF\r\n\x1a\n", "JSON"),
        ("a.txt", b"f v\n1 2\n", "another file"),
        ("a.pdf", b"frequency_hz,velocity_m_s\n", "another file"),
    ):
        (tmp_path / name).write_bytes(content)
        with pytest.raises(BadInput, match=f"{name}: {what} stands there and is not written over"):
            refuse_to_lose(tmp_path / name, PDF if name == "a.pdf" else JSON)
        assert (tmp_path / name).read_bytes() == content


def test_a_json_that_no_command_wrote_is_kept(tmp_path):
    path = tmp_path / "a.json"
    law = {"law": [], "law_kind": "", "correlations": [], "max_percent": 1, "parameters": {}, "points": []}
    law |= {"rms_percent": 1, "standard_errors": {}, "storage_modulus_pa": [], "seconds": 1.0}
    path.write_text(json.dumps(law))
    refuse_another_json(path)
    # By an earlier version.
    path.write_text(json.dumps({**law, "of_another_version": 1, "seconds": None}))
    refuse_another_json(path)
    for other in ('{"name": "a package"}', "[]", "{", "\x00"):
        path.write_text(other)
        with pytest.raises(BadInput, match="is not written over"):
            refuse_another_json(path)
    path.write_text("")
    refuse_another_json(path)
    refuse_another_json(tmp_path / "new.json")


def test_a_device_and_a_new_name_are_free(tmp_path):
    for path in (Path(os.devnull), tmp_path / "new.json"):
        refuse_for_json(path)
    refuse_ending(Path(os.devnull), (".bdf",))
    with pytest.raises(BadInput, match=r"new: ending '', expected \.bdf or \.nas"):
        refuse_ending(tmp_path / "new", (".bdf", ".nas"))


def test_the_very_same_text_is_written_again_and_an_edited_one_kept(tmp_path):
    path = tmp_path / "plate.toml"
    refuse_another_text(path, "a = 1\n")
    for same in (b"a = 1\n", b"a = 1\r\n", b""):
        path.write_bytes(same)
        refuse_another_text(path, "a = 1\n")
    path.write_text("a = 2\n")
    with pytest.raises(BadInput, match=r"plate\.toml: .* stands there"):
        refuse_another_text(path, "a = 1\n")


def test_a_beginning_is_looked_for_in_bytes_of_any_kind(tmp_path):
    (tmp_path / "a.dat").write_bytes(bytes(range(256)))
    with pytest.raises(BadInput, match="stands there"):
        refuse_to_lose(tmp_path / "a.dat", Written(re.compile(b"#")))
