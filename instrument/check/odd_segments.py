"""Segments that are hardly meant as they stand: one that is there twice, a step wider than its band."""

from collections.abc import Iterator, Sequence
from itertools import combinations

from instrument.files.experiment_file import SegmentSection
from instrument.stepped_sine.plan import PlannedSegment


def odd_segment_remarks(
    sections: Sequence[SegmentSection], planned: Sequence[PlannedSegment]
) -> Iterator[str]:
    """A line for each; `planned` are those of one sweep, in the order of `sections`."""
    for section, segment in zip(sections, planned, strict=True):
        low, high = min(segment.frequencies_hz), max(segment.frequencies_hz)
        if section.step_hz is not None and section.step_hz > high - low:
            yield (
                f"segment {segment.segment}: step_hz = {section.step_hz:g} is more than its {low:g} to "
                f"{high:g} Hz: nothing between its ends is measured"
            )
    for one, other in combinations(planned, 2):
        if set(one.frequencies_hz) == set(other.frequencies_hz):
            yield (
                f"segments {one.segment} and {other.segment} are the same {len(one.frequencies_hz)} steps: "
                "measured twice in every sweep"
            )
