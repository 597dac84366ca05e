"""The treated plate struck: what explanations expect of it, hung free and in its clamp."""

from dataclasses import replace

import numpy as np
import pytest

from fitting.diagnosis.inference.usual_law import polished
from fitting.dynamics.damping import viscous_damping
from fitting.dynamics.direct import displacement_direct
from fitting.effects import CATALOGUE
from fitting.planning.rival_forecasts import RivalForecasts
from fitting.planning.rivalry import outcome
from fitting.planning.sensitivity import ReadingNoise
from fitting.plate.plate import Plate
from instrument.impact.mobility import GAIN
from instrument.planning.damped_struck import damped_struck
from instrument.planning.measurable import Template
from instrument.planning.measurement import HANDS_S
from instrument.stepped_sine.settings import SweepSettings

SETTINGS = SweepSettings()
NOISE = ReadingNoise(1.0, 1.0)
"""Of the sweep's channels, which a blow does not use."""
EVEN = np.array([0.5, 0.5])


def lines(expecting):
    plain = Template.of(expecting, SETTINGS).plain
    return plain.steps.of(next(plain.lengths()).at)


def struck(rivals):
    expecting = RivalForecasts(rivals, 6)
    return expecting, list(damped_struck(expecting, lines(expecting), SETTINGS))


@pytest.fixture(scope="module")
def free(rivals):
    expecting, (one,) = struck(rivals)
    return expecting, one


@pytest.fixture(scope="module")
def rocking(rivals):
    """A gain, or a base that rocks."""
    (gain, _), (offset, _) = rivals.each
    start = np.concatenate([gain.u[: gain.stated], [0.05]])
    rocks = polished(rivals.problem, [CATALOGUE["base_rocking"]], rivals.evidence, offset.law, start)
    return replace(rivals, each=((gain, 0.5), (rocks, 0.5)))


def test_hung_free_it_is_struck_at_one_corner_and_read_at_another(free):
    _, one = free
    offer = one.follow_up(1.0, 0.5, ("gain_error", "spot_offset"))
    assert (offer.kind, offer.held, offer.needs_hands) == ("damped_struck", "free", True)
    assert offer.frequencies_hz == offer.segments == ()
    assert offer.level_g is None
    assert offer.seconds == HANDS_S["damped_struck"]
    assert np.hypot(*np.subtract(offer.struck_mm, offer.spot_mm)) > 250
    assert 'boundary = "free"' in offer.todo
    assert f"gain_percent = {100 * GAIN:g}" in offer.todo


def test_nothing_of_the_first_spot_or_the_first_channel_is_known_there(free):
    expecting, one = free
    gain, offset = expecting.forecasts(one.further, NOISE)
    # The offset was the first spot's; of the gain nobody knows in which channel it is.
    factor = expecting.learnt[0].fitted.u[-1]
    v = expecting.velocity_m_s(one.further)
    told = expecting.forecasts(replace(one.further, other_reference=False), NOISE)[0]
    surely = expecting.velocity_m_s(replace(one.further, other_reference=False))
    assert v / surely == pytest.approx((1 + factor) / 2 / factor, rel=1e-6)
    more = np.trace(gain.root @ gain.root.T) / np.trace(told.root @ told.root.T)
    assert more > 1.0
    assert outcome([gain, offset], EVEN).between(0, 1) < outcome([told, offset], EVEN).between(0, 1)


def test_rivals_that_only_a_clamp_tells_apart_are_not_asked(clamps):
    _, found = struck(clamps)
    assert found == []


@pytest.mark.long
def test_in_its_clamp_it_is_asked_where_a_base_is_suspected_and_reads_nothing_of_it(rocking):
    expecting, found = struck(rocking)
    (one,) = [m for m in found if m.held == "clamped"]
    assert one.spot_m is None
    assert "accelerometer" in one.reason
    known = expecting.learnt[1].fitted
    assert [e.name for e in known.effects] == ["base_rocking"]
    v = np.abs(expecting._raw(expecting.learnt[1], one.further).v)
    # As a full solve has the stated plate, whose numbers this fit has hardly moved; the twist of free edges
    # and the steep sides of resonances allowed for.
    stated = replace(expecting.member.nuisances.specimen, force_m=one.struck_m)
    omega = one.further.member.points.omega
    plate = Plate(stated)
    x = displacement_direct(plate, viscous_damping(plate), omega, known.law.modulus(omega))
    assert np.median(v / np.abs(omega * x)) == pytest.approx(1.0, abs=0.03)
