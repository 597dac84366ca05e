"""`viscorig sensors`: what there is, and what has expired."""

from datetime import date

from click.testing import CliRunner

from instrument.cli.main import run
from instrument.cli.sensors import sensors
from instrument.facts.sensors import SensorsResult
from instrument.files.new_file import TEMPLATES
from instrument.files.text import read_text


def test_it_lists_them_and_says_whose_calibration_is_over(tmp_path):
    path = tmp_path / "sensors.toml"
    text = read_text(TEMPLATES["sensors"]).replace("2026-03-02", "2019-03-02", 1)
    path.write_text(text.replace("2026-03-02", date.today().isoformat()))
    said = CliRunner().invoke(sensors, [str(path), "--json", "-"]).output
    found = SensorsResult.model_validate_json(said)
    first, second = found.sensors
    assert first.serial == "30112"
    assert first.calibrated_until == "2020-03-02"
    assert "expired on 2020-03-02" in first.remark
    assert second.remark == ""
    assert found.remarks == 1


def test_a_file_that_is_none_is_refused_in_a_line(tmp_path, capsys):
    path = tmp_path / "sensors.toml"
    path.write_text("[[sensor]]\nserial = '1'\nkind = 'force'\nsensitivity = 1.0\nunit = 'mV/g'\n")
    assert run(["sensors", str(path)]) == 2
    err = capsys.readouterr().err
    assert err.count("\n") == 1
    assert "expected mV/N" in err
