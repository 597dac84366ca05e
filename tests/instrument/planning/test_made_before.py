"""Which measurements are those that were made already."""

import pytest

from instrument.planning.made_before import made_before


@pytest.fixture(scope="module")
def every(template):
    return list(template.measurable(5e-3))


def done(one):
    return one.follow_up(3.0, 0.5, ("gain_error", "spot_offset"))


def test_each_is_made_before_once_it_is_done_and_nothing_is_before(every):
    assert {one.kind for one in every} >= {"frequencies", "level", "added_mass", "clamping", "spot"}
    assert all(made_before(one, [done(one)]) for one in every)
    assert not any(made_before(one, []) for one in every)


def test_other_kinds_places_levels_and_segments_are_other_measurements(every):
    for one in every:
        after = [other for other in every if made_before(other, [done(one)])]
        assert {other.kind for other in after} == {one.kind}
        assert {other.spot_m for other in after} == {one.spot_m}
        assert {other.level_g for other in after} == {one.level_g}
        assert all(set(other.segments) <= set(one.segments) for other in after)
        masses = {tuple(other.mass.values) for other in after if other.mass is not None}
        assert len(masses) == (one.mass is not None)


def test_more_steps_are_another_measurement_of_the_rig_alone_and_not_of_what_was_prepared(every):
    for kind, same in (("frequencies", False), ("level", False), ("added_mass", True)):
        short, long = [one for one in every if one.kind == kind and "20 steps" in one.todo][:1] + [
            one for one in every if one.kind == kind and "40 steps" in one.todo
        ][:1]
        assert set(short.segments) == set(long.segments)
        assert made_before(short, [done(long)])
        assert made_before(long, [done(short)]) is same
