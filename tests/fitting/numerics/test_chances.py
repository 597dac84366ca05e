import re
from pathlib import Path

import numpy as np
import pytest
from scipy import stats

import fitting
from fitting.numerics.chances import (
    binomial_above,
    chi2_above,
    chi2_density,
    chi2_exceeded,
    chi2_median,
    f_above,
    normal_above,
    normal_exceeded,
)

RNG = np.random.default_rng(3)
FREEDOM = RNG.integers(1, 300, 500)


def test_tries_are_counted_as_scipy_does():
    tries, share = RNG.integers(1, 30, 200), RNG.random(200)
    count = RNG.integers(0, tries)
    np.testing.assert_allclose(
        binomial_above(count, tries, share), stats.binom.sf(count, tries, share), rtol=1e-9
    )


def test_they_are_scipys_to_the_bit():
    x, z, chance = 200 * RNG.random(500), 6 * RNG.standard_normal(500), RNG.random(500)
    np.testing.assert_array_equal(chi2_above(x, FREEDOM), stats.chi2.sf(x, FREEDOM))
    np.testing.assert_array_equal(chi2_exceeded(chance, FREEDOM), stats.chi2.isf(chance, FREEDOM))
    np.testing.assert_array_equal(chi2_median(FREEDOM), stats.chi2.median(FREEDOM))
    np.testing.assert_array_equal(normal_above(z), stats.norm.sf(z))
    np.testing.assert_array_equal(normal_exceeded(chance), stats.norm.isf(chance))
    np.testing.assert_array_equal(chi2_density(x, FREEDOM), stats.chi2.pdf(x, FREEDOM))
    np.testing.assert_array_equal(f_above(x, 2, FREEDOM), stats.f.sf(x, 2, FREEDOM))


@pytest.mark.parametrize(("x", "freedom"), [(-1e-12, 3), (0.0, 3), (np.nan, 3), (np.inf, 3), (1.0, 0)])
def test_so_they_are_at_the_edges(x, freedom):
    np.testing.assert_equal(chi2_above(x, freedom), stats.chi2.sf(x, freedom))


def test_nothing_that_every_diagnosis_runs_loads_scipys_own():
    sources = {path.name: path.read_text() for path in Path(fitting.__file__).parent.rglob("*.py")}
    loading = re.compile(
        r"^\s*(from scipy(\.stats)? import.*\bstats\b|from scipy\.stats import)", re.MULTILINE
    )
    # Ranks of a posterior's chains are asked for by itself, and take minutes.
    assert {name for name, text in sources.items() if loading.search(text)} == {"chains.py"}
