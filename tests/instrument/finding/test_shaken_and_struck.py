"""One plate shaken by its base and struck: files that a base and a force drive, under one law."""

import json

import numpy as np
import pytest
from plate_files import plate_text
from rivals import all_but

from fitting.dynamics.damping import viscous_damping
from fitting.dynamics.direct import displacement_direct
from fitting.identification.model import velocity
from fitting.plate.plate import Plate
from instrument.cli.main import run
from instrument.files.specimen_file import read_specimen
from instrument.finding.effect_names import effects_among
from instrument.models.files import File, mounted, one_plate

LAW = "ginf_mpa = 4.0\ntau_s = 1.5e-4\nalpha = 0.8"
READ = "[pickup]\nx_mm = 220.0\ny_mm = 60.0\n"
SHAKEN = plate_text("cantilever", LAW, (6, 4)) + READ + 'reads = "absolute"\n'
HIT = '[excitation]\nkind = "force"\nx_mm = 280.0\ny_mm = 100.0\n[tolerances]\ngain_percent = 1.0\n'
STRUCK = plate_text("cantilever", LAW, (6, 4)) + READ + HIT
# What the clamp gripped hangs with it.
FREE = plate_text("free", LAW, (6, 4)).replace("length_mm = 300.0", "length_mm = 325.0") + READ + HIT
WRONG = 1.12
F_HZ = np.arange(20.0, 221.0, 4.0)
OMEGA = 2 * np.pi * F_HZ


def start(text):
    return text.replace("g0_mpa = 0.4", "g0_mpa = 0.5")


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """In `shaken` the base's accelerometer reads 5 % too little: the plate seems to move that much more."""
    found = tmp_path_factory.mktemp("both")
    rng = np.random.default_rng(2)
    each = (("right", SHAKEN, 1.0), ("shaken", SHAKEN, WRONG), ("struck", STRUCK, 1.0), ("free", FREE, 1.0))
    for name, text, gain in each:
        (found / "true.toml").write_text(text)
        (found / f"{name}.toml").write_text(start(text))
        true = read_specimen(found / "true.toml")
        plate, G = Plate(true), true.core.law.modulus(OMEGA)
        x = displacement_direct(plate, viscous_damping(plate), OMEGA, G)
        v = gain * true.drive_amplitude * velocity(OMEGA, x, true.reads)
        v = v * (1 + 2e-3 * (rng.normal(size=len(v)) + 1j * rng.normal(size=len(v))))
        columns = {"frequency_hz": F_HZ, "velocity_re_m_s": v.real, "velocity_im_m_s": v.imag}
        columns["velocity_std_m_s"] = 2e-3 * np.abs(v)
        if true.drive == "force":
            columns |= {"force_re_n": np.ones(len(v)), "force_im_n": np.zeros(len(v))}
        header, rows = ",".join(columns), np.column_stack(list(columns.values()))
        np.savetxt(found / f"{name}.csv", rows, "%.12g", ",", header=header, comments="")
    return found


def line(command, folder, *names):
    data = [str(folder / f"{n}.csv") for n in names]
    return [command, *data, *(a for n in names for a in ("--specimen", str(folder / f"{n}.toml")))]


def said(capsys, arguments):
    assert run([*arguments, "--json", "-"]) == 0
    return json.loads(capsys.readouterr().out)


@pytest.mark.parametrize("other", ["struck", "free"])
def test_what_a_base_and_a_force_drive_gives_one_law(folder, capsys, other):
    result = said(capsys, line("identify", folder, "right", other))
    names = {a["name"] for a in result["adjusted"]}
    # A blow leaves the plate in its clamp as it is; hung free it is another length of it.
    assert ("length" in names) == (other == "struck")
    assert ("length [2]" in names) == (other == "free")
    assert {"gain [1]", "gain [2]", "core_thickness", "force_x [2]"} < names
    truth = read_specimen(folder / "true.toml").core.law
    for row in result["law"]:
        G = truth.modulus(np.array([2 * np.pi * row["frequency_hz"]]))[0]
        off = abs(row["storage_modulus_pa"] - G.real)
        assert off < 3 * row["storage_modulus_standard_error_pa"]


@pytest.mark.long
@pytest.mark.parametrize("other", ["struck", "free"])
def test_a_wrong_accelerometer_is_of_the_shaken_file_alone(folder, capsys, other):
    arguments = line("diagnose", folder, "shaken", other)
    for name in sorted(all_but("gain_error", "base_rocking", "substrate_stiffness", "clamp_compliance")):
        arguments += ["--without", name]
    result = said(capsys, arguments)
    assert result["verdict"] == "effect"
    (effect,) = result["effects"]
    assert (effect["name"], effect["parameters"]["file"]["value"]) == ("gain_error", 1.0)
    assert effect["parameters"]["factor"]["value"] == pytest.approx(WRONG, abs=0.012)
    rocking = next(c for c in result["candidates"] if c["name"] == "base_rocking")
    assert rocking["parameters"]["file"]["value"] == 1.0


def specimens(folder, *names):
    return [File(None, read_specimen(folder / f"{n}.toml"), n) for n in names]


def test_files_of_one_plate_say_which_have_a_base_a_clamp_and_a_mounting(folder):
    files = specimens(folder, "shaken", "struck", "free")
    assert one_plate(files)
    stands = {e.name: on for e, on in effects_among([f.specimen for f in files])}
    assert stands["base_rocking"] == stands["amplitude_softening"] == (True, False, False)
    assert stands["clamp_line"] == (True, True, False)
    assert stands["added_mass"] == (True, True, True)
    assert mounted(files, stands["clamp_line"]) == (1, 1, 0)
    assert mounted(files, stands["added_mass"]) == (1, 1, 3)
    # Clamped anew and struck then it is the second mounting that is struck.
    again = specimens(folder, "shaken", "shaken", "struck")
    assert mounted(again, (True, True, True)) == (1, 2, 2)
    assert mounted(specimens(folder, "struck", "shaken"), (True, True)) == (2, 2)


def test_another_plate_that_is_struck_is_another_plate(folder, tmp_path):
    other = STRUCK.replace("width_mm = 200.0", "width_mm = 210.0")
    (tmp_path / "other.toml").write_text(other)
    files = [*specimens(folder, "shaken"), *specimens(tmp_path, "other")]
    assert not one_plate(files)
    assert mounted(files, (True, True)) == (1, 2)


def test_an_effect_that_stands_on_no_file_cannot_be_accepted(folder, capsys):
    assert run([*line("diagnose", folder, "struck", "free"), "--accept", "base_rocking"]) == 2
    assert "driven by a force" in capsys.readouterr().err
