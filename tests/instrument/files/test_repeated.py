"""A measurement that is given twice is refused in one line, whatever its files are called."""

import pytest

from instrument.cli.main import run
from instrument.errors import BadInput
from instrument.files.repeated import refuse_repeats


def files(folder, *texts):
    paths = [folder / f"{k}.csv" for k in range(len(texts))]
    for path, text in zip(paths, texts, strict=True):
        path.write_text(text, encoding="utf-8")
    return paths


def test_equal_contents_are_refused_and_both_named(tmp_path):
    paths = files(tmp_path, "1,2\n", "1,3\n", "1,2\n")
    with pytest.raises(BadInput, match=r"2\.csv: the same data as .*0\.csv, to the last byte"):
        refuse_repeats(paths)
    refuse_repeats(paths[:2])


def test_one_file_named_twice_is_refused(tmp_path):
    (path,) = files(tmp_path, "1,2\n")
    with pytest.raises(BadInput, match="expected a measurement once"):
        refuse_repeats([path, path])


def test_files_that_are_not_there_are_left_to_who_reads_them(tmp_path):
    refuse_repeats([tmp_path / "gone.csv", tmp_path / "gone.csv", tmp_path])


@pytest.mark.parametrize("command", ["identify", "diagnose"])
def test_the_commands_refuse_it_before_anything_else(tmp_path, capsys, command):
    paths = files(tmp_path, "1,2\n", "1,2\n")
    assert run([command, *map(str, paths), "--specimen", str(tmp_path / "none.toml")]) == 2
    assert "1.csv: the same data as" in capsys.readouterr().err


def test_a_record_of_blows_is_no_second_hit_under_another_name(tmp_path, capsys):
    paths = files(tmp_path, "1,2\n", "1,2\n")
    assert run(["damping", *map(str, paths)]) == 2
    assert "1.csv: the same data as" in capsys.readouterr().err
