"""What is said of data and specimen as they were given."""

from dataclasses import replace

import numpy as np
import pytest
from data_folder import DATA

from fitting.data.noise import noise_of, scatter_over_stated
from fitting.stated.patches import Patch
from fitting.stated.tolerances import STATED
from fitting.sweep import Sweep
from instrument.files.sweep_file import read_sweep
from instrument.remarks.as_given import remarks_on_noise, remarks_on_patches, remarks_on_tolerances
from instrument.remarks.tolerance_words import asked, tolerance_rows, tolerances_used


def practice(times=None):
    """With a stated noise of so many times its local scatter."""
    sweep = read_sweep(DATA / "practice-002.csv").sweep(9.81)
    if times is None:
        return sweep
    over = np.abs(sweep.base_m_s2) / sweep.commanded_m_s2
    return replace(sweep, std_m_s=times * noise_of(sweep).std_m_s * over)


def test_without_a_stated_noise_there_is_nothing_to_compare():
    assert scatter_over_stated(practice()) is None
    assert remarks_on_noise(practice()) == ()


def test_few_points_do_not_scatter():
    sweep = practice(1.0)
    assert scatter_over_stated(sweep.take(np.arange(0, len(sweep), 30))) is None


@pytest.mark.parametrize(("times", "said"), [(1.0, ""), (1.3, ""), (0.5, "too small"), (2.0, "too large")])
def test_a_stated_noise_beside_the_scatter(times, said):
    found = remarks_on_noise(practice(times))
    # Of a seventh of the points, or of all: the nearer to one.
    assert scatter_over_stated(practice(times)) == pytest.approx(1 / times, rel=0.2)
    assert (said in found[0]) if said else not found


def struck(loss, step_hz, times, seed):
    """The mobility of sixteen sharp resonances, its noise stated so many times too large."""
    rng = np.random.default_rng(seed)
    f = np.arange(50.0, 1250.0, step_hz)
    at, size = np.sort(rng.uniform(60, 1300, 16)), rng.normal(size=16)
    v = (1j * f[:, None] * size / (at**2 * (1 + 1j * loss) - f[:, None] ** 2)).sum(axis=1)
    std = np.hypot(3e-4 * np.abs(v).max(), 3e-3 * np.abs(v))
    v = v + std * (rng.standard_normal((len(f), 2)) @ np.array([1, 1j]))
    ones = np.ones(len(f))
    return Sweep(f, v, ones, ones.astype(int), ones.astype(int), std_m_s=times * std)


@pytest.mark.parametrize(
    ("loss", "step_hz"), [(0.005, 1.0), (0.005, 2.0), (0.02, 2.0), (0.02, 4.0), (0.05, 4.0)]
)
def test_sharp_resonances_on_coarse_lines_are_not_noise(loss, step_hz):
    """What the smoothed scatter says alone is several times the noise."""
    assert all(not remarks_on_noise(struck(loss, step_hz, 1.0, seed)) for seed in range(4))
    assert all("too small" in remarks_on_noise(struck(loss, step_hz, 1 / 3, seed))[0] for seed in range(4))


@pytest.mark.parametrize(("times", "said"), [(1.0, ""), (0.5, "too small"), (2.0, "too large")])
def test_a_recorded_sessions_noise_is_that_of_its_dwells(times, said):
    """Nobody stated it: there is no column to correct or to leave out."""
    sweep = replace(practice(times), std_of_dwells=True)
    found = remarks_on_noise(sweep.take(np.arange(len(sweep))))
    assert bool(found) == bool(said)
    assert all(said in text and "within each dwell" in text for text in found)
    assert all("velocity_std_m_s" not in text and "column" not in text for text in found)


def test_tolerances_not_named_are_typical(zn1):
    plain = replace(zn1, exact=False, tolerances={})
    (said,) = remarks_on_tolerances(plain)
    assert said == "tolerances not named: typical values of a careful laboratory (docs/specimen.md)"
    some = replace(plain, tolerances={"core_thickness": 0.01})
    assert remarks_on_tolerances(some)[0].startswith("17 of 18 tolerances not named")
    # Where the force acts is a stated number only of what a force drives.
    struck = replace(some, force_m=(0.25, 0.15))
    assert remarks_on_tolerances(struck)[0].startswith("18 of 19 tolerances not named")
    assert remarks_on_tolerances(replace(plain, tolerances=dict.fromkeys(STATED, 0.01))) == ()
    assert remarks_on_tolerances(zn1) == ()


def test_no_data_tell_a_patch_cut_shorter_from_a_softer_core(zn1):
    patched = replace(zn1, exact=False, patches=(Patch(0.0, 0.1, 0.05, 0.1),))
    (said,) = remarks_on_patches(patched)
    assert "say how well by cut_mm (0.5 stands in)" in said
    assert remarks_on_patches(replace(patched, exact=True)) == remarks_on_patches(zn1) == ()
    assert remarks_on_patches(replace(patched, tolerances={"cut": 1e-3})) == ()
    # What ends at the plate's edges is as long as its other end is laid.
    assert remarks_on_patches(replace(patched, patches=(Patch(0.0, 0.1, 0.0, 0.1),))) == ()


def test_tolerances_are_listed_with_their_values_and_where_they_come_from(zn1):
    specimen = replace(zn1, exact=False, tolerances={"core_thickness": 0.01, "pickup": 1e-3})
    rows = dict(tolerance_rows(specimen))
    assert rows["core thickness"] == "1 %"
    assert rows["pickup"] == "1 mm"
    assert rows["delay"] == "2 µs (typical)"
    used = {one.name: (one.value, one.source) for one in tolerances_used(specimen)}
    assert used["core_thickness_percent"] == (pytest.approx(1.0), "named")
    assert used["delay_us"] == (pytest.approx(2.0), "typical")
    assert tolerance_rows(zn1) == [("all stated numbers", "exact")]
    assert not any(name.startswith(("core", "constraining")) for name in asked(specimen.bare))
