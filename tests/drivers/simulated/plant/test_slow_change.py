"""What moves the core in a run: warming, softening, strips that are loose."""

import numpy as np
import pytest

from drivers.simulated.climate import AMBIENT_C, Climate
from drivers.simulated.plant.effects import AmplitudeSoftening, Effects, PartialDebond, TemperatureDrift
from drivers.simulated.plant.law import MaxwellLaw
from drivers.simulated.plant.slow_change import BAND, LEAST_FACTOR, SlowChange
from drivers.simulated.plant.specimen import LENGTH_M, WIDTH_M
from drivers.simulated.plant.strips import EDGE_STRIP_M, EDGE_STRIPS, debonded

LAW = MaxwellLaw(1e5, (4e5, 9e5), (1e-2, 1e-3))


def test_without_a_cause_the_law_stays():
    change = SlowChange(LAW, Effects())
    assert not change.any
    change.follow(0.07, 100.0)
    assert change.law(1e4) == LAW


def test_a_core_warms_towards_its_end_and_relaxes_sooner():
    change = SlowChange(LAW, Effects(temperature_drift=TemperatureDrift(6.0, 600.0)))
    assert change.kelvin(0.0) == 0.0
    assert change.kelvin(600.0) == pytest.approx(6.0 * (1 - np.exp(-1)))
    warm = change.law(1e5)
    assert warm.g_pa == LAW.g_pa
    # Williams, Landel and Ferry at 6 K above the reference.
    np.testing.assert_allclose(np.divide(warm.tau_s, LAW.tau_s), 10 ** (-9.0 * 6.0 / 126.0))


def test_the_plate_in_a_chamber_is_as_warm_as_the_chamber_makes_it():
    climate = Climate(air_s=10.0, plate_s=10.0)
    change = SlowChange(LAW, Effects(), climate)
    assert change.law(0.0) == LAW
    climate.go_to(0.0, AMBIENT_C + 10.0)
    assert change.kelvin(1e4) == pytest.approx(10.0)
    assert change.moved(LAW, change.law(1e4)) > 0.05


@pytest.mark.parametrize(("strain", "factor"), [(0.07, 0.8), (0.035, 0.9), (10.0, LEAST_FACTOR)])
def test_a_steady_strain_softens_it_so_far_and_no_further(strain, factor):
    change = SlowChange(LAW, Effects(amplitude_softening=AmplitudeSoftening(0.2, 0.07, 1.0)))
    change.follow(strain, 1e3)
    np.testing.assert_allclose(change.law(0.0).modulus(BAND), factor * LAW.modulus(BAND), rtol=1e-9)
    assert change.moved(LAW, change.law(0.0)) == pytest.approx(1 - factor)


def test_the_extremes_enclose_what_comes():
    change = SlowChange(LAW, Effects(temperature_drift=TemperatureDrift(6.0, 600.0)))
    stiffness = [abs(law.modulus(BAND)) for law in change.extremes()]
    for time_s in (0.0, 300.0, 3000.0):
        now = abs(change.law(time_s).modulus(BAND))
        assert (now <= np.max(stiffness, axis=0) * (1 + 1e-12)).all()
        assert (now >= np.min(stiffness, axis=0) * (1 - 1e-3)).all()


def test_a_loose_strip_across_is_counted_by_its_share():
    quarter = LENGTH_M / 4
    loose = debonded(PartialDebond("x", 0.5 * quarter, 2 * quarter), 4)
    np.testing.assert_allclose(loose, [0.5, 1.0, 0.0, 0.0], atol=1e-12)


def test_a_loose_strip_along_the_far_edge_loosens_only_that_edge():
    loose = debonded(PartialDebond("y", WIDTH_M - 1.5 * EDGE_STRIP_M, WIDTH_M), 4)
    np.testing.assert_allclose(loose, [0.0] * EDGE_STRIPS + [0.0, 0.0, 0.0, 0.5, 1.0], atol=1e-9)


@pytest.mark.parametrize(
    "debond", [PartialDebond("y", 0.02, 0.1), PartialDebond("z", 0.0, 0.01)], ids=["the middle", "no axis"]
)
def test_a_strip_that_is_not_kept_apart_is_refused(debond):
    with pytest.raises(ValueError, match="partial_debond along"):
        debonded(debond, 4)
