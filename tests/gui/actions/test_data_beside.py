"""Other programs' data beside a session: read, read again where they were written anew, taken away."""

import pytest

from gui.actions.controller import AppController
from gui.actions.data_beside import DataBeside


@pytest.fixture
def beside(qapp):
    beside = DataBeside()
    yield beside
    beside.close()


def written(path, points):
    rows = "".join(f"{f},{0.01 * f},0.002\n" for f in range(15, 15 + points))
    path.write_text("frequency_hz,velocity_re_m_s,velocity_im_m_s\n" + rows)
    return path


def lay(qtbot, beside, path):
    beside.lay(path)
    qtbot.waitUntil(lambda: not beside.reading)


def test_a_file_is_told_with_what_it_holds_and_taken_away(qtbot, beside, tmp_path):
    told, changes = [], []
    beside.read.connect(lambda path, what: told.append((path.name, what)))
    beside.changed.connect(lambda: changes.append(len(beside.files)))
    path = written(tmp_path / "sweep.csv", 10)
    lay(qtbot, beside, path)
    assert told == [("sweep.csv", "1 sweep")]
    beside.take_away()
    assert changes == [1, 0]


def test_only_a_file_written_anew_is_told_as_such(qtbot, beside, tmp_path):
    anew, path = [], written(tmp_path / "sweep.csv", 10)
    beside.renewed.connect(anew.append)
    for _ in range(2):
        lay(qtbot, beside, path)
    assert anew == []
    written(path, 12)
    lay(qtbot, beside, path)
    assert anew == [path]
    assert len(beside.files[path].sweeps[0]["frequency_hz"]) == 12


def test_what_cannot_be_read_leaves_what_is_there(qtbot, beside, tmp_path):
    said, path = [], written(tmp_path / "sweep.csv", 10)
    beside.failed.connect(said.append)
    lay(qtbot, beside, path)
    bad = tmp_path / "bad.csv"
    bad.write_bytes(b"\x00\xff")
    lay(qtbot, beside, bad)
    assert len(said) == 1
    assert list(beside.files) == [path]


FILES_THAT_ARE_NOT_DRAWN = {
    "a table of modes": (
        "mode,frequency_hz,loss_factor\n1,74.3,0.221\n2,365.6,0.2228\n",
        "1 table of modes read; a law of them: Several files",
    ),
    "a record in time": (
        "time_s,force_n,velocity_m_s\n"
        + "".join(f"{k / 1024},{k == 20:d},{0.001 * (k > 20)}\n" for k in range(2048)),
        "1 hit read; drawn on Hammer once a session with hits is open; damping ratios of records in time: "
        "viscorig damping given.csv",
    ),
    "an FRF over a force": (
        "frequency_hz,mobility_re,mobility_im\n" + "".join(f"{f},0.01,0.002\n" for f in range(10, 90)),
        "1 FRF read; drawn on Hammer once a session with hits is open",
    ),
}


@pytest.mark.parametrize("kind", FILES_THAT_ARE_NOT_DRAWN)
def test_a_file_that_no_open_page_draws_is_told_where_it_goes(qtbot, tmp_path, kind):
    text, told = FILES_THAT_ARE_NOT_DRAWN[kind]
    path, said = tmp_path / "given.csv", []
    path.write_text(text)
    controller = AppController()
    controller.said.connect(said.append)
    lay(qtbot, controller.data_beside, path)
    controller.close()
    assert said == [f"given.csv: {told}"]
