import numpy as np
import pytest

from fitting.effects.base_rocking import BaseRockingEffect
from fitting.effects.fixture_resonance import FixtureResonanceEffect
from fitting.effects.given import Points

FIXTURE = FixtureResonanceEffect()
OMEGA = 2 * np.pi * np.array([20.0, 90.0, 100.0, 110.0, 300.0])
F0, ZETA = 100.0, 0.02


def swing():
    r = OMEGA / (2 * np.pi * F0)
    return r, 1 / (1 - r**2 + 2j * ZETA * r)


def test_a_reference_before_the_fixture_sees_what_yields_behind_it():
    r, s = swing()
    after, before = (FIXTURE.pitch(OMEGA, np.array([F0, ZETA, 0.05, 0.0, flag])) for flag in (0.0, 1.0))
    assert after == pytest.approx(0.05 * s)
    # r^2 s: at rest nothing, at resonance the same, far above it the whole motion turned round.
    assert before == pytest.approx(0.05 * (s * (1 + 2j * ZETA * r) - 1))


def test_the_root_moves_by_more_than_the_reference_says():
    _, s = swing()
    points = Points(OMEGA, np.ones(5), np.arange(5.0), True, True, "relative")
    read = FIXTURE.reading(np.ones(5, complex), points, np.array([F0, ZETA, 0.0, 0.03, 0.0]))
    assert read == pytest.approx(1 + 0.03 * s)


@pytest.mark.parametrize(
    ("f0", "zeta", "plate", "seen"),
    [
        (100.0, 0.02, 300 + 3j, True),
        # Between the points, beyond the last, on a resonance of the plate.
        (100.0, 0.004, 300 + 3j, False),
        (130.0, 0.02, 300 + 3j, False),
        (100.0, 0.02, 103 + 2j, False),
    ],
)
def test_a_fixture_is_seen_where_points_make_its_peak_apart_from_the_plates(f0, zeta, plate, seen):
    omega = 2 * np.pi * np.linspace(90.0, 110.0, 21)
    points = Points(omega, np.ones(21), np.arange(21.0), True, True, "relative")
    resonances = 2 * np.pi * np.array([plate])
    assert FIXTURE.shows(points, resonances, np.array([f0, zeta, 0.02, 0.0, 1.0])) == seen


def test_far_below_its_resonance_a_fixture_rocks_in_proportion():
    stiff = FIXTURE.pitch(OMEGA, np.array([1e6, ZETA, 0.05, 0.0, 0.0]))
    assert stiff == pytest.approx(BaseRockingEffect().pitch(OMEGA, np.array([0.05])), rel=1e-4)
