"""A sweep and one of its steps, followed event by event."""

from types import SimpleNamespace

import numpy as np
import pytest
from sessions import block, configuration, point

from gui.state.plan import Plan
from gui.state.step import Step
from instrument.stream.raw import AcquisitionBegan, Held, RangeSet, SegmentBegan, SegmentEnded, StepBegan

RATE_HZ = 8192.0


def test_a_segment_goes_from_stated_to_begun_to_done():
    plan = Plan(configuration().experiment.sweep)
    assert (plan.segments, plan.regions) == (1, ((1, 15.0, 25.0),))
    assert plan.fraction((1, 1)) == 0.0
    plan.take(SegmentBegan(1, 1, 16.0, 24.0, 4))
    assert plan.regions == ((1, 16.0, 24.0),)
    for step, purpose in enumerate(("step", "sentinel", "step"), start=1):
        plan.take(point(step, purpose=purpose))
    assert plan.fraction((1, 1)) == 0.5
    plan.take(SegmentEnded(1, 1))
    assert plan.fraction((1, 1)) == 1.0


def test_the_calibration_is_no_segment_of_the_sweep():
    plan = Plan(None, foreseen=((2, 90.0, 100.0),))
    plan.take(SegmentBegan(1, 0, 1.0, 2.0, 3))
    assert plan.regions == ((2, 90.0, 100.0),)


class Units:
    """Volts as they come; velocity by the vibrometer's range."""

    def motion(self, volts, scale_m_s_v):
        return volts * np.array([[1.0], [scale_m_s_v]])


@pytest.fixture
def step():
    began = StepBegan(1, "step", 1, 1, 2048.0, 9.81, 0.1, 0.1)
    return Step(began, AcquisitionBegan(1, "sweep", RATE_HZ, ("base", "velocity")), Units())


def test_a_step_keeps_each_block_in_the_range_it_was_heard_in(step):
    for first, scale in ((0, 0.5), (8, 2.0)):
        step.take(block(first), SimpleNamespace(scale_m_s_v=scale))
    trace = step.trace()
    np.testing.assert_allclose(trace.velocity_m_s / trace.base_m_s2, [0.5] * 8 + [2.0] * 8)
    np.testing.assert_allclose(trace.time_s, np.arange(16) / RATE_HZ)
    assert len(step.trace(4 / RATE_HZ).time_s) == 8
    assert [first for first, _ in step.since(8)] == [8]


def test_a_measured_step_hears_no_more(step):
    step.take(block(0), None)
    step.take(point(1), None)
    assert step.over
    step.take(block(8), None)
    assert step.samples == 8


def test_a_step_that_a_hold_broke_off_is_past(step):
    step.take(block(0), None)
    assert not step.broken_off
    step.take(Held(), None)
    assert step.broken_off
    # A hold after the point took nothing from it.
    step.take(point(1), None)
    assert not step.broken_off


def test_the_last_change_is_known_with_its_sample(step):
    step.take(block(0), None)
    change = RangeSet("a", 0.1, 10.0, 2e4, None)
    step.take(change, None)
    assert step.last_change == (change, 8)
