import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import scipy.sparse as sp
from bare_plates import frequencies_hz
from bare_plates import zn1 as zn1
from paper_law import TABLE_4
from scipy.sparse.linalg import eigsh

from fitting.dynamics.bare_modes import (
    CarriedSensor,
    clamp_softness,
    edge_softening,
    loaded_modes,
)
from fitting.dynamics.real_modes import real_modes
from fitting.errors import OutsideModel, TooFewPoints
from fitting.identification.bare_plate import (
    fit_bare_plate,
    with_bare_plate,
)
from fitting.plate.plate import Plate
from fitting.plate.plate_numbers import moved
from instrument.bench.sweeps import synthetic_sweep
from instrument.cli.main import run
from instrument.finding.identification import identify
from instrument.models.files import File
from instrument.paper_case import case_file

OMEGA = 2 * np.pi * np.array([20.0, 100.0, 280.0])


@pytest.fixture(scope="module")
def stiff(zn1):
    """The plate as it is: its substrate 6 % stiffer than the specimen file says."""
    return moved(zn1, ["substrate_young"], [np.log(1.06)])


@pytest.fixture(scope="module")
def unsure(zn1):
    """What its specimen file says, the substrate's modulus from a table."""
    return replace(zn1, exact=False, tolerances={"substrate_young": 0.05})


@pytest.fixture(scope="module")
def bare_hz(stiff):
    return frequencies_hz(stiff)


def hammer(bare_hz, seed):
    return bare_hz * (1 + 5e-4 * np.random.default_rng(seed).normal(size=8))


def test_stiffness_is_found_within_half_a_percent_and_its_error_is_honest(zn1, bare_hz):
    fits = [fit_bare_plate(zn1, hammer(bare_hz, seed), np.array(zn1.modal_ratios)) for seed in range(30)]
    error = np.log([f.young_scale for f in fits]) - np.log(1.06)
    assert np.max(np.abs(error)) < 5e-3
    stated = np.mean([f.standard_error for f in fits])
    assert 0.4 * stated < np.std(error) < 1.3 * stated


def thin_sweep(stiff):
    sweep = synthetic_sweep(stiff)
    return sweep.take(np.arange(0, len(sweep.frequency_hz), 2))


@pytest.fixture(scope="module")
def joint(stiff, unsure, bare_hz):
    """Identified with a hammer test and without, and as if all that is stated were exact."""
    sweep, test = thin_sweep(stiff), (hammer(bare_hz, 0), np.array(unsure.modal_ratios))
    return {
        "with": identify([File(sweep, unsure)], hammer=test).result,
        "without": identify([File(sweep, unsure)]).result,
        "exact": identify([File(sweep, replace(unsure, exact=True))], hammer=test).result,
    }


def error_and_band(r):
    """Of ln G' at three frequencies."""
    G, G_true = r.fit.law.storage_and_loss(OMEGA)[0], TABLE_4.storage_and_loss(OMEGA)[0]
    at = [int(np.argmin(np.abs(r.band.frequency_hz - w / (2 * np.pi)))) for w in OMEGA]
    return np.abs(np.log(G / G_true)), r.band.storage_modulus_standard_error_pa[at] / G


def test_joint_with_the_hammer_the_core_is_right_and_by_what_is_stated_wrong(joint):
    error, band = error_and_band(joint["with"])
    assert np.all(error < 1.96 * band)
    assert np.all(error < 0.05)
    # What is taken for exact is believed, whatever the hammer says.
    assert np.all(error_and_band(joint["exact"])[0] > 0.05)


def test_the_hammer_narrows_the_band_and_finds_the_stiffness(joint, unsure):
    (_, band), (wide_error, wide) = (error_and_band(joint[k]) for k in ("with", "without"))
    assert np.all(band < wide)
    assert np.all(wide_error < 1.96 * wide)
    (young,) = (a for a in joint["with"].fit.adjusted if a.name == "substrate_young")
    assert young.stated == pytest.approx(1e-9 * unsure.substrate.young_pa)
    assert young.found == pytest.approx(1.06 * young.stated, abs=3 * young.standard_error)
    assert young.standard_error < 0.3 * young.tolerance
    # It feels the stiffness over the mass alone: density and thickness are as uncertain as before.
    for one in joint["with"].fit.adjusted:
        if one.name in ("substrate_density", "substrate_thickness"):
            assert one.standard_error > 0.5 * one.tolerance


def test_a_soft_clamp_of_the_hammer_test_is_not_taken_for_a_soft_plate(zn1, bare_hz):
    plate = Plate(zn1.bare)
    softness = clamp_softness(plate, real_modes(plate, 0.0, 8))
    assert softness[0] == 1
    soft = bare_hz * np.exp(-0.008 * softness)
    fit = fit_bare_plate(zn1, soft, np.array(zn1.modal_ratios))
    assert fit.young_scale == pytest.approx(1.06, rel=5e-3)
    assert fit.clamp_percent == pytest.approx(0.8, abs=0.15)


def test_ratios_go_to_their_modes_though_some_are_missing(zn1, bare_hz):
    measured = np.array([0.31, 0.20, 0.10]) / 100
    fit = fit_bare_plate(zn1, bare_hz[[0, 3, 6]], measured)
    expected = np.array(zn1.modal_ratios)
    expected[[0, 3, 6]] = measured
    np.testing.assert_allclose(fit.ratios, expected)


def test_foreign_modes_are_left_out_or_refused(zn1, bare_hz):
    fit = fit_bare_plate(zn1, np.append(bare_hz, 30.0), np.append(zn1.modal_ratios, 0.01))
    assert fit.left_out_hz == (30.0,)
    with pytest.raises(TooFewPoints, match="expected 2 or more"):
        fit_bare_plate(zn1, np.array([3.0, 30.0]), np.array([0.01, 0.01]))


def test_another_plates_modes_are_refused(zn1, bare_hz):
    with pytest.raises(TooFewPoints, match="is it this specimen"):
        fit_bare_plate(zn1, 1.6 * bare_hz, np.array(zn1.modal_ratios))


def test_identify_takes_the_hammers_json(zn1, stiff, bare_hz, tmp_path, capsys):
    modes = [
        {"frequency_hz": f, "damping_ratio": z, "accepted": True}
        for f, z in zip(hammer(bare_hz, 1), zn1.modal_ratios, strict=True)
    ]
    (tmp_path / "h.json").write_text(
        json.dumps({"modes": [*modes, {"frequency_hz": 1.0, "accepted": False}]})
    )
    sweep = thin_sweep(stiff)
    rows = [
        f"{f!r},{v.real!r},{v.imag!r}"
        for f, v in zip(sweep.frequency_hz.tolist(), sweep.velocity_m_s.tolist(), strict=True)
    ]
    (tmp_path / "s.csv").write_text("\n".join(["frequency_hz,velocity_re_m_s,velocity_im_m_s", *rows]))
    published = case_file("zn1.toml").read_text(encoding="utf-8")
    assert "exact = true" in published
    specimen = tmp_path / "zn1.toml"
    unsure = published.replace("exact = true", "substrate_young_percent = 5.0")
    specimen.write_text(f"{unsure}\n[mesh]\nelements_x = 10\nelements_y = 10\n", encoding="utf-8")
    call = ["identify", str(tmp_path / "s.csv"), "--specimen", str(specimen)]
    assert run([*call, "--hammer", str(tmp_path / "h.json"), "--json", "-"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["hammer"]["substrate_young_over_stated"] == pytest.approx(1.06, rel=5e-3)
    young = found["hammer"]["substrate_young_pa"]
    assert young == pytest.approx(1.06 * zn1.substrate.young_pa, rel=5e-3)
    (adjusted,) = (one for one in found["adjusted"] if one["name"] == "substrate_young")
    assert 1e9 * adjusted["found"] == pytest.approx(young, rel=0.02)
    (at_100,) = (row for row in found["law"] if row["frequency_hz"] == 100)
    G_true = TABLE_4.storage_and_loss(OMEGA)[0][1]
    error = at_100["storage_modulus_standard_error_pa"]
    assert at_100["storage_modulus_pa"] == pytest.approx(G_true, abs=1.96 * error)
    assert error < 0.04 * G_true


@pytest.mark.parametrize(
    "text",
    [
        "",
        "{",
        '{"modes": 3}',
        '{"modes": []}',
        '{"modes": [{"frequency_hz": -1}]}',
        '{"modes": [{"frequency_hz": 17.7, "damping_ratio": 0.29}]}',  # percent for a fraction
    ],
)
def test_bad_hammer_json_is_refused_in_one_line(tmp_path, capsys, text):
    path: Path = tmp_path / "h.json"
    path.write_text(text)
    call = ["identify", str(case_file("table5.csv")), "--specimen", str(case_file("zn1.toml"))]
    assert run([*call, "--hammer", str(path)]) == 2
    err = capsys.readouterr().err
    assert err.count("\n") == 1
    assert "h.json" in err


def test_for_a_method_without_tolerances_the_tests_stiffness_is_put_in(zn1, bare_hz):
    bare = fit_bare_plate(zn1, bare_hz, np.array(zn1.modal_ratios))
    after = with_bare_plate(replace(zn1, tolerances={"core_thickness": 0.05}), bare)
    assert after.tolerances == {"core_thickness": 0.05, "substrate_young": bare.standard_error}
    assert after.substrate.young_pa == pytest.approx(1.06 * zn1.substrate.young_pa, rel=5e-3)


def with_sensor_hz(plate, sensor, count=8):
    """Frequencies of the full plate with a point mass on it, solved as such."""
    row = sp.csc_array(plate.observe(sensor.x_m, sensor.y_m)[None])
    squared = eigsh(
        plate.K_0.real.tocsc(), count, (plate.M + sensor.mass_kg * (row.T @ row)).tocsc(), sigma=0.0
    )[0]
    return np.sqrt(np.sort(squared)) / (2 * np.pi)


def test_a_gram_at_the_tip_takes_half_a_percent_off_mode_1(zn1, stiff):
    plate = Plate(stiff.bare)
    tip = CarriedSensor(1e-3, zn1.length_m, zn1.width_m / 2)
    loaded = loaded_modes(plate, real_modes(plate, 0.0, 12), tip).omega[:8] / (2 * np.pi)
    np.testing.assert_allclose(loaded, with_sensor_hz(plate, tip), rtol=2e-5)
    unloaded = real_modes(plate, 0.0, 8).omega / (2 * np.pi)
    assert 100 * (1 - loaded[0] / unloaded[0]) == pytest.approx(0.64, abs=0.1)


def test_a_sensor_off_the_plate_is_called_what_it_is(zn1):
    off = CarriedSensor(1e-3, 0.25, 2 * zn1.width_m)
    with pytest.raises(OutsideModel, match=r"hammer test's accelerometer \(250, 399.8\) mm is off the"):
        fit_bare_plate(zn1, np.array([18.0, 60.0]), np.array([0.003, 0.003]), off)


def test_the_sensors_mass_is_not_taken_for_a_soft_plate(zn1, stiff):
    sensor = CarriedSensor(2e-3, 0.25, 0.03)
    measured = frequencies_hz(stiff, sensor)
    ratios = np.array(zn1.modal_ratios)
    told = fit_bare_plate(zn1, measured, ratios, sensor)
    untold = fit_bare_plate(zn1, measured, ratios)
    assert told.young_scale == pytest.approx(1.06, rel=1e-4)
    assert untold.young_scale < 1.055


def test_twist_at_free_edges_is_what_plate_theory_lacks_against_a_solid(zn1):
    """Against the converged solid: the torsional modes 2 and 4 are 0.2 % lower, the bending ones are not."""
    zn1 = replace(zn1, elements=None)
    solid_hz = np.array([17.72, 59.8, 110.1, 201.6, 275.0, 316.0])
    plain = real_modes(Plate(zn1.bare), 0.0, 6).omega / (2 * np.pi)
    np.testing.assert_allclose(frequencies_hz(zn1)[:6], solid_hz, rtol=2e-3)
    softening = edge_softening(Plate(zn1.bare), real_modes(Plate(zn1.bare), 0.0, 6))
    assert softening[[1, 3]] == pytest.approx([2.5e-3, 2.5e-3], abs=2e-4)
    assert np.all(softening[[0, 2, 5]] < 4e-4)
    assert np.all(plain > frequencies_hz(zn1)[:6])


def test_a_long_strip_in_torsion_loses_saint_venants_share(zn1):
    """Torsion of a strip: J = b h^3 / 3 (1 - 0.63 h / b), half of it in the frequency."""
    strip = replace(zn1.bare, length_m=1.0, width_m=0.05, elements=(80, 8))
    modes = real_modes(Plate(strip), 0.0, 8)
    h_over_b = strip.substrate.thickness_m / strip.width_m
    assert edge_softening(Plate(strip), modes).max() == pytest.approx(0.63 * h_over_b / 2, rel=0.03)


def test_a_sensor_on_a_free_plate_takes_its_share_of_every_mode(zn1):
    free = Plate(replace(zn1.bare, boundary="free", elements=(20, 14)))
    modes = real_modes(free, 0.0, 4)
    light, at = 1e-5, (0.02, 0.03)
    loaded = loaded_modes(free, modes, CarriedSensor(light, *at))
    # Rayleigh's quotient, to first order in the mass: the shapes have unit modal mass.
    expected = -0.5 * light * (free.observe(*at) @ modes.shapes) ** 2
    np.testing.assert_allclose(loaded.omega / modes.omega - 1, expected, rtol=1e-2)
