"""The sweep that `viscorig bench` has diagnosed is one of the campaign's: same plate, same noise."""

import numpy as np
import pytest

from campaign.noise import NoiseFigures
from campaign.plant.cases import Truth, measured
from campaign.plant.materials import draw_material
from campaign.schedule import Schedule
from instrument.bench.elastic_root import SPRINGS_N_M3, elastic_root_sweep
from instrument.bench.sweeps import GRID_HZ

SPRINGS = {"clamp_compliance": {"along_x_n_m3": SPRINGS_N_M3, "along_z_n_m3": SPRINGS_N_M3}}
NOISE = NoiseFigures(fraction_of_peak=0.004, repeat_scatter=0.002)
KEPT = ("frequency_hz", "velocity_m_s", "commanded_m_s2", "segment", "sweep", "base_m_s2", "time_s")


@pytest.mark.parametrize("levels_g", [(1.0,), (0.25, 0.5, 1.0)])
def test_the_benchs_sweep_is_what_the_campaign_measures_of_the_same_plate(levels_g):
    found = elastic_root_sweep(9.81, levels_g, seed=3)
    level = np.repeat(levels_g, len(GRID_HZ))
    schedule = Schedule(found.frequency_hz, found.segment, found.sweep, level, found.time_s)
    rng = np.random.default_rng(3)
    meant = measured(Truth(SPRINGS, draw_material(rng), NOISE), schedule, 9.81, rng)
    for name in KEPT:
        np.testing.assert_allclose(getattr(found, name), getattr(meant, name), rtol=1e-12, err_msg=name)
