"""Unit, part and size of a sine, as a name says them."""

import pytest

from instrument.files.units import unit_of
from instrument.interchange.unit_in_name import amplitude_factor, bracketed, part_in, stem_of, unit_in


@pytest.mark.parametrize(
    ("name", "unit"),
    [
        ("Base accel real(g)", "g"),
        ("FRF (m/s)/(m/s^2)", "(m/s)/(m/s^2)"),
        ("FRF ((m/s)/g)", "(m/s)/g"),
        ("Velocity (re clamp) (mm/s)", "mm/s"),
        ("Velocity [m/s rms]", "m/s"),
        ("velocity_mm_s", "mm/s"),
        ("H1 [s]", "s"),
        ("FRF_m_s_per_m_s2", "(m/s)/(m/s^2)"),
        ("frf_re_m_s2_per_n", "(m/s^2)/N"),
        ("Mobility Magnitude in mm/s/N", "(mm/s)/N"),
        ("Velocity/Acceleration Real in m/s/(m/s^2)", "(m/s)/(m/s^2)"),
        ("Acceleration/Force real in g/N", "g/N"),
        ("Velocity in in/s", "in/s"),
        ("Accelerance (g per N) real", "g/N"),
        ("inertance_g_N_real", "g/N"),
        ("inertance_g_per_N", "g/N"),
        ("inertance_mm_s2_N", "(mm/s^2)/N"),
        ("mobility_mm_s_N real", "(mm/s)/N"),
        ("mobility_re_mm_s_per_n", "(mm/s)/N"),
        ("mobility_kn", "furlong"),
        ("receptance_um_N", "um/N"),
        ("mobility_re", "(m/s)/N"),
        ("Mobility tip x real", "(m/s)/N"),
        ("T real", "(m/s^2)/(m/s^2)"),
        ("T [-]", "(m/s^2)/(m/s^2)"),
        ("T", "furlong"),
        ("Transmissibility", "(m/s^2)/(m/s^2)"),
        ("Transmissibility [-]", "(m/s^2)/(m/s^2)"),
        ("Transmissibility [dB]", "(m/s^2)/(m/s^2)"),
        ("Transmissibility [(mm/s)/(mm/s)]", "(mm/s)/(mm/s)"),
        ("Real (m/s)/g", "(m/s)/g"),
        ("Real (m/s) / g", "(m/s)/g"),
        ("Real [m/s]/g", "(m/s)/g"),
        ("(m/s)/g real", "(m/s)/g"),
        ("FRF (m/s)/(m/s^2) real", "(m/s)/(m/s^2)"),
        ("Real g/N", "g/N"),
        ("Velocity mm/s rms", "mm/s"),
        ("Force / N", "N"),
        ("Velocity/Acceleration", "furlong"),
    ],
)
def test_a_unit_is_read_as_it_stands(name, unit):
    assert unit_in(name) == unit_of(unit)


@pytest.mark.parametrize("name", ["Transmissibility [%]", "Transmissibility in %", "T real [%]"])
def test_a_transmissibility_may_be_in_percent(name):
    unit = unit_in(name)
    assert (unit.quantity, unit.per, unit.factor) == ("acceleration", "acceleration", 0.01)


@pytest.mark.parametrize("name", ["Time [s]", "Settling time (s)", "Velocity [furlong/s]", "colour"])
def test_what_is_no_unit_of_a_signal_is_none(name):
    assert unit_in(name) is None


def test_parts_of_one_quantity_have_one_stem():
    assert stem_of("Velocity real [mm/s]") == stem_of("Velocity imag [mm/s]") == ("velocity",)
    assert (part_in("v_phase_rad"), part_in("base_im_g"), part_in("tip (m/s)")) == ("phase", "im", "whole")
    assert bracketed("Base accel [g]") == ("g", ["base", "accel"])


@pytest.mark.parametrize(
    ("name", "unit"), [("v real [mm / s]", "mm/s"), ("H [m/s / g]", "(m/s)/g"), ("H [m·s⁻¹/N]", "(m/s)/N")]
)
def test_blanks_and_powers_belong_to_the_unit(name, unit):
    assert unit_in(name) == unit_of(unit)


@pytest.mark.parametrize(
    ("name", "factor"),
    [
        ("Schnelle Effektivwert [mm/s]", 2**0.5),
        ("Velocity root mean square [mm/s]", 2**0.5),
        ("Schnelle Spitze-Spitze [mm/s]", 0.5),
        ("Vitesse crête à crête (mm/s)", 0.5),
        ("Schnelle Spitzenwert [mm/s]", 1.0),
    ],
)
def test_a_sines_size_is_read_in_words_too(name, factor):
    assert amplitude_factor(name) == pytest.approx(factor)
