"""`viscorig doctor`: what is found of an installation, and of instruments on their own wires."""

import json
import sys
from pathlib import Path

import pytest
from click.testing import CliRunner
from formula_rig import formula_rig

from drivers.modbus.line import ModbusLine
from instrument.check import installation
from instrument.cli.doctor import doctor
from instrument.cli.main import main
from instrument.facts.doctor import DoctorResult
from instrument.files.rig_file import RigDocument
from instrument.files.toml import read_document
from instrument.run.visit import visit
from instrument.simulated_case import case_file


@pytest.fixture
def rig(tmp_path):
    with formula_rig(tmp_path) as (rig, _):
        yield rig, tmp_path / "rig.toml"


@pytest.fixture
def quick(monkeypatch):
    """Without loading Qt in a process of its own."""
    monkeypatch.setattr(installation, "_TRY_WINDOW", "pass")


def by_name(path: Path):
    return {found.name: found for found in visit(read_document(path, RigDocument))}


def test_instruments_that_answer_are_named_and_left_as_they_are(rig):
    rig, path = rig
    before = len(rig.device.log)
    found = by_name(path)
    assert {one.state for one in found.values()} == {"good"}
    assert "serial number" in found["shaker"].found
    assert "limit 5 V" in found["shaker"].found
    assert "OFV-5000" in found["vibrometer"].found
    assert "light 0.80 of 1" in found["vibrometer"].found
    assert found["front_end"].found.startswith("LAN-XI")
    assert len(rig.device.log) == before


def test_a_module_that_records_goes_on_recording(rig):
    from drivers.front_end.interface import InputChannel
    from drivers.front_end.lan_xi import LanXiFrontEnd

    _, path = rig
    address = read_document(path, RigDocument).front_end.address
    module = LanXiFrontEnd(address, paced_by_reader=True)
    try:
        module.start((InputChannel(1, "base"),), 8192.0)
        first = module.read(64)
        assert by_name(path)["front_end"].state == "good"
        assert module.read(64).first_sample == first.first_sample + 64
    finally:
        module.close()


def test_one_that_does_not_answer_stops_none_of_the_others(rig):
    _, path = rig
    address = read_document(path, RigDocument).front_end.address
    path.write_text(path.read_text().replace(address, "http://127.0.0.1:9"))
    found = by_name(path)
    assert {name: one.state for name, one in found.items()} == {
        "shaker": "good",
        "vibrometer": "good",
        "front_end": "fault",
    }
    assert "127.0.0.1:9" in found["front_end"].found
    assert "ping" in found["front_end"].cure


def test_an_open_interlock_is_said(rig):
    rig, path = rig
    with rig.world.lock:
        rig.device.open_interlock(0.0)
    found = by_name(path)["shaker"]
    assert found.state == "fault"
    assert "interlock" in found.found


@pytest.mark.parametrize(
    ("limit_v", "state", "said"),
    [
        (5.0, "good", "limit 5 V"),
        (0.0, "fault", "its limit_v is 0 V, at least 0.001 V expected"),
        (5e30, "fault", "at most 1000 V expected"),
        (24.0, "remark", "limit 24 V, above limits.drive_v = 5 V: it does not protect"),
    ],
)
def test_a_limit_of_the_shaker_s_own_that_protects_nothing_is_said(rig, limit_v, state, said):
    rig, path = rig
    with rig.world.lock:
        rig.device.limit_v = limit_v
    found = by_name(path)["shaker"]
    assert found.state == state
    assert said in found.found


def test_a_shaker_whose_answers_get_lost_is_asked_for_its_cable(rig, monkeypatch):
    _, path = rig
    monkeypatch.setattr(ModbusLine, "lost_answers", property(lambda _: 2, lambda *_: None), raising=False)
    found = by_name(path)["shaker"]
    assert (found.state, found.found.split(": ")[-1]) == ("remark", "2 answers lost or damaged")
    assert "cable" in found.cure


@pytest.mark.parametrize(
    ("key", "said"),
    [
        ("sample_rate_hz = 10000.0", "10000 Hz is no sample rate of"),
        ("input = 33", "channel 33: SIM-LAN-XI has inputs 1 to 8"),
    ],
)
def test_what_the_front_end_will_refuse_to_sample_is_a_fault_before_any_run(rig, key, said):
    _, path = rig
    was = "sample_rate_hz = 8192.0" if "rate" in key else "input = 1"
    path.write_text(path.read_text().replace(was, key))
    found = by_name(path)["front_end"]
    assert found.state == "fault"
    assert said in found.found


def test_a_number_of_the_rig_that_check_would_question_is_a_note(rig, quick):
    _, path = rig
    usual = CliRunner().invoke(doctor, [str(path)])
    path.write_text(path.read_text().replace("velocity_m_s = 1.0", "velocity_m_s = 1000.0"))
    doubted = CliRunner().invoke(doctor, [str(path)])
    assert "rig\n" not in usual.output
    assert "note  its file             limits.velocity_m_s = 1000 is outside" in doubted.output
    assert doubted.exit_code == 0


def test_a_simulated_rig_is_in_order(quick):
    ended = CliRunner().invoke(doctor, [str(case_file("rig.toml"))])
    assert ended.exit_code == 0, ended.output
    assert "its file" not in ended.output


def test_a_fault_is_exit_2_and_one_line_and_in_the_json(rig, quick, tmp_path, monkeypatch, capfd):
    _, path = rig
    path.write_text(path.read_text().replace("[vibrometer]\n", "[vibrometer]\n# moved\n"))
    tty = read_document(path, RigDocument).vibrometer.address
    path.write_text(path.read_text().replace(tty, str(tmp_path / "no-such-port")))
    into = tmp_path / "doctor.json"
    monkeypatch.setattr("instrument.cli.main.hear_no_more", lambda **_: None)
    monkeypatch.setattr(sys, "argv", ["viscorig", "doctor", str(path), "--json", str(into)])
    with pytest.raises(SystemExit) as ended:
        main()
    assert ended.value.code == 2
    assert len(capfd.readouterr().err.strip().splitlines()) == 1
    found = DoctorResult.model_validate(json.loads(into.read_text()))
    assert not found.healthy
    assert [one.name for one in found.findings if one.state == "fault"] == ["vibrometer"]


def test_an_installation_in_order_is_exit_0(quick):
    ended = CliRunner().invoke(doctor, [])
    assert ended.exit_code == 0, ended.output
    assert "HDF5" in ended.output


def test_a_package_beyond_the_tested_range_is_a_fault_with_its_cure(monkeypatch):
    monkeypatch.setattr(installation, "requires", lambda _: ["numpy<1", "nowhere-to-be-found>=2"])
    old, missing = [one for one in installation._packages() if one.name != "viscorig"]
    assert (old.state, missing.state) == ("fault", "fault")
    assert old.cure == "pip install 'numpy<1'"
    assert missing.found == "not there"


def test_a_cache_that_cannot_be_written_is_remarked_on(monkeypatch, tmp_path):
    blocked = tmp_path / "file"
    blocked.write_text("")
    monkeypatch.setenv("VISCORIG_CACHE", str(blocked / "cache"))
    found = installation._cache()
    assert found.state == "remark"
    assert "VISCORIG_CACHE" in found.cure


def test_a_window_that_cannot_be_loaded_says_what_to_install(monkeypatch):
    monkeypatch.setattr(installation, "_TRY_WINDOW", "import no_such_library")
    assert installation._qt().cure == "pip install 'viscorig[gui]'"
