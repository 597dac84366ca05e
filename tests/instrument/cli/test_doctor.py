"""`viscorig doctor`: what is found of an installation, and of instruments on their own wires."""

import json
import sys
from pathlib import Path

import pytest
from click.testing import CliRunner
from formula_rig import formula_rig

from instrument.check import installation
from instrument.cli.doctor import doctor
from instrument.cli.main import main
from instrument.facts.doctor import DoctorResult
from instrument.files.rig_file import RigDocument
from instrument.files.toml import read_document
from instrument.run.visit import visit


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


def test_a_fault_is_exit_2_and_one_line_and_in_the_json(rig, quick, tmp_path, monkeypatch, capfd):
    _, path = rig
    path.write_text(path.read_text().replace("[vibrometer]\n", "[vibrometer]\n# moved\n"))
    tty = read_document(path, RigDocument).vibrometer.address
    path.write_text(path.read_text().replace(tty, str(tmp_path / "no-such-port")))
    into = tmp_path / "doctor.json"
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
