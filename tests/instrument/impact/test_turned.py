"""A response of the other sign in some hits is turned, and is no other plate."""

from dataclasses import replace

import numpy as np
import pytest
from impact_cases import BARE_HZ, TABLE_3, clean_hit, noisy_hits

from instrument.impact.damping import damping_of_hits
from instrument.impact.judge import judge
from instrument.impact.spectra import spectra
from instrument.impact.turned import turned_alike

AT = tuple(BARE_HZ[:5])


def hits(signs, seed=0):
    made = noisy_hits(clean_hit(), np.random.default_rng(seed), len(signs))
    return [
        judge(replace(h, responses=tuple(replace(c, samples=sign * c.samples) for c in h.responses)))
        for h, sign in zip(made, signs, strict=True)
    ]


@pytest.mark.parametrize("signs", [(-1, 1, 1), (1, 1, -1), (1, -1, 1, -1)])
def test_the_modes_are_those_of_hits_of_one_sign(signs):
    found, straight = (
        damping_of_hits(hits(signs), at_hz=AT),
        damping_of_hits(hits([1] * len(signs)), at_hz=AT),
    )
    turned = [m.damping_ratio for m in found.modes]
    np.testing.assert_allclose(turned, [m.damping_ratio for m in straight.modes], rtol=1e-9)
    np.testing.assert_allclose(turned, TABLE_3[:5], rtol=0.02)
    said = [w for w in found.warnings if "opposite sign" in w]
    assert len(said) == sum(sign < 0 for sign in signs)


def test_hits_of_one_sign_are_left_as_they_are():
    given = hits([1, 1, 1])
    after, said = turned_alike(given, [spectra([h]).frfs for h in given], (0.0, 450.0))
    assert said == []
    assert all(a is b for a, b in zip(after, given, strict=True))
