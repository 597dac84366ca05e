"""Files are called by their names alone in what the window says."""

import pytest

from gui.files.bare_names import bare_names


@pytest.mark.parametrize(
    ("said", "shown"),
    [
        ("/home/me/a.csv: the file is empty", "a.csv: the file is empty"),
        ("File 2: /home/me/a.csv: empty", "File 2: a.csv: empty"),
        ("C:\\data\\a.csv: empty", "a.csv: empty"),
        ("saved /home/me/x.toml", "saved x.toml"),
        (
            "/d/a.csv, /d/b.csv and /d/c.csv: in m/s, expected mm/s",
            "a.csv, b.csv and c.csv: in m/s, expected mm/s",
        ),
        ("/d/a.csv holds m/s", "a.csv holds m/s"),
        ("'/d/a.csv' (/d/b.csv)", "'a.csv' (b.csv)"),
        ("/home/me/run.running/: a folder", "run.running/: a folder"),
    ],
)
def test_the_folder_of_an_absolute_path_is_left_out(said, shown):
    assert bare_names(said) == shown


@pytest.mark.parametrize(
    "said",
    [
        "shaker: /dev/serial/by-id/usb0: no such device",
        "what is complete is kept: viscorig recover /out/a.running",
        "data/a.csv: empty",
        "1.5 m/s / 2 mm/s",
        "http://10.0.0.1/rest/rec: no answer",
        "/",
    ],
)
def test_devices_commands_and_all_that_is_no_path_stay(said):
    assert bare_names(said) == said
