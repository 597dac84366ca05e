"""Real records of a rubber in shear, against themselves and against another machine."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from instrument.files.structure_file import read_structure
from instrument.files.sweep_file import read_sweep
from instrument.finding.identification import identify
from instrument.models.files import File

REAL = Path(__file__).parents[3].parent / "shared/data/real/shear"
NOMINAL_C = 21.0
"""Of the real records: their temperature is stated, not measured."""


@pytest.mark.skipif(not REAL.exists(), reason="the real records are not here")
def test_real_records_of_three_masses_follow_one_law():
    given = [_real(name, edges=True, every=5) for name in ("253g", "573g", "1196g")]
    band = identify(given).result.band
    k = int(np.flatnonzero(band.frequency_hz == 100.0)[0])
    for storage_pa, loss_factor in _on_another_machine():
        assert band.storage_modulus_pa[k] == pytest.approx(storage_pa, rel=0.12)
        assert band.loss_factor[k] == pytest.approx(loss_factor, rel=0.12)


def _on_another_machine():
    """G' and loss factor at 100 Hz, 0.15 % and 21 C: of its sweep over temperatures, and over strains.

    The second was run at 22.8 C; what a kelvin does is the first one's.
    """
    columns = {"usecols": (1, 2, 3, 4, 8), "delimiter": ",", "skip_header": 1}
    over_t = np.genfromtxt(REAL / "material_a_dma_tf_015p.csv", **columns)
    over_t = over_t[(over_t[:, 0] == 100.0) & (np.abs(over_t[:, 1] - NOMINAL_C) < 5)]
    over_strain = np.genfromtxt(REAL / "material_a_dma_sd_100hz.csv", **columns)
    at = over_strain[np.abs(over_strain[:, 4] - 0.148).argmin()]
    (t, log_storage, loss), (near, *has) = (
        (one[..., 1].T, np.log(one[..., 2].T), (one[..., 3] / one[..., 2]).T) for one in (over_t, at)
    )

    def at_temperature(celsius):
        return np.exp(np.interp(celsius, t, log_storage)), np.interp(celsius, t, loss)

    here, there = at_temperature(NOMINAL_C), at_temperature(near)
    return here, (np.exp(has[0]) * here[0] / there[0], has[1] + here[1] - there[1])


@pytest.mark.long
@pytest.mark.skipif(not REAL.exists(), reason="the real records are not here")
def test_the_lightest_mass_s_disturbance_is_flagged():
    found = identify([_real(name) for name in ("118g", "253g", "573g", "1196g")])
    (one,) = [one for one in found.aside if one.file == 1 and one.glitch.low_hz < 300]
    assert one.glitch.low_hz < 230
    assert 310 < one.glitch.high_hz < 420


def _real(name, *, edges=False, every=1):
    specimen = replace(read_structure(REAL / f"material_a_{name}.toml"), edges=edges)
    data = read_sweep(REAL / f"material_a_1g_{name}.csv").sweep(specimen.base_acceleration_m_s2)
    return File(data.take(np.arange(len(data)) % every == 0), specimen, name)


@pytest.mark.skipif(not REAL.exists(), reason="the real records are not here")
def test_two_masses_give_the_modulus_without_a_law_or_the_channels():
    """1/T is a straight line in the mass: what both files share falls out of slope over beginning."""
    heavy, middle = (_real(name) for name in ("1196g", "573g"))
    pair = heavy.specimen
    rubber = pair.discs * pair.core.density_kg_m3 * pair.area_m2 * pair.core.thickness_m
    omega = 2 * np.pi * 100.0

    def inverse(file):
        s = file.sweep
        T = s.velocity_m_s * 1j * s.omega / s.base_m_s2
        near = np.abs(np.log(s.frequency_hz / 100.0)) < 0.05
        return 1 / np.polyval(np.polyfit(s.frequency_hz[near] - 100.0, T[near], 2), 0.0)

    masses = np.array([f.specimen.mass_kg + rubber / 3 for f in (middle, heavy)])
    slope, beginning = np.polyfit(masses, [inverse(middle), inverse(heavy)], 1)
    K = -(omega**2) * beginning / slope
    G = K * pair.core.thickness_m / (pair.discs * pair.area_m2) / (1 - pair.softer_by_edges)
    assert G.real == pytest.approx(5.60e6, rel=0.01)
    assert G.imag / G.real == pytest.approx(0.58, rel=0.02)
    # What both share, which one mass by itself takes for the core.
    assert abs(1 / beginning) == pytest.approx(0.972, abs=0.005)
    assert np.degrees(np.angle(1 / beginning)) == pytest.approx(1.3, abs=0.2)
