"""What rivals expect of steps that could be measured: each from its own fit to one sweep."""

from dataclasses import replace
from itertools import groupby

import numpy as np
import pytest
from planning_cases import EVEN, one, read

from fitting.diagnosis.inference.usual_law import polished
from fitting.diagnosis.inference.whitening import SHARE
from fitting.diagnosis.response.sweep_response import SweepResponse
from fitting.effects import CATALOGUE
from fitting.planning.further_readings import FurtherReadings
from fitting.planning.rival_forecasts import RivalForecasts
from fitting.planning.rivalry import outcome
from instrument.planning.costs import dwell_seconds
from instrument.planning.measurable import Template
from instrument.stepped_sine.settings import Limits, SweepSettings


def test_the_same_steps_again_are_expected_to_read_the_same(expecting, template):
    at = np.arange(0, 240, 4)
    dwell = dwell_seconds(expecting.member.sweep.frequency_hz[at], SweepSettings())
    further = FurtherReadings(expecting.member, at, dwell)
    measured, v = expecting.evidence.measured_m_s[at], expecting.learnt[0].fitted.velocity_m_s[at]
    sigma = np.hypot(template.noise.std_m_s(v, dwell), SHARE * np.abs(v))
    forecasts = expecting.forecasts(further, template.noise)
    assert len(forecasts) == len(expecting.names)
    for forecast in forecasts:
        off = np.r_[measured.real, measured.imag] / np.tile(sigma, 2) - forecast.mean
        assert 0.8 < np.sqrt(np.mean(off**2)) < 1.2


def test_another_level_is_expected_in_proportion(expecting, template):
    again, level = one(template, "frequencies"), one(template, "level")
    assert level.level_g == pytest.approx(0.25)
    quiet = replace(template.noise, floor_m_s=0.0)
    a, b = (expecting.forecasts(m.further, quiet)[0] for m in (again, level))
    # With no floor everything goes with the level, its noise too.
    rows = expecting.rows(level.part, len(level.further.at))
    assert b.of(rows).mean == pytest.approx(a.of(rows).mean, rel=1e-9)


def test_steps_between_those_that_were_made_are_expected_to_err_like_them(expecting, template):
    again = one(template, "frequencies")
    f, known = np.array(again.frequencies_hz), expecting.learnt[0].fitted
    made = expecting.member.sweep.frequency_hz
    assert np.abs(f[:, None] / made - 1).min(axis=1).max() > 1e-5
    mean = expecting.forecasts(again.further, template.noise)[0].mean
    v = SweepResponse(again.further.member, known.effects).with_derivatives(known.law, known.u)[0]
    v = v[again.further.at]
    sigma = np.hypot(template.noise.std_m_s(v, again.further.dwell_s), SHARE * np.abs(v))
    # In the segments by what the first sweep showed of its own plate, in the gaps by nothing.
    off = np.abs(mean[: len(f)] - (v.real / sigma)[: len(f)])
    gaps = ~template.plain.known
    assert np.abs(mean[: len(v)][gaps] - (v.real / sigma)[gaps]).max() < 1e-9
    assert off.max() > 0.01


def test_clamped_anew_each_clamp_is_another_one_by_what_mountings_differ(clamps):
    asked = RivalForecasts(clamps, 6)
    assert asked.of == [0, 0, 1]
    assert asked.probabilities.sum() == pytest.approx(1.0)
    template = Template.of(asked, SweepSettings())
    at = np.arange(0, 240, 4)
    dwell = dwell_seconds(asked.member.sweep.frequency_hz[at], SweepSettings())
    anew = replace(one(template, "clamping").further, member=asked.member, at=at, dwell_s=dwell, like=None)
    kept = replace(anew, remounted=False)
    for known, new, same in zip(
        asked.learnt,
        asked.forecasts(anew, template.noise),
        asked.forecasts(kept, template.noise),
        strict=True,
    ):
        (effect,) = known.fitted.effects
        more = new.root @ new.root.T - same.root @ same.root.T
        # Of one number, and by its whole size for a logarithm.
        step = 3e-4 if effect.name == "clamp_line" else 1.0 * known.fitted.of(effect)[0]
        u = known.fitted.u.copy()
        u[[k for k, q in enumerate(anew.member.nuisances.each) if q.kind in anew.new]] = 0.0
        _, dv = SweepResponse(anew.member, known.fitted.effects).with_derivatives(known.fitted.law, u)
        v = asked.velocity_m_s(anew)
        sigma = np.hypot(template.noise.std_m_s(v, anew.dwell_s), SHARE * v)
        column = step * dv[len(known.fitted.law.names) + known.fitted.stated][anew.at] / sigma
        column = np.r_[column.real, column.imag]
        assert more == pytest.approx(np.outer(column, column), rel=1e-6, abs=1e-9 * np.abs(more).max())


@pytest.fixture(scope="module")
def uneven(clamps):
    """A clamp that yields, evenly or not, which nobody can tell from a spot on the axis."""
    problem, evidence = clamps.problem, clamps.evidence
    clamp = clamps.each[1][0]
    start = np.concatenate([clamp.u, [1.0]])
    other = polished(problem, [CATALOGUE["uneven_clamp"]], evidence, clamp.law, start)
    return replace(clamps, each=((clamp, 0.5), (other, 0.5)), temper=1.0)


def test_where_the_plate_twists_a_spot_beside_the_axis_tells_whether_a_clamp_is_uneven(uneven):
    asked = RivalForecasts(uneven, 6)
    template = Template.of(asked, SweepSettings())
    told = []
    for further, each in groupby(template.measurable(None), key=lambda m: m.further):
        # Those with gaps see a twist that lies in one of them.
        some = [m for m in each if m.kind in ("spot", "clamping") and "between" not in m.todo]
        whole = asked.forecasts(further, template.noise) if some else []
        for m in some:
            rows = asked.rows(m.part, len(further.at))
            told.append((m, outcome([f.of(rows) for f in whole], EVEN, of=asked.of).between(0, 1)))
    twist = [between for m, between in told if m.kind == "spot" and "twist" in m.todo]
    same = [between for m, between in told if m.kind == "spot" and "twist" not in m.todo]
    assert min(twist) > 3 * max(same)
    # Clamped anew it is read there too, by itself and with the same segments.
    clamped = [(m, between) for m, between in told if m.kind == "clamping" and "twist" in m.todo]
    assert {m.spot_m for m, _ in clamped} == {m.spot_m for m, _ in told if "twist" in m.todo}
    assert {len(m.frequencies_hz) for m, _ in clamped} == {40, 100, 160}
    assert all(between > 3 * max(same) for _, between in clamped)


def test_no_level_beyond_the_rigs_limits_is_proposed(expecting):
    tight = SweepSettings(limits=Limits(base_m_s2=10.0))
    levels = [
        m.level_g for m in Template.of(expecting, tight).measurable(None, hands=False) if m.kind == "level"
    ]
    assert sorted(set(levels)) == [0.25, 0.5]


def test_between_the_segments_it_is_expected_what_the_fit_reads_there(expecting, template):
    sweep = expecting.member.sweep
    asked = [m for m in template.measurable(None, hands=False) if m.kind == "frequencies"]
    gaps = [m for m in asked if not set(m.segments) & set(sweep.segment)]
    assert [m.segments[0] for m in gaps] == [4, 5]
    for m in gaps:
        f = np.array(m.frequencies_hz)
        assert np.abs(f[:, None] / sweep.frequency_hz - 1).min() > 1e-3
        # The law that was fitted, solved there on the same plate: nothing interpolated.
        known = expecting.learnt[0].fitted
        here = SweepResponse(m.further.member, known.effects).with_derivatives(known.law, known.u)[0]
        here = here[m.further.at[m.part]]
        assert expecting.velocity_m_s(m.further)[m.part] == pytest.approx(np.abs(here), rel=1e-12)
        assert all(np.isfinite(one.mean).all() for one in read(expecting, template, m))


def test_what_the_rig_measures_alone_is_a_gap_or_the_segments_in_two_lengths_with_them_or_without(template):
    asked = [m for m in template.measurable(None, hands=False) if m.kind == "frequencies"]
    gaps = [len(m.segments) for m in asked if not {1, 2, 3} & set(m.segments)]
    assert [len(m.segments) for m in asked] == [60, 120, *gaps, 60 + sum(gaps), 120 + sum(gaps)]
    long, short = asked[1], asked[0]
    assert long.seconds == pytest.approx(2 * short.seconds, rel=0.02)
    assert "40 steps each" in long.todo
