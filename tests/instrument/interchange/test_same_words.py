"""What is no reading is refused in the same words by what reads a file of ours and by what imports one."""

import pytest

from instrument.errors import BadInput
from instrument.files.sweep_file import read_sweep
from instrument.interchange.importing import import_file


def said_by(read, *arguments):
    with pytest.raises(BadInput) as refused:
        read(*arguments)
    return str(refused.value)


@pytest.mark.parametrize("value", ["nan", "inf", "-inf", "-1", "\x00"])
def test_a_reading_that_is_none(tmp_path, value):
    path = tmp_path / "sweep.csv"
    rows = "".join(f"{f},0.1\n" for f in range(20, 30))
    path.write_text(f"frequency_hz,velocity_m_s\n{rows}30,{value}\n31,0.1\n")
    imported, read = said_by(import_file, path, tmp_path / "new.csv"), said_by(read_sweep, path)
    assert imported.removeprefix(f"{tmp_path}/") == read.removeprefix(f"{tmp_path}/")
    assert not (tmp_path / "new.csv").exists()
