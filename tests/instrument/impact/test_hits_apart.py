"""Hits that are not of one plate: named, and their mean not adopted."""

from dataclasses import replace

import numpy as np
import pytest
from impact_cases import BARE_HZ, TABLE_3, clean_hit, noisy_hits

from instrument.impact.damping import damping_of_hits
from instrument.impact.hits_apart import told_apart
from instrument.impact.judge import judge
from instrument.impact.mode import Mode
from instrument.impact.spectra import spectra

AT = tuple(BARE_HZ[:5])


def hits(*plates, seed=0, noise=0.002):
    """One of each: how much higher its frequencies and its ratios are."""
    rng = np.random.default_rng(seed)
    made = []
    for k, (f, zeta) in enumerate(plates):
        (hit,) = noisy_hits(clean_hit(f * BARE_HZ, zeta * TABLE_3), rng, 1, noise)
        made.append(hit.__class__(f"hit {k + 1}", hit.sample_rate_hz, hit.force_n, hit.responses))
    return [judge(hit) for hit in made]


def ratios(found):
    each = [m.rational_fit for m in found.modes]
    return np.array([e.ratio for e in each]), np.array([e.standard_error for e in each])


@pytest.mark.parametrize("other", [(1.0, 1.3), (1.0, 2.0), (1.002, 1.0)])
def test_one_hit_of_another_plate_is_named_and_leaves_the_ratios(other):
    found = damping_of_hits(hits((1, 1), other, (1, 1)), at_hz=AT)
    (said,) = (w for w in found.warnings if "other hits" in w)
    assert said.startswith("hit 2 differs from the other hits at 17.7")
    ratio, error = ratios(found)
    np.testing.assert_allclose(ratio, TABLE_3[:5], rtol=0.02)
    assert np.all(np.abs(ratio - TABLE_3[:5]) < 4 * error)
    assert all("median adopted" in m.why for m in found.modes)


def test_hits_that_all_wander_are_said_to_and_do_not_widen_a_peak():
    drifting = [(1 + 1e-3 * k, 1.0) for k in range(5)]
    found = damping_of_hits(hits(*drifting), at_hz=AT)
    assert any("the hits differ from one another" in w for w in found.warnings)
    ratio, error = ratios(found)
    assert np.all(np.abs(ratio - TABLE_3[:5]) < 4 * error)
    np.testing.assert_allclose(ratio, TABLE_3[:5], rtol=0.02)


@pytest.mark.parametrize("seed", range(4))
def test_hits_of_one_plate_are_averaged_as_they_are(seed):
    alike = hits((1, 1), (1, 1), (1, 1), seed=seed)
    found = damping_of_hits(alike, at_hz=AT)
    assert not any("differ" in w for w in found.warnings)
    assert all(isinstance(m, Mode) for m in found.modes)
    alone = [spectra([hit]).frfs for hit in alike]
    assert told_apart(alike, alone, found.modes) == (found.modes, [])
    assert told_apart(alike[:1], alone[:1], found.modes) == (found.modes, [])


def test_a_blow_late_in_the_record_loses_no_mode_and_no_digits():
    at_once = hits((1, 1), (1, 1), (1, 1))
    wait = int(0.5 * at_once[0].hit.sample_rate_hz)
    late = [judge(later(j.hit, wait + 3 * k)) for k, j in enumerate(at_once)]
    early, found = damping_of_hits(at_once, at_hz=AT), damping_of_hits(late, at_hz=AT)
    (ratio, error), (before, known) = ratios(found), ratios(early)
    assert np.all(np.abs(ratio - TABLE_3[:5]) < 4 * error)
    assert np.all(error < 2 * known)
    np.testing.assert_allclose(ratio, before, rtol=0.02)


def later(hit, samples):
    """Quiet before the blow, as long as the record was."""
    rng = np.random.default_rng(samples)

    def waited(x):
        quiet = np.std(x[:20]) * rng.normal(size=samples)
        return np.concatenate([quiet, x[: len(x) - samples]])

    responses = tuple(replace(c, samples=waited(c.samples)) for c in hit.responses)
    return replace(hit, force_n=waited(hit.force_n), responses=responses)
