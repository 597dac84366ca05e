"""What a plan would see of effects, on signatures drawn by hand."""

import numpy as np
import pytest
from planning_cases import sensitivity

from fitting.effects import CATALOGUE
from fitting.effects.channel_delay import ChannelDelayEffect
from fitting.effects.core_thickness import CoreThicknessEffect
from fitting.effects.gain_error import GainErrorEffect
from fitting.planning.causes import Causes
from fitting.planning.confusion import SEEN, outlooks, projected
from fitting.planning.signatures import Signature


def signature(effect, moves):
    start = np.array([q.typical for q in effect.parameters])
    return Signature(effect, (start,), np.atleast_2d(np.asarray(moves, complex)))


S = sensitivity([10.0, 10.0, 10.0, 10.0])
ALL = np.ones(4)
ALONG_LAW = [1, 1, 1, 1]
FIRST, SECOND = [1, -1, 0, 0], [0, 0, 1, -1]


def test_what_the_law_imitates_is_not_seen():
    seen = outlooks(S, ALL, [signature(CoreThicknessEffect(), ALONG_LAW)])[0]
    # Of four unit moves in one direction only the law's wide prior keeps a trace.
    assert np.linalg.norm(projected(S, ALL, signature(CoreThicknessEffect(), ALONG_LAW))) < 1e-2
    assert abs(seen.seen_at - 1) > 10
    assert seen.chance_seen < 0.05


@pytest.mark.parametrize("name", ["tether", "amplitude_softening", "sensor_mounting"])
def test_what_only_says_how_is_no_size(name):
    """A loss factor at which a strong tether stays as it was would be seen at every strength alike."""
    for effect in CATALOGUE[name].variants():
        one = signature(effect, FIRST)
        sizes = [one.size(0, strength) for strength in (1.0, 5.0)]
        assert sizes[0] != sizes[1]
        assert not effect.parameters[one.sized(0)].shape


def test_an_effect_is_seen_from_four_standard_deviations():
    found = outlooks(S, ALL, [signature(CoreThicknessEffect(), np.array(FIRST) * 2)])[0]
    left = 2 * np.sqrt(2)
    typical = CoreThicknessEffect.parameters[0].typical
    assert found.seen_at == pytest.approx(1 + (typical - 1) * SEEN / left, rel=1e-6)


def test_same_signatures_are_mistaken_for_each_other_and_never_told_apart():
    found = outlooks(
        S, ALL, [signature(CoreThicknessEffect(), FIRST), signature(GainErrorEffect(), 3 * np.array(FIRST))]
    )
    assert len(found) == 2
    assert all(len(o.rivals) == 1 for o in found)
    assert all(o.rivals[0].times > 1e6 for o in found)


def test_signatures_of_different_shape_are_not_mistaken():
    found = outlooks(S, ALL, [signature(CoreThicknessEffect(), FIRST), signature(GainErrorEffect(), SECOND)])
    assert len(found) == 2
    assert all(o.rivals == () for o in found)


def test_readings_that_are_not_planned_say_nothing():
    taken = np.array([1, 1, 0, 0])
    found = outlooks(S, taken, [signature(GainErrorEffect(), SECOND)])[0]
    assert found.chance_seen < 0.05


def test_causes_take_the_step_that_shows_them():
    chosen = Causes(S, [signature(ChannelDelayEffect(), [0, 0, 0, 5])]).choose(np.ones(4), np.zeros(4), 1.0)
    assert chosen.tolist() == [3]


def test_causes_take_what_separates_rivals_rather_than_what_shows_both():
    # Both show at the first two points alike, at the third with different sign.
    one, other = signature(ChannelDelayEffect(), [9, -9, 4, 0]), signature(GainErrorEffect(), [9, -9, -4, 0])
    s = sensitivity([1.0, 1.0, 1.0, 1.0])
    taken = np.array([1, 1, 0, 0])
    assert Causes(s, [one, other]).choose(np.ones(4), taken, 1.0).tolist() == [2]


def test_causes_keep_their_time():
    g = signature(ChannelDelayEffect(), [5, 4, 3, 2])
    assert len(Causes(S, [g]).choose(np.full(4, 2.0), np.zeros(4), 5.0)) == 2
