"""What is said of hits and modes, without a window."""

from dataclasses import replace
from pathlib import Path

import numpy as np
from hammer_views import BAND_HZ, by_command, only
from hammer_views import hits as hits

from gui.pages.hammer.choice import WhatIf, standing_of
from gui.pages.hammer.findings import Sight, accelerated, modes_of
from gui.pages.hammer.mode_words import mode_rows
from gui.pages.hammer.records_beside import frfs_of_records
from gui.pages.hammer.words import hit_rows
from instrument.facts.damping import DampingResult, ModeFound, RatioFound
from instrument.impact.record import ResponseChannel
from instrument.impact.spectra import spectra


def test_records_of_another_length_are_an_average_of_their_own_and_bad_hits_none(hits):
    one, double, other = (h.record for h in hits)
    short = replace(
        other,
        force_n=other.force_n[:-9],
        responses=tuple(replace(r, samples=r.samples[:-9]) for r in other.responses),
    )
    found = frfs_of_records({Path("a.csv"): [one, short], Path("b.csv"): [double]}, lambda: None)
    assert list(found) == ["a.csv: 1 of 1 hits, set 1", "a.csv: 1 of 1 hits, set 2"]
    lines = [len(frf.frequency_hz) for frf in found.values()]
    assert lines == [len(h.force_n) // 2 + 1 for h in (one, short)]


def test_a_hit_seen_before_is_not_computed_again(hits):
    sight = Sight()
    first = sight.average(hits, lambda: None)
    again = sight.average(only(hits, [1]), lambda: None)
    assert again.seen[3].alone is first.seen[3].alone
    assert not again.seen[3].judged.accepted
    assert len(again.used) == 1


def test_scatter_needs_two_hits(hits):
    one = Sight().average(only(hits, [1]), lambda: None)
    two = Sight().average(hits, lambda: None)
    texts = [
        mode_rows(m.result, m, None)[0].cells[5].text
        for m in (modes_of(a, BAND_HZ, lambda: None) for a in (one, two))
    ]
    assert texts[0] == "–"
    assert float(texts[1].removeprefix("<")) > 0


def test_what_agrees_with_the_record_is_no_what_if(hits):
    what_if = WhatIf()
    what_if.say(hits[0], accepted=False)
    assert what_if.changes(hits[0])
    assert what_if.applied(hits)[0].accepted is False
    what_if.say(hits[0], accepted=True)
    assert not what_if.changes(hits[0])
    assert standing_of(what_if.applied(hits)) == standing_of(hits)


def test_a_hit_whose_samples_are_lost_is_listed_and_not_averaged(hits):
    record = hits[0].record
    channel = replace(record.responses[0], samples=np.zeros(0))
    lost = replace(hits[0], record=replace(record, force_n=np.zeros(0), responses=(channel,)))
    some = (lost, *hits[1:])
    averaged = Sight().average(some, lambda: None)
    assert list(averaged.seen) == [2, 3]
    row = hit_rows(list(some), some, WhatIf(), averaged)[0]
    assert row.cells[2].text == "–"
    assert "samples" in row.cells[4].text


def test_an_error_below_what_limits_a_ratio_takes_little_room():
    ratio = RatioFound(ratio=0.0028, standard_error=1e-9)
    mode = ModeFound(frequency_hz=20.0, damping_ratio=0.0028, rational_fit=ratio)
    (row,) = mode_rows(DampingResult(modes=(mode,)), None, None)
    assert row.cells[2].text == "0.2800 ± <0.0001"


def test_refusals_and_flags_are_said(hits):
    found = by_command(hits, [1, 3])
    mode = found.modes[0].but(half_power=None, why="half power refused: too short; LSCF differs")
    row = mode_rows(found.but(modes=(mode,)), None, None)[0]
    assert row.cells[3].text == "refused"
    assert "half power refused" in row.cells[7].text
    assert row.cells[5].text == "..."


def test_what_a_laser_read_is_drawn_as_an_accelerometer_would_have_it(hits):
    first = hits[0].judged()
    assert accelerated(first) is first
    (read,) = first.hit.responses
    rate = first.hit.sample_rate_hz
    means = (read.samples[1:] + read.samples[:-1]) / 2
    velocity = np.concatenate([[0.0], np.cumsum(means)]) / rate
    swaying = velocity + 0.3 * np.sin(2 * np.pi * 0.7 * np.arange(len(velocity)) / rate)
    laser = ResponseChannel("velocity", "velocity", swaying)
    seen = accelerated(replace(first, hit=replace(first.hit, responses=(laser,))))
    (again,) = seen.hit.responses
    assert again.motion == "acceleration"
    alike = [spectra([one]).frfs[name] for one, name in ((first, read.name), (seen, "velocity"))]
    low = (alike[0].frequency_hz > 30) & (alike[0].frequency_hz < 100)
    largest = np.abs(alike[0].H[low]).max()
    assert np.abs(alike[1].H[low] - alike[0].H[low]).max() < 0.05 * largest
