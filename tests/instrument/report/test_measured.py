"""What a page draws beside the points."""

from dataclasses import replace

import pytest
from diagnosed_session import diagnosed_session
from diagnosis_cases import diagnosis

from instrument.facts.diagnosis import PointLeft
from instrument.report.measured import explained, segments_of
from instrument.session.contents import TimedPoint, contents_of
from instrument.session.storage import SessionFile


def left_by(points, segment=None, **more):
    """A diagnosis of measured points: what it leaves of each is told by pass, level, spot and place."""
    rows = []
    for k, p in enumerate(points):
        left = {"amplitude_percent": 0.0, "re_percent": float(k), "im_percent": -0.5 * k}
        rows.append(
            PointLeft(
                frequency_hz=p.frequency_hz,
                segment=segment or p.segment,
                sweep=p.sweep,
                level_m_s2=p.level_m_s2,
                noise_percent=0.1,
                before=left,
                after=left,
                pickup=p.pickup or None,
            )
        )
    return diagnosis(**more).but(points=tuple(rows))


def predicted(points, number):
    p = points[number]
    return p.velocity_m_s / p.base_m_s2 * (1 + 0.01 * complex(number, -0.5 * number))


@pytest.fixture(scope="module")
def contents(tmp_path_factory):
    with SessionFile(diagnosed_session(tmp_path_factory.mktemp("diagnosed"))) as file:
        return contents_of(file)


def test_the_response_with_what_was_found_is_drawn_beside_the_points(contents):
    points = contents.measured
    measured = segments_of(contents)[0]
    ((at_hz, with_effects),) = explained(measured, left_by(points))
    mine = [k for k, p in enumerate(points) if p.segment == 1 and p.purpose == "step"]
    assert list(at_hz) == list(measured.frequency_hz)
    assert with_effects == pytest.approx([predicted(points, k) for k in mine])
    assert explained(measured, left_by(points, verdict="unknown")) == []
    assert explained(measured, diagnosis(phase=False)) == []
    assert explained(measured, None) == []


@pytest.mark.parametrize(
    "again", [{"sweep": 2}, {"level_m_s2": 9.81}, {"sweep": 2, "pickup": 1, "spot_mm": (250.0, 100.0)}]
)
def test_what_was_found_stays_with_its_pass_level_and_spot(contents, again):
    once = contents.measured
    twice = [*once, *(replace(p, velocity_re_m_s=2 * p.velocity_re_m_s, **again) for p in reversed(once))]
    both = replace(contents, points=[TimedPoint(p, 0.0) for p in twice])
    # Of several files the segments are numbered on.
    found = left_by(twice, segment=7)
    lines = [line for m in segments_of(both) if m.segment == 1 for line in explained(m, found)]
    for begin, (at_hz, with_effects) in zip((0, len(once)), lines, strict=True):
        mine = [k for k in range(begin, begin + len(once)) if twice[k].segment == 1]
        mine = sorted((k for k in mine if twice[k].purpose == "step"), key=lambda k: twice[k].frequency_hz)
        assert list(at_hz) == [twice[k].frequency_hz for k in mine]
        assert with_effects == pytest.approx([predicted(twice, k) for k in mine])


def test_a_sentinel_at_a_steps_frequency_is_not_taken_for_the_step(contents):
    first, *rest = contents.measured
    assert first.purpose == "sentinel"
    step = next(p for p in rest if p.purpose == "step")
    points = [replace(first, frequency_hz=step.frequency_hz), *rest]
    both = replace(contents, points=[TimedPoint(p, 0.0) for p in points])
    ((at_hz, with_effects),) = explained(segments_of(both)[0], left_by(points))
    assert with_effects[list(at_hz).index(step.frequency_hz)] == pytest.approx(
        predicted(points, points.index(step))
    )


def test_what_was_read_elsewhere_has_panels_of_its_own(contents):
    once = contents.measured
    spot = [replace(p, sweep=2, pickup=1, spot_mm=(250.0, 100.0)) for p in once if p.segment == 2]
    mass = [replace(p, sweep=3, mass_kg=0.005, mass_at_mm=(280.0, 100.0)) for p in once if p.segment == 1]
    anew = [replace(p, sweep=4, mounting=1) for p in once if p.segment == 3]
    every = segments_of(replace(contents, points=[TimedPoint(p, 0.0) for p in (*once, *spot, *mass, *anew)]))
    assert [(m.segment, m.elsewhere, len(m.which)) for m in every] == [
        (1, "", 9),
        (1, "5 g at 280, 100 mm", 9),
        (2, "", 9),
        (2, "spot 250, 100 mm", 9),
        (3, "", 9),
        (3, "clamped anew", 9),
    ]
