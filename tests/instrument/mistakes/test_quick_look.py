"""Data beside the stated plate before they are fitted: which one mistake is asked about."""

from dataclasses import replace

import numpy as np
import pytest
import shear_pair_cases
from beam_cases import BEAM

from fitting.gravity import STANDARD_GRAVITY_M_S2 as G
from fitting.structures.small_modes import small_velocity
from fitting.sweep import Sweep
from instrument.files.structure_file import read_structure
from instrument.mistakes import quick_look
from instrument.mistakes.quick_look import data_doubt, remarks_on_reading
from instrument.models.specimen_models import Models

F = np.geomspace(14.0, 70.0, 15)


@pytest.fixture(scope="module", autouse=True)
def _models_are_made_once():
    """Of one plate at the same frequencies."""
    known, made = {}, quick_look.any_core
    with pytest.MonkeyPatch.context() as patch:

        def core(specimen, f, progress):
            key = specimen, f.tobytes()
            if key not in known:
                known[key] = made(specimen, f, progress)
            return known[key]

        patch.setattr(quick_look, "any_core", core)
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
TURNED = "the sign is turned, expected the pickup's and the drive's in one direction"
HOLDS = ": a column's name says what it holds"
MM = "the pickup is read in mm (mm/s, mm/s^2), expected m"
IN_G = "the base acceleration is in g, or level_g in m/s^2"
WRONG = {
    "mm/s": (times(1e3), MM),
    "um/s": (times(1e6), "the pickup is read in um (um/s), expected m"),
    "inches": (times(1 / 0.0254), "the pickup is read in inches, expected m"),
    "too small": (
        times(1e-3),
        "the base acceleration is in mm/s^2, or the pickup's reading 1000 times too small",
    ),
    "base in g": (lambda s: replace(s, base_m_s2=s.base_m_s2 / G), IN_G),
    "mm/s and g": (
        lambda s: replace(s, velocity_m_s=1e3 * s.velocity_m_s, base_m_s2=s.base_m_s2 / G),
        "the pickup is read in mm (mm/s) and the base acceleration in g",
    ),
    "some factor": (
        times(25),
        "the reading is 25 times this specimen's at all frequencies alike: unit, level, gain or the "
        "pickup's place",
    ),
    "rms": (times(0.5**0.5), "the pickup's reading is rms and the base acceleration an amplitude"),
    "peak to peak": (times(2), "the pickup's reading is peak to peak and the base acceleration an amplitude"),
    "displacement": (
        times(1 / OMEGA),
        f"displacement stands for velocity, or velocity for acceleration{HOLDS}",
    ),
    "displacement in mm": (
        times(1e3 / OMEGA),
        f"{MM}, and displacement stands for velocity, or velocity for acceleration{HOLDS}",
    ),
    "acceleration": (
        times(OMEGA),
        f"acceleration stands for velocity, or velocity for the base's acceleration{HOLDS}",
    ),
    "conjugated": (
        lambda s: replace(s, velocity_m_s=s.velocity_m_s.conj(), base_m_s2=s.base_m_s2.conj()),
        "the phase is conjugated, expected e^{+i omega t}",
    ),
    "turned": (times(-1), TURNED),
    "exchanged parts": (
        lambda s: replace(s, velocity_m_s=1j * (s.velocity_m_s * np.exp(-0.1j)).conj()),
        "real and imaginary part of one channel are exchanged",
    ),
    "swapped": (
        lambda s: replace(s, velocity_m_s=s.base_m_s2, base_m_s2=s.velocity_m_s),
        "what the pickup reads and what drives are swapped: cables, or columns",
    ),
    "polar": (
        lambda s: replace(
            s, velocity_m_s=np.abs(s.velocity_m_s) + 1j * np.degrees(np.angle(s.velocity_m_s)), base_m_s2=None
        ),
        "amplitude and phase (in degrees) stand for real and imaginary part",
    ),
    "no phase": (
        lambda s: replace(s, velocity_m_s=np.abs(s.velocity_m_s) + 0j, base_m_s2=None),
        "real and imaginary parts have no phase, expected velocity_m_s where amplitudes alone are known",
    ),
    "power": (
        lambda s: replace(s, velocity_m_s=np.abs(s.velocity_m_s) ** 2, base_m_s2=None),
        "the response is a power (a square), expected an amplitude",
    ),
    "dB": (
        lambda s: replace(s, velocity_m_s=20 * np.log10(np.abs(s.velocity_m_s) / 1e-9), base_m_s2=None),
        "the response is in dB, expected an amplitude",
    ),
}


@pytest.mark.parametrize("what", WRONG)
def test_the_one_mistake_that_explains_the_data_is_asked_about(plate, right, what):
    spoilt, said = WRONG[what]
    assert data_doubt(spoilt(right), plate) == f"it looks as if {said}"


def test_data_of_the_plate_are_not_asked_about_whatever_its_core(plate, right):
    assert plate.reads == "relative"
    assert data_doubt(right, plate) == ""


def test_that_a_laser_reads_more_than_is_stated_is_left_to_a_diagnosis_and_less_is_asked_about(plate, right):
    absolute = replace(right, velocity_m_s=right.velocity_m_s + right.base_m_s2 / OMEGA)
    assert data_doubt(absolute, plate) == ""
    said = data_doubt(right, replace(plate, reads="absolute"))
    assert said == (
        "it looks as if the pickup's reading is relative to the clamp: [pickup] reads says absolute"
    )


def test_a_law_that_does_not_follow_readings_of_absolute_velocities_says_so(plate, right):
    absolute = replace(right, velocity_m_s=right.velocity_m_s + right.base_m_s2 / OMEGA)
    (said,) = remarks_on_reading(absolute, plate, 100.0)
    assert "[pickup] reads = 'absolute' is missing" in said
    # A fit that follows has nothing to say of it, nor one of something else.
    assert remarks_on_reading(absolute, plate, 3.0) == ()
    assert remarks_on_reading(times(3.0)(right), plate, 100.0) == ()
    assert remarks_on_reading(absolute, replace(plate, reads="absolute"), 100.0) == ()


def test_spots_that_are_exchanged_are_named(plate, right):
    other = plate.length_m / 2, plate.width_m / 4
    two = replace(plate, further_pickups_m=(other,))
    law = plate.core.law
    stiffer = law.with_values(law.values * np.array([1.5, 1.5, 1.0, 1.0]))
    there = Models.of(two.at_pickup(1), F).predict(stiffer, F) * np.exp(0.1j)
    n = len(F)
    both = right.take(np.tile(np.arange(n), 2))
    each = np.repeat([0, 1], n)
    given = replace(both, velocity_m_s=np.concatenate([right.velocity_m_s, there]), pickup=each)
    assert data_doubt(given, two) == ""
    said = data_doubt(replace(given, pickup=1 - each), two)
    assert said == ("it looks as if spots 0 and 1 are exchanged: what stands as pickup 0 is read at 1")


def test_amplitudes_have_no_sign_to_be_wrong(plate, right):
    amplitudes = replace(right, velocity_m_s=np.abs(right.velocity_m_s), base_m_s2=None)
    assert data_doubt(amplitudes, plate) == ""
    assert "mm/s" in data_doubt(times(1e3)(amplitudes), plate)


def test_frequencies_in_kilohertz_are_asked_about_before_anything_is_modelled(right):
    said = data_doubt(replace(right, frequency_hz=F / 1e3), None)
    assert said == "0.014 to 0.07 Hz: the frequencies are in kHz, expected Hz"


def test_frequencies_in_kilohertz_that_reach_beyond_one_are_asked_about(tmp_path):
    (tmp_path / "beam.toml").write_text(BEAM)
    specimen = read_structure(tmp_path / "beam.toml")
    f = np.linspace(250.0, 1300.0, 40)
    level, one = np.full(len(f), specimen.base_acceleration_m_s2), np.ones(len(f), dtype=np.intp)
    right = Sweep(f, small_velocity(specimen, f), level, one, one, base_m_s2=level.astype(complex))
    assert data_doubt(right, specimen) == ""
    said = data_doubt(replace(right, frequency_hz=f / 1e3), specimen)
    assert said == "it looks as if the frequencies are in kHz, expected Hz"


def test_frequencies_in_radians_a_second_are_asked_about(plate, right):
    said = data_doubt(replace(right, frequency_hz=2 * np.pi * F), plate)
    assert said == "it looks as if the frequencies are in rad/s, expected Hz"


def amplitudes(right, **changes):
    """Nine of them, as a table in a paper has them."""
    some = right.take(np.linspace(0, len(F) - 1, 9).astype(int))
    return replace(some, velocity_m_s=np.abs(some.velocity_m_s), base_m_s2=None, **changes)


def test_columns_that_are_exchanged_are_told_from_kilohertz(right):
    few = amplitudes(right)
    swapped = replace(few, frequency_hz=few.velocity_m_s, velocity_m_s=few.frequency_hz)
    assert not quick_look._is_ordered(swapped.frequency_hz)
    assert "the columns of frequency and reading are exchanged" in data_doubt(swapped, None)
    in_khz = replace(few, frequency_hz=few.frequency_hz / 1e3)
    assert "the frequencies are in kHz" in data_doubt(in_khz, None)


def test_a_few_amplitudes_in_radians_a_second_are_no_factor(plate, right):
    few = amplitudes(right)
    assert data_doubt(few, plate) == ""
    said = data_doubt(replace(few, frequency_hz=2 * np.pi * few.frequency_hz), plate)
    assert said == "it looks as if the frequencies are in rad/s, expected Hz"


def test_a_few_amplitudes_of_a_plate_that_is_stated_otherwise_are_no_factor(plate, right):
    thick = replace(plate, substrate=replace(plate.substrate, thickness_m=19e-3))
    said = data_doubt(amplitudes(right), thick)
    assert said == "it looks as if substrate.thickness_mm is ten times too large"
    layers = {
        name: replace(getattr(plate, name), thickness_m=getattr(plate, name).thickness_m / 25.4)
        for name in ("substrate", "core", "constraining")
    }
    x, y = plate.pickup_m
    sides = {"length_m": plate.length_m / 25.4, "width_m": plate.width_m / 25.4}
    in_inches = replace(plate, **layers, **sides, pickup_m=(x / 25.4, y / 25.4))
    said = data_doubt(amplitudes(right), in_inches)
    assert said == "it looks as if all lengths and thicknesses are in inches, expected mm"


@pytest.mark.parametrize(
    ("spoil", "said"),
    [
        (np.conj, "conjugate"),
        (lambda v: v * 9.81e-6, "unit, level, gain or"),
        (lambda v: v.imag + 1j * v.real, "exchanged"),
    ],
)
def test_a_mistake_is_named_in_data_that_hide_an_effect_too(plate, right, spoil, said):
    # A resonance of something that hangs on it: as far off as effects are.
    r = F / np.median(F)
    hidden = right.velocity_m_s * (1 + 0.15 / (1 - r**2 + 0.3j))
    model = quick_look.any_core(plate, F, quick_look.quiet)
    assert 0.12 < quick_look._as_is(replace(right, velocity_m_s=hidden), model).distance < 0.45
    assert said in data_doubt(replace(right, velocity_m_s=spoil(hidden)), plate)


def test_what_no_core_and_no_mistake_explains_is_another_plate(monkeypatch, plate, right):
    monkeypatch.setattr(quick_look, "_in_another_unit", lambda *_: (float("inf"), ""))
    monkeypatch.setattr(quick_look, "specimen_mistakes", lambda _: ())
    rng = np.random.default_rng(1)
    nonsense = times(np.exp(rng.normal(0, 3, len(F)) + 1j * rng.uniform(0, 6, len(F))))(right)
    said = data_doubt(nonsense, plate)
    assert said.startswith("no core makes this plate answer so (typically ")
    assert said.endswith("another specimen or layer, unit, level, pickup or way it reads")


def test_a_sweep_of_very_many_lines_is_looked_at_in_a_part_of_them(monkeypatch, plate, right):
    seen = []

    def core(specimen, f, progress):
        seen.append(f)
        return known

    known = quick_look.any_core(plate, F, quick_look.quiet)
    monkeypatch.setattr(quick_look, "any_core", core)
    monkeypatch.setattr(quick_look, "_ENOUGH", len(F))
    many = right.take(np.repeat(np.arange(len(F)), 500)[::-1])
    assert data_doubt(many, plate) == ""
    np.testing.assert_allclose(seen, [F])


def test_a_delay_is_left_to_the_diagnosis(plate, right):
    assert data_doubt(times(np.exp(-1e-3 * OMEGA))(right), plate) == ""


def test_a_factor_that_is_no_habit_is_left_to_the_diagnosis(plate, right):
    assert data_doubt(times(1.2)(right), plate) == ""


def test_a_pickup_stated_from_the_free_end_is_said_to_be(plate, right):
    x, y = plate.pickup_m
    said = data_doubt(right, replace(plate, pickup_m=(plate.length_m - x, y)))
    assert said == "it looks as if pickup.x_mm is from the free end, expected from the clamp"


def pair_data():
    pair = shear_pair_cases.pair(0.573)
    return shear_pair_cases.sweep(pair), pair


def test_a_shear_pair_is_looked_at_too():
    sweep, pair = pair_data()
    assert data_doubt(sweep, pair) == ""
    assert data_doubt(times(1e3)(sweep), pair) == f"it looks as if {MM}"
    assert data_doubt(replace(sweep, base_m_s2=sweep.base_m_s2 / G), pair) == f"it looks as if {IN_G}"
    rms = replace(sweep, base_m_s2=sweep.base_m_s2 * 0.5**0.5)
    assert "base acceleration is rms" in data_doubt(rms, pair)
    conjugated = data_doubt(
        replace(sweep, velocity_m_s=(sweep.velocity_m_s * OMEGA_1).conj() / OMEGA_1), pair
    )
    assert "conjugated" in conjugated


OMEGA_1 = 2j * np.pi * pair_data()[0].frequency_hz


@pytest.fixture(scope="module")
def finer(zn1):
    return replace(zn1, elements=(7, 5))


@pytest.fixture(scope="module")
def steep(finer):
    """A few points about three resonances: its core loses much more at the second than at the first."""
    f = np.concatenate([np.geomspace(16, 30, 13), np.geomspace(90, 125, 13), np.geomspace(240, 290, 12)])
    law = finer.core.law
    steeper = law.with_values(law.values * np.array([1.1, 1.1, 1.0, 1.0]))
    v = Models.of(finer, f).predict(steeper, f)
    one = np.ones(len(f), dtype=np.intp)
    return Sweep(f, v, np.full(len(f), finer.base_acceleration_m_s2), one, one)


def test_a_loss_that_rises_steeply_does_not_hide_what_an_amplitude_is(steep, finer):
    assert data_doubt(steep, finer) == ""
    for factor, what in ((0.5**0.5, "rms"), (2.0, "peak to peak")):
        spoilt = replace(steep, velocity_m_s=steep.velocity_m_s * factor)
        said = f"it looks as if the pickup's reading is {what} and the base acceleration an amplitude"
        assert data_doubt(spoilt, finer).startswith(said)


def test_absolute_velocities_at_few_points_are_the_diagnosis_s_to_name(steep, finer):
    base = finer.base_acceleration_m_s2 / (1j * steep.omega)
    absolute = replace(steep, velocity_m_s=steep.velocity_m_s + base)
    assert data_doubt(absolute, finer) == ""
