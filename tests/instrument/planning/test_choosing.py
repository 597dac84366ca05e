"""What an adaptive sweep chooses, on the coarse plate read by its own model with a little noise."""

from dataclasses import replace

import numpy as np
import pytest
from sessions import point

from fitting.planning.sensitivity import ReadingNoise
from instrument.planning.choosing import Goal, choose_steps
from instrument.planning.grid import Ground
from instrument.stepped_sine.settings import SweepSettings
from instrument.stream.event import from_line, to_line
from instrument.stream.raw import ChoiceStarted

BAND, LEVEL = (15.0, 120.0), 9.81
NOISE = ReadingNoise(5e-6, 2e-3)


@pytest.fixture(scope="module")
def ground(coarse):
    """Tolerances a tenth of a careful laboratory's: 2 % is within reach."""
    names = ("core_thickness", "constraining_thickness", "substrate_young", "constraining_young", "gain")
    specimen = replace(coarse, exact=False, tolerances=dict.fromkeys(names, 1e-3))
    return Ground.of(specimen, SweepSettings(), BAND, LEVEL)


def measured(ground, chosen, first_step=1, law=None):
    """Points at chosen frequencies."""
    order = np.argsort(chosen.frequencies_hz)
    f = np.array(chosen.frequencies_hz)[order]
    model = ground.reduced
    omega = 2 * np.pi * f
    v = 1j * omega * model.displacement(omega, (law or ground.law).modulus(omega)) * LEVEL
    v = v + (1 / (1j * omega) * LEVEL if ground.specimen.reads == "absolute" else 0.0)
    std = NOISE.std_m_s(v, np.full(len(f), 0.5))
    rng = np.random.default_rng([first_step, len(f)])
    v = v + std * (rng.standard_normal((len(f), 2)) @ np.array([1, 1j]))
    return [
        point(
            first_step + k,
            float(f[k]),
            segment=chosen.segments[int(order[k])],
            base_accel_re_m_s2=LEVEL,
            base_accel_im_m_s2=0.0,
            base_accel_std_m_s2=1e-9,
            velocity_re_m_s=float(v[k].real),
            velocity_im_m_s=float(v[k].imag),
            velocity_std_m_s=float(std[k]),
        )
        for k in range(len(f))
    ]


@pytest.fixture(scope="module")
def begun(ground):
    """The first pass, and the choice after it."""
    goal = Goal(0.02, 0.25, 1800.0)
    first = choose_steps(ChoiceStarted(1, 0, None), [], None, ground, goal)
    points = measured(ground, first)
    last = points[-1].step
    return goal, first, points, choose_steps(ChoiceStarted(2, last, None), points, first, ground, goal)


def test_the_first_pass_has_both_ends_and_three_steps_a_resonance(begun, ground):
    _, first, _, _ = begun
    assert first.frequencies_hz[0] == BAND[0]
    assert first.frequencies_hz[-1] == BAND[1]
    assert len(first.frequencies_hz) == 2 + 3 * len(ground.centres_hz)
    assert first.teaches == "coarse"


def test_a_step_is_chosen_with_its_reason_and_what_is_known(begun):
    _, _, _, second = begun
    assert not second.ended
    assert len(second.frequencies_hz) == 1
    assert second.why
    assert 0 < second.limit_percent <= second.worst_percent


def test_the_same_points_give_the_same_choice_to_the_bit_from_models_made_anew(begun, ground):
    goal, first, points, second = begun
    anew = Ground.of(replace(ground.specimen), ground.settings, ground.band_hz, ground.level_m_s2)
    again = choose_steps(ChoiceStarted(2, points[-1].step, None), points, first, anew, goal)
    assert to_line(again) == to_line(second)


def test_a_choice_comes_back_from_a_line_to_the_bit_and_carries_on_alike(begun, ground):
    goal, _, points, second = begun
    read = from_line(to_line(second))
    assert to_line(read) == to_line(second)
    started = ChoiceStarted(3, points[-1].step, second.frequencies_hz[0])
    third = choose_steps(started, points, second, ground, goal)
    assert to_line(choose_steps(started, points, read, ground, goal)) == to_line(third)
    assert third.frequencies_hz != second.frequencies_hz


def test_what_is_being_measured_counts(begun, ground):
    goal, _, points, second = begun
    pending = ChoiceStarted(3, points[-1].step, second.frequencies_hz[0])
    third = choose_steps(pending, points, second, ground, goal)
    assert third.worst_percent < second.worst_percent


def test_points_after_the_one_named_play_no_part(begun, ground):
    goal, first, points, second = begun
    more = [*points, replace(points[0], step=99, frequency_hz=33.0, velocity_re_m_s=1.0)]
    again = choose_steps(ChoiceStarted(2, points[-1].step, None), more, first, ground, goal)
    assert to_line(again) == to_line(second)


def test_it_ends_where_the_target_is_met_and_every_region_has_enough(begun, ground):
    _, first, points, _ = begun
    easy, known, before, number = Goal(0.5, 0.0, 1800.0), list(points), first, 1
    while number < 20:
        number += 1
        before = choose_steps(ChoiceStarted(number, known[-1].step, None), known, before, ground, easy)
        if before.ended:
            break
        assert "too few steps" in before.why
        known += measured(ground, before, known[-1].step + 1)
    assert before.ended
    assert "target is met" in before.why
    for region in {p.segment for p in known}:
        assert sum(p.segment == region for p in known) >= 5


def test_a_time_budget_ends_it(begun, ground):
    _, first, points, _ = begun
    spent = sum(p.dwell_s + p.settle_s for p in points)
    found = choose_steps(
        ChoiceStarted(2, points[-1].step, None), points, first, ground, Goal(1e-3, 0.25, spent + 0.1)
    )
    assert found.ended
    assert "used up" in found.why


def test_a_law_far_from_the_stated_one_is_found_and_candidates_move_with_it(begun, ground):
    goal, first, _, _ = begun
    stiff = ground.law.with_logs(
        np.log(ground.law.values) + np.log([1.5, 1.5, *[1.0] * (len(ground.law.names) - 2)])
    )
    points = measured(ground, first, law=stiff)
    found = choose_steps(ChoiceStarted(2, points[-1].step, None), points, first, ground, goal)
    law = ground.law.with_logs(np.array(found.law))
    omega = 2 * np.pi * np.array([20.0, 100.0])
    ratio = np.abs(law.modulus(omega) / stiff.modulus(omega))
    np.testing.assert_allclose(ratio, 1, atol=0.08)
    assert found.grid_law == pytest.approx(found.law, abs=0.5)


def test_a_misfit_is_said_and_widens_what_is_stated(begun, ground):
    goal, first, points, second = begun
    # One end reads 20 % too much: no law does that.
    wrong = [
        replace(p, velocity_re_m_s=1.2 * p.velocity_re_m_s) if k == 4 else p for k, p in enumerate(points)
    ]
    found = choose_steps(ChoiceStarted(2, points[-1].step, None), wrong, first, ground, goal)
    assert "errors are widened" in found.why
    assert found.worst_percent > second.worst_percent


def test_a_step_declined_is_not_chosen_again(begun, ground):
    goal, first, points, second = begun
    (f,) = second.frequencies_hz
    again = choose_steps(ChoiceStarted(2, points[-1].step, None, (f,)), points, first, ground, goal)
    assert again.frequencies_hz != (f,)


def test_a_step_of_a_persons_own_counts_where_it_lies(begun, ground):
    goal, _, points, second = begun
    own = replace(second, frequencies_hz=(50.123,), segments=(int(ground.region(np.array([50.123]))[0]),))
    known = [*points, *measured(ground, own, points[-1].step + 1)]
    found = choose_steps(ChoiceStarted(3, known[-1].step, None), known, second, ground, goal)
    assert 50.123 in found.grid_hz
    assert "scatter" not in found.why
    assert found.worst_percent < second.worst_percent
