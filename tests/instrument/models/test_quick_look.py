"""Data beside the stated plate before they are fitted: which one mistake is asked about."""

from dataclasses import replace

import numpy as np
import pytest

from fitting.gravity import STANDARD_GRAVITY_M_S2 as G
from fitting.sweep import Sweep
from instrument.models import quick_look
from instrument.models.quick_look import data_doubt
from instrument.models.specimen_models import Models

F = np.geomspace(14.0, 70.0, 15)


@pytest.fixture(scope="module", autouse=True)
def _models_are_made_once():
    """Of one plate at the same frequencies."""
    known, made = {}, quick_look._sums
    with pytest.MonkeyPatch.context() as patch:

        def sums(specimen, f, progress):
            key = specimen.length_m, f.tobytes()
            if key not in known:
                known[key] = made(specimen, f, progress)
            return known[key]

        patch.setattr(quick_look, "_sums", sums)
        yield


@pytest.fixture(scope="module")
def plate(zn1):
    """On a mesh that is too coarse for anything but a quick look."""
    return replace(zn1, elements=(5, 4))


@pytest.fixture(scope="module")
def right(plate):
    """As its own plate answers, a core stiffer than stated by half; base and velocity as phasors."""
    law = plate.core.law
    stiffer = law.with_values(law.values * np.array([1.5, 1.5, 1.0, 1.0]))
    v = Models.of(plate, F).predict(stiffer, F) * np.exp(0.1j)
    one, level = np.ones(len(F), dtype=np.intp), np.full(len(F), plate.base_acceleration_m_s2)
    return Sweep(F, v, level, one, one, base_m_s2=level * np.exp(0.1j))


def times(factor):
    return lambda s: replace(s, velocity_m_s=s.velocity_m_s * factor)


OMEGA = 2j * np.pi * F
WRONG = {
    "mm/s": (times(1e3), "the velocity is in mm/s, expected m/s"),
    "um/s": (times(1e6), "the velocity is in um/s, expected m/s"),
    "too small": (times(1e-3), "the velocity is 1000 times too small, expected m/s"),
    "base in g": (
        lambda s: replace(s, base_m_s2=s.base_m_s2 / G),
        "the base acceleration is in g, expected m/s^2",
    ),
    "displacement": (times(1 / OMEGA), "displacement stands for velocity, or has to be named so"),
    "acceleration": (times(OMEGA), "acceleration stands for velocity, or has to be named so"),
    "conjugated": (
        lambda s: replace(s, velocity_m_s=s.velocity_m_s.conj(), base_m_s2=s.base_m_s2.conj()),
        "the phase is conjugated, expected e^{+i omega t}",
    ),
    "turned": (times(-1), "the sign is turned, expected velocity and base acceleration in one direction"),
    "swapped": (
        lambda s: replace(s, velocity_m_s=s.base_m_s2, base_m_s2=s.velocity_m_s),
        "velocity and base acceleration are swapped: cables, or columns",
    ),
}


@pytest.mark.parametrize("what", WRONG)
def test_the_one_mistake_that_explains_the_data_is_asked_about(plate, right, what):
    spoilt, said = WRONG[what]
    assert data_doubt(spoilt(right), plate) == f"it looks as if {said}"


def test_data_of_the_plate_are_not_asked_about_whatever_its_core_or_its_laser_reads(plate, right):
    assert data_doubt(right, plate) == ""
    other = "relative" if plate.reads == "absolute" else "absolute"
    assert data_doubt(right, replace(plate, reads=other)) == ""


def test_amplitudes_have_no_sign_to_be_wrong(plate, right):
    amplitudes = replace(right, velocity_m_s=np.abs(right.velocity_m_s), base_m_s2=None)
    assert data_doubt(amplitudes, plate) == ""
    assert "mm/s" in data_doubt(times(1e3)(amplitudes), plate)


def test_frequencies_in_kilohertz_are_asked_about_before_anything_is_modelled(right):
    said = data_doubt(replace(right, frequency_hz=F / 1e3), None)
    assert said == "0.014 to 0.07 Hz: the frequencies are in kHz, expected Hz"


def test_frequencies_in_radians_a_second_are_asked_about(plate, right):
    said = data_doubt(replace(right, frequency_hz=2 * np.pi * F), plate)
    assert said == "it looks as if the frequencies are in rad/s, expected Hz"


def test_what_no_core_and_no_mistake_explains_is_another_plate(monkeypatch, plate, right):
    monkeypatch.setattr(quick_look, "_near_in_rad_s", lambda *_: False)
    rng = np.random.default_rng(1)
    nonsense = times(np.exp(rng.normal(0, 3, len(F)) + 1j * rng.uniform(0, 6, len(F))))(right)
    said = data_doubt(nonsense, plate)
    assert said.startswith("no core makes this plate answer so (typically ")
    assert said.endswith("another plate or layer, unit, level or pickup")


def test_a_sweep_of_very_many_lines_is_looked_at_in_a_part_of_them(monkeypatch, plate, right):
    seen = []

    def sums(specimen, f, progress):
        seen.append(f)
        return known

    known = quick_look._sums(plate, F, quick_look.quiet)
    monkeypatch.setattr(quick_look, "_sums", sums)
    monkeypatch.setattr(quick_look, "_ENOUGH", len(F))
    many = right.take(np.repeat(np.arange(len(F)), 500)[::-1])
    assert data_doubt(many, plate) == ""
    np.testing.assert_allclose(seen, [F])
