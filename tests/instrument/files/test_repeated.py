"""A measurement that is given twice is refused in one line, whatever its files are called."""

import pytest

from instrument.cli.main import run
from instrument.errors import BadInput
from instrument.files.modal_table import read_modal_table
from instrument.files.repeated import refuse_repeats, refuse_same_modes, refuse_same_points
from instrument.files.sweep_file import read_sweep
from instrument.paper_case import case_file


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


SWEEP = "frequency_hz,velocity_re_m_s,velocity_im_m_s\n20,0.1,0.2\n21,0.3,0.4\n22,0.2,0.5\n"
MODES = "mode,frequency_hz,loss_factor\n1,20,0.1\n2,120,0.2\n"


def again(text, *, comment=False, turned=False, left=None):
    header, *rows = text.splitlines()
    return "\n".join([*(["# again"] if comment else []), header, *rows[:: -1 if turned else 1][:left]])


@pytest.mark.parametrize(
    ("how", "said"),
    [({"comment": True}, "the same"), ({"turned": True}, "the same"), ({"left": 2}, "all of the fewer")],
)
def test_its_points_are_known_in_any_order_and_beside_any_comment(tmp_path, how, said):
    paths = files(tmp_path, SWEEP, again(SWEEP, **how))
    refuse_repeats(paths)
    with pytest.raises(BadInput, match=rf"1\.csv: {said} points as in .*0\.csv: expected a measurement once"):
        refuse_same_points(paths, [read_sweep(path).sweep(9.81) for path in paths])
    paths = files(tmp_path, MODES, again(MODES, comment=True, turned=how.get("turned", False)))
    with pytest.raises(BadInput, match=r"1\.csv: the same modes as in"):
        refuse_same_modes(paths, [read_modal_table(path) for path in paths])


def test_points_measured_anew_are_others(tmp_path):
    paths = files(tmp_path, SWEEP, SWEEP.replace("0.3", "0.3001"))
    refuse_same_points(paths, [read_sweep(path).sweep(9.81) for path in paths])


@pytest.mark.parametrize(("command", "text"), [("identify", SWEEP), ("diagnose", SWEEP), ("identify", MODES)])
def test_the_commands_refuse_the_same_points_before_they_fit(tmp_path, capsys, command, text):
    paths = files(tmp_path, text, again(text, comment=True))
    assert run([command, *map(str, paths), "--specimen", str(case_file("zn1.toml"))]) == 2
    assert "expected a measurement once" in capsys.readouterr().err
