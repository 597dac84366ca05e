"""Sweeps in one piece: what they run through, how noisy they are, and the command that draws them."""

import json

import numpy as np
import pytest
from click.testing import CliRunner
from coarse_solid import P2

from campaign.__main__ import campaign
from campaign.plates.answers import Band
from campaign.plates.cases import NONE, draw_case
from campaign.plates.kept import clean_plate
from campaign.plates.noise import draw_noise
from campaign.plates.one_piece import draw_whole, in_one_piece, judged_of, of_one_range
from campaign.plates.schedule import Resonance, known_to_hz, resonances

pytestmark = pytest.mark.usefixtures("coarse_plates")

SIX = [Resonance(20.0 * n**2, 0.1, 1.0 / n) for n in range(1, 7)]


def test_a_case_is_one_segment_through_five_resonances_at_least():
    case = draw_case(NONE, 4, plate="P2", one_piece=True)
    f, own = case.sweep.frequency_hz, resonances(clean_plate(P2), P2.spot_m, case.truth.law)
    assert set(case.sweep.segment) == {1}
    assert sum(f.min() < r.frequency_hz < f.max() for r in own) >= 5
    assert 400 <= len(f) <= 3200
    assert len(case.truth.resonances_hz) == 3
    assert case.truth.resonances_hz[0] == pytest.approx(own[0].frequency_hz)
    again = draw_case(NONE, 4, plate="P2", one_piece=True)
    np.testing.assert_array_equal(case.sweep.velocity_m_s, again.sweep.velocity_m_s)


def test_every_level_has_a_pass_over_the_same_lines_one_after_the_other():
    s = draw_whole(np.random.default_rng(3), SIX, (0.25, 0.5, 1.0))
    for number, level in enumerate((0.25, 0.5, 1.0), 1):
        here = s.sweep == number
        assert set(s.level_g[here]) == {level}
        np.testing.assert_array_equal(s.frequency_hz[here], s.frequency_hz[s.sweep == 1])
    ends = [(s.time_s[s.sweep == n].min(), s.time_s[s.sweep == n].max()) for n in (1, 2, 3)]
    assert ends[0][1] < ends[1][0]
    assert ends[1][1] < ends[2][0]


def test_the_law_is_judged_at_the_first_a_middle_and_the_last_resonance():
    assert [r.frequency_hz for r in judged_of(SIX)] == [20.0, 180.0, 720.0]
    chosen = in_one_piece(np.random.default_rng(1), SIX)
    assert 5 <= len(chosen) <= 6
    with pytest.raises(ArithmeticError, match="expected 5"):
        in_one_piece(np.random.default_rng(1), SIX[:4])
    with pytest.raises(ArithmeticError, match="4 resonances"):
        in_one_piece(np.random.default_rng(1), SIX, known_to_hz=1.05 * SIX[4].frequency_hz)


def test_a_sweep_in_one_piece_ends_where_the_solid_is_known():
    for plate, seed in (("P1", 5200003), ("P9", 5200007)):
        case = draw_case(NONE, seed, plate=plate, one_piece=True)
        known = known_to_hz(clean_plate(case.truth.plate), case.truth.law)
        assert case.sweep.frequency_hz.max() < known


def test_one_range_has_a_floor_of_its_own_and_the_same_drifts():
    rng = np.random.default_rng(2)
    noise = draw_noise(rng)
    one = of_one_range(rng, noise)
    assert 3e-4 <= one.white.fraction_of_peak <= 2e-3 < noise.white.fraction_of_peak
    assert (one.wander, one.gain_drift) == (noise.wander, noise.gain_drift)
    assert one.white.repeat_scatter == noise.white.repeat_scatter


def as_true(case):
    """Says how many segments the sweep has, in place of an error."""
    G = case.truth.modulus_pa
    count = float(len(np.unique(case.sweep.segment)))
    ones = (count,) * len(G)
    return Band(case.truth.resonances_hz, tuple(G.real), tuple(G.imag / G.real), ones, ones)


def test_the_command_draws_them(tmp_path, monkeypatch):
    monkeypatch.setattr("campaign.__main__.identified", as_true)
    options = [
        "--law-alone",
        "--one-piece",
        "--count",
        "1",
        "--seed",
        "11",
        "--kind",
        "none",
        "--workers",
        "1",
    ]
    result = CliRunner().invoke(campaign, ["plates", str(tmp_path), *options])
    assert result.exit_code == 0, result.output
    line = json.loads((tmp_path / "outcomes.jsonl").read_text(encoding="utf-8"))
    assert line["identified"]["storage_error_pa"] == pytest.approx([1.0, 1.0, 1.0])


def test_they_are_of_plates_alone(tmp_path):
    result = CliRunner().invoke(campaign, ["beams", str(tmp_path), "--one-piece"])
    assert result.exit_code == 2
    assert "No such option '--one-piece'" in result.output
