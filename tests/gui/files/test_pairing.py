"""Which specimen data are taken to be of, and what the commands are told."""

from pathlib import Path

import pytest

from gui.files.pairing import PairedFile, arguments_of, fault_of, paired, with_specimen

A, B, S = Path("a.csv"), Path("b.csv"), Path("s.h5")
ONE, TWO = Path("one.toml"), Path("two.toml")


def test_one_specimen_serves_all_files_that_have_none_of_their_name():
    files = paired([A, B], [PairedFile(Path("c.csv"), ONE)], {})
    assert [f.specimen for f in files] == [ONE, ONE, ONE]


def test_a_specimen_of_the_data_s_name_beside_them_is_theirs(tmp_path):
    for name in ("light.csv", "light.toml", "heavy.csv"):
        (tmp_path / name).touch()
    files = paired([tmp_path / "light.csv", tmp_path / "heavy.csv"], [], {})
    assert [f.specimen for f in files] == [tmp_path / "light.toml"] * 2


def test_what_data_had_last_time_comes_before_what_lies_beside_them(tmp_path):
    data = tmp_path / "light.csv"
    for path in (data, data.with_suffix(".toml")):
        path.touch()
    (file,) = paired([data], [], {data.resolve(): TWO})
    assert file.specimen == TWO


def test_a_session_keeps_its_own_and_a_file_is_there_once():
    files = paired([S, A, A], [PairedFile(A, ONE)], {})
    assert files == (PairedFile(A, ONE), PairedFile(S))


def test_a_specimen_chosen_for_one_file_is_given_to_all_that_lack_one():
    files = (PairedFile(A), PairedFile(B), PairedFile(S))
    chosen = with_specimen(files, 0, ONE)
    assert [f.specimen for f in chosen] == [ONE, ONE, None]
    assert [f.specimen for f in with_specimen(chosen, 1, TWO)] == [ONE, TWO, None]
    assert [f.specimen for f in with_specimen(chosen, None, TWO)] == [TWO] * 3


def test_a_hammer_test_goes_with_all_files():
    files = (PairedFile(A, ONE), PairedFile(B, ONE))
    assert arguments_of(files, S) == ["a.csv", "b.csv", "--specimen", "one.toml", "--hammer", "s.h5"]


@pytest.mark.parametrize(
    ("files", "said"),
    [
        ((), "Add a file"),
        ((PairedFile(S),), "A session by itself is opened"),
        ((PairedFile(A, ONE), PairedFile(B)), "File 2, b.csv: no specimen"),
        ((PairedFile(A, ONE), PairedFile(S)), "File 2: a session with its own specimen beside chosen ones"),
        ((PairedFile(A, ONE), PairedFile(B, TWO)), ""),
        ((PairedFile(S), PairedFile(Path("t.h5"))), ""),
    ],
)
def test_what_cannot_be_fitted_together_is_said_in_a_line(files, said):
    assert fault_of(files).startswith(said)
    assert bool(fault_of(files)) == bool(said)
    assert "\n" not in fault_of(files)


@pytest.mark.parametrize(
    ("files", "said"),
    [
        ([PairedFile(A, ONE), PairedFile(B, TWO)], "a.csv b.csv --specimen one.toml --specimen two.toml"),
        ([PairedFile(A, ONE), PairedFile(B, ONE)], "a.csv b.csv --specimen one.toml"),
        ([PairedFile(S), PairedFile(Path("t.h5"))], "s.h5 t.h5"),
    ],
)
def test_files_are_paired_as_on_the_command_line(files, said):
    assert " ".join(arguments_of(files)) == said
