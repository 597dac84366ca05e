"""What is asked and said of files as they are read, in this order."""

from pathlib import Path

import pytest

from instrument.cli import reading
from instrument.cli.output import Output
from instrument.errors import BadInput
from instrument.paper_case import case_file

HEAD = (
    "frequency_hz,velocity_re_m_s,velocity_im_m_s,base_accel_re_m_s2,base_accel_im_m_s2,level_g,temperature_c"
)
SPECIMEN = Path(case_file("zn1.toml"))
NOTE = "is level_g in m/s^2?"


@pytest.fixture
def asked(monkeypatch):
    """The files whose data were looked at; nothing is found wrong with any."""
    found = []
    monkeypatch.setattr(reading, "question_data", lambda given, path, progress: found.append(path))
    return found


def files(folder, level, *temperatures):
    paths = []
    for k, warm in enumerate(temperatures):
        paths.append(folder / f"{k}.csv")
        rows = [f"{f + k},0.1,0.2,9.8,0,{level},{warm}" for f in (20.0, 30.0)]
        paths[-1].write_text("\n".join([HEAD, *rows, ""]))
    return paths


def read(paths, *, insist=False):
    return reading.read_each(Output(None), paths, [SPECIMEN], None, no_hammer=False, insist=insist)


@pytest.mark.parametrize(("level", "notes"), [(1.0, 0), (9.81, 2)])
def test_levels_far_from_the_base_are_noted_once_a_file_after_all_was_asked(
    tmp_path, capsys, asked, level, notes
):
    paths = files(tmp_path, level, 20, 20)
    read(paths)
    assert asked == paths
    assert capsys.readouterr().out.count(NOTE) == notes


@pytest.mark.parametrize("level", [1.0, 9.81])
def test_files_of_unlike_temperatures_are_asked_about_before_anything_is_noted(
    tmp_path, capsys, asked, level
):
    paths = files(tmp_path, level, 20, 40)
    with pytest.raises(BadInput, match="identify --shift"):
        read(paths)
    assert NOTE not in capsys.readouterr().out
    assert len(read(paths, insist=True)) == 2
    assert capsys.readouterr().out.count(NOTE) == (0 if level == 1.0 else 2)


def test_a_sweep_of_very_many_lines_is_asked_about_before_they_are_read(tmp_path, asked):
    (path,) = files(tmp_path, 1.0, 20.0)
    with path.open("a") as file:
        file.write("# a comment\n\n" + "no number,0.1,0.2,9.8,0,1,20\n" * 20_000)
    with pytest.raises(BadInput, match=r"0\.csv: 20002 lines make a fit long: a resonance"):
        read([path])
    with pytest.raises(BadInput, match=r"0\.csv: line 6: frequency_hz = 'no number', expected a number"):
        read([path], insist=True)
