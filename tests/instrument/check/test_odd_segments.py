"""Segments that are there twice, or whose step is wider than they are."""

from instrument.check.odd_segments import odd_segment_remarks
from instrument.files.experiment_file import SegmentSection
from instrument.stepped_sine.plan import PlannedSegment


def said(*sections):
    """`sections`: low, high and step in Hz."""
    made = [SegmentSection(low_hz=low, high_hz=high, step_hz=step) for low, high, step in sections]
    f = [tuple(low + k * (high - low) / 4 for k in range(5)) for low, high, _ in sections]
    planned = [PlannedSegment(k, 1, x, (9.81,) * len(x), "") for k, x in enumerate(f, start=1)]
    return list(odd_segment_remarks(made, planned))


def test_the_same_segment_twice_is_said():
    twice = (15.0, 20.0, 1.25)
    assert said(twice, (80.0, 90.0, 2.5), twice) == [
        "segments 1 and 3 are the same 5 steps: measured twice in every sweep"
    ]


def test_a_step_wider_than_its_segment_is_said():
    assert said((15.0, 20.0, 50.0)) == [
        "segment 1: step_hz = 50 is more than its 15 to 20 Hz: nothing between its ends is measured"
    ]


def test_segments_that_overlap_are_meant():
    assert said((15.0, 20.0, 1.0), (18.0, 25.0, 7.0)) == []
