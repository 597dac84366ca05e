"""One law over five temperatures: shifts and law as they were made, and no law where there is none."""

import json
from dataclasses import replace

import numpy as np
import pytest
from json_schema import faults
from temperature_cases import LAW, NOISE, REFERENCE, OneProcess, T, TwoProcesses, arrhenius, sweeps, wlf

from fitting.data.strays import strays
from fitting.dynamics.bare_modes import bare_modes
from fitting.plate.plate import Plate
from fitting.temperature.shifts import Shift
from instrument.cli.main import run
from instrument.errors import BadInput
from instrument.facts.schema import schema_of
from instrument.files.specimen_file import read_specimen
from instrument.paper_case import case_file
from instrument.temperatures.shifted import identify_shifted

FORMS = {"wlf": wlf(), "arrhenius": arrhenius()}


@pytest.fixture(scope="module")
def plate(coarse, mesh_is_right):
    return replace(coarse, exact=False)


@pytest.mark.long
@pytest.mark.parametrize("kind", FORMS)
def test_factors_lie_in_their_intervals_and_the_law_is_known_two_decades_further(plate, kind):
    truth = FORMS[kind]
    inside = []
    for seed in range(5):
        found = identify_shifted(sweeps(plate, [OneProcess(a) for a in truth], seed), plate, kind, REFERENCE)
        moved = T != REFERENCE
        off = (found.fit.log_shift - truth)[moved] / found.fit.log_shift_errors[moved]
        inside += (np.abs(off) < 1.96).tolist()
        assert found.verdict.simple
    assert np.mean(inside) >= 0.9
    f = found.band.frequency_hz
    G = LAW.modulus(2 * np.pi * f)
    assert np.log10(f[-1] / f[0]) > np.log10(300 / 14) + 2.0
    law = found.band.storage_modulus_pa * (1 + 1j * found.band.loss_factor)
    np.testing.assert_allclose(law, G, rtol=0.01)


def test_free_factors_are_those_of_the_form_that_made_them(plate):
    truth = wlf()
    found = identify_shifted(sweeps(plate, [OneProcess(a) for a in truth]), plate, "free", REFERENCE + 1)
    assert np.all(np.abs(found.fit.log_shift - truth) < 3.5 * found.fit.log_shift_errors + 1e-9)
    # Nothing is known between them.
    assert found.fit.shift.reference_c == REFERENCE
    assert any(f"the law is at {REFERENCE:g} degC, the nearest to" in one for one in found.warnings)


def test_readings_lost_at_one_temperature_are_left_out_and_said(plate):
    truth = wlf()
    every = sweeps(plate, [OneProcess(a) for a in truth])
    spoilt = every[2].data.velocity_m_s.copy()
    spoilt[[20, 40]] *= 0.03
    every[2] = replace(every[2], data=replace(every[2].data, velocity_m_s=spoilt))
    found = identify_shifted(every, plate, "wlf", REFERENCE)
    assert np.all(np.abs(found.fit.log_shift - truth) < 3.5 * found.fit.log_shift_errors + 1e-9)
    (said,) = (text for text in found.warnings if "set aside" in text)
    assert said.startswith(f"{every[2].name}: 2 readings leave the curve")


@pytest.mark.parametrize("seed", range(8))
def test_the_last_resonance_of_sixty_readings_over_the_band_is_not_lost(plate, seed):
    """An antiresonance at 200 Hz, two readings at the top at 280 Hz, one after them."""
    every = sweeps(plate, [OneProcess(a) for a in wlf()], seed)
    assert not any(strays(one.data).any() for one in every)


def test_a_vertical_shift_is_found_beside_the_horizontal_one(coarse):
    class Taller(OneProcess):
        def modulus(self, omega):
            return 1.05 * super().modulus(omega)

    laws = [Taller(a) if k == 4 else OneProcess(a) for k, a in enumerate(wlf())]
    found = identify_shifted(sweeps(coarse, laws), coarse, "wlf", REFERENCE, vertical=True)
    off = found.fit.log_vertical[4] - np.log(1.05)
    assert abs(off) < 3 * found.fit.log_vertical_errors[4]


def test_too_few_temperatures_for_a_form_are_refused(plate):
    some = sweeps(plate, [OneProcess(a) for a in wlf()])[:2]
    with pytest.raises(BadInput, match="wlf: 2 temperatures, expected 3"):
        identify_shifted(some, plate, "wlf")


@pytest.mark.parametrize("kind", ["wlf", "arrhenius", "free"])
def test_a_form_finds_its_own_parameters(kind):
    shift = Shift(kind, T, REFERENCE)
    truth = arrhenius() if kind == "arrhenius" else wlf()
    np.testing.assert_allclose(shift.log_shift(shift.near(truth)), truth, atol=1e-5)


def write(folder, plate, laws):
    paths = []
    for one in sweeps(plate, laws, points=40, noise=NOISE):
        s = one.data
        rows = [
            f"{f!r},{v.real!r},{v.imag!r},{e!r},{one.temperature_c}"
            for f, v, e in zip(
                s.frequency_hz.tolist(), s.velocity_m_s.tolist(), s.std_m_s.tolist(), strict=True
            )
        ]
        head = "frequency_hz,velocity_re_m_s,velocity_im_m_s,velocity_std_m_s,temperature_c"
        path = folder / one.name
        path.write_text("\n".join([head, *rows, ""]))
        paths.append(str(path))
    return paths


@pytest.fixture
def given(tmp_path):
    text = case_file("zn1.toml").read_text()
    path = tmp_path / "plate.toml"
    path.write_text(text + "\n[mesh]\nelements_x = 10\nelements_y = 10\n")
    return path


def test_the_command_fits_draws_and_says_so(tmp_path, given, capsys):
    paths = write(tmp_path, read_specimen(given), [OneProcess(a) for a in wlf()])
    figures, result = tmp_path / "figures", tmp_path / "shifted.json"
    command = ["identify", *paths, "--specimen", str(given), "--shift", "wlf", "--json", str(result)]
    status = run([*command, "--figures", str(figures)])
    said = capsys.readouterr()
    assert status == 0, said.err
    assert "thermorheologically simple as far as" in said.out
    assert {p.name for p in figures.iterdir()} == {"nomogram.png", "simplicity.png"}
    assert faults(json.loads(result.read_text()), schema_of("identify-shift")) == []


@pytest.mark.long
def test_the_command_refuses_in_one_line(tmp_path, given, capsys):
    laws = [TwoProcesses(a, b) for a, b in zip(arrhenius(4e4), arrhenius(1.6e5), strict=True)]
    given.write_text(given.read_text().replace("exact = true", "exact = false"))
    paths = write(tmp_path, read_specimen(given), laws)
    assert run(["identify", *paths, "--specimen", str(given), "--shift", "free"]) == 2
    assert "not thermorheologically simple" in capsys.readouterr().err


def test_a_hammer_test_of_the_bare_plate_takes_part_once_for_all(plate):
    modes, edge = bare_modes(Plate(plate.bare), 12, None)
    test = ((modes.omega * (1 - edge))[:8] / (2 * np.pi), np.array(plate.modal_ratios))
    made = sweeps(plate, [OneProcess(a) for a in arrhenius()], points=30)[::4]
    found = identify_shifted(made, plate, "arrhenius", REFERENCE, hammer=test)
    assert found.verdict.simple
    without = identify_shifted(made, plate, "arrhenius", REFERENCE)
    assert found.fit.one.residuals.size == without.fit.one.residuals.size + 8
    errors = [np.sqrt(f.fit.law_covariance[0, 0]) for f in (found, without)]
    assert errors[0] < errors[1]


def stated_otherwise(made, off):
    return [replace(one, temperature_c=one.temperature_c + k) for one, k in zip(made, off, strict=True)]


@pytest.mark.long
def test_temperatures_a_little_off_are_no_fault_of_the_material(plate):
    off = np.array([0.35, -0.2, 0.1, -0.4, 0.3])
    made = stated_otherwise(sweeps(plate, [OneProcess(a) for a in wlf()]), off)
    found = identify_shifted(made, plate, "wlf", REFERENCE)
    assert found.verdict.simple
    # At the temperatures as stated, by the form that made them.
    truth = Shift("wlf", T + off, REFERENCE).log_shift(np.array([4.0, 60.0]))
    assert np.all(np.abs(found.fit.log_shift - truth) < 3 * found.fit.log_shift_errors + 1e-9)
    exact = identify_shifted(made, plate, "wlf", REFERENCE, temperature_k=0.0)
    # A temperature that may move is one unknown and one reading more.
    assert found.fit.degrees == pytest.approx(exact.fit.degrees, abs=1.0)
    assert exact.verdict.simple is False
    assert "the temperatures as stated do not go with WLF" in exact.verdict.words


def test_one_wrong_temperature_is_named_and_the_material_is_not_blamed(plate):
    made = stated_otherwise(sweeps(plate, [OneProcess(a) for a in wlf()]), [0, 0, 0, 15.0, 0])
    found = identify_shifted(made, plate, "wlf", REFERENCE)
    words = found.verdict.words
    assert "28.csv is stated at 43 degC, its readings are those of 28." in words
    assert words.endswith("is not to be used")
    # Which of the others would be bent by it, is no cure.
    assert not any("farther from the form" in one for one in found.warnings)
    assert "loss factor" not in words
    free = identify_shifted(made, plate, "free", REFERENCE)
    assert any("the factor of 43 degC is above that of 36 degC" in one for one in free.warnings)


def test_three_temperatures_leave_wlf_nothing_that_checks_one(plate):
    made = stated_otherwise(sweeps(plate, [OneProcess(a) for a in wlf()])[:3], [0, 0, 20.0])
    found = identify_shifted(made, plate, "wlf", REFERENCE)
    assert any(one.startswith("3 temperatures fix WLF without one to spare") for one in found.warnings)
    whole = identify_shifted(sweeps(plate, [OneProcess(a) for a in wlf()]), plate, "wlf", REFERENCE)
    assert not any("to spare" in one for one in whole.warnings)


def test_temperatures_that_scatter_more_than_is_said_of_them_are_a_note(plate):
    off = [0.9, -0.8, 0.0, -1.1, 1.0]
    made = stated_otherwise(sweeps(plate, [OneProcess(a) for a in wlf()]), off)
    found = identify_shifted(made, plate, "wlf", REFERENCE)
    assert any("temperatures lie farther from the form than 0.3 K" in one for one in found.warnings)
