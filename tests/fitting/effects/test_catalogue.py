"""What every effect says of itself."""

from inspect import getdoc, getmodule

import numpy as np
import pytest

from fitting.effects import CATALOGUE

FORMS = [form for effect in CATALOGUE.values() for form in effect.variants()]
SPANNED = ("mass", "treatment", "uneven", "length", "roll")


def ids(form):
    return f"{form.name} {' '.join(q.key for q in form.parameters)}"


@pytest.mark.parametrize("form", FORMS, ids=ids)
def test_it_says_what_it_is_and_what_shows_it_apart(form):
    assert getdoc(getmodule(type(form)))
    assert form.source
    assert form.discriminating_test
    # What lies between files hardly ever does not.
    assert 0 < form.chance <= (0.15 if form.between_files else 0.05)
    values = {q.key: q.typical for q in form.parameters}
    if form.name not in ("level_error", "mains_hum", "signal_dropout", "fixture_transfer"):
        assert len(form.story(values)) > 20


@pytest.mark.parametrize("form", FORMS, ids=ids)
def test_every_size_has_a_prior(form):
    """What is absent at a number has a spread about it; places and logarithms are even in their limits."""
    for q in form.parameters:
        even = q.logarithmic or q.neutral is None
        assert (q.spread is None) == even or q.fixed, q.key
        assert q.lower < q.upper
        if q.spread is not None:
            assert q.lower <= q.neutral <= q.upper
            # The limits are no tighter than what is likely.
            assert max(q.upper - q.neutral, q.neutral - q.lower) >= 2 * q.spread


@pytest.mark.parametrize(
    "form", [f for f in FORMS if {s.name for s in f.spans} & set(SPANNED) and not f.sharp], ids=ids
)
def test_starts_lie_within_limits(full, form):
    lower, upper = form.limits(full.spanned)
    starts = form.starts(full.spanned, None)
    assert all((lower <= u).all() and (u <= upper).all() for u in starts)
    assert len(starts) <= 40
    assert all(np.isfinite(u).all() for u in starts)


@pytest.mark.parametrize("form", [f for f in FORMS if f.within(np.ones(len(f.parameters)))], ids=ids)
def test_what_an_effect_contains_stands_in_the_catalogue(form):
    u = np.arange(1.0, len(form.parameters) + 1)
    for simpler, its in form.within(u):
        # What is the simpler one only at a limit of its own does not extend it.
        assert form.extends in (None, simpler.name)
        assert simpler.name in CATALOGUE
        assert its.shape == (len(simpler.parameters),)
        assert set(its) <= set(u)


def test_one_of_two_masses_is_what_both_are_without_the_other(full):
    form = CATALOGUE["added_masses"]
    u = form.starts(full.spanned, None)[0]
    for number, (one, its) in enumerate(form.within(u)):
        without = u.copy()
        without[3 * (1 - number)] = 0.0
        assert np.allclose(form.change(full.spanned, without).M, one.change(full.spanned, its).M)


@pytest.mark.parametrize(("dlength", "words"), [(0.0038, "3.8 mm more than"), (-0.0038, "3.8 mm less than")])
@pytest.mark.parametrize("kind", ["plate", "beam"])
def test_a_clamp_line_elsewhere_is_told_by_how_far(kind, dlength, words):
    said = CATALOGUE["clamp_line"].on(kind).story({"dlength": dlength})
    assert said == f"the {kind} is free over {words} its stated length"


def test_the_sign_of_a_size_is_a_word():
    gain, strain = (CATALOGUE[name] for name in ("gain_error", "amplitude_softening"))
    assert gain.story({"factor": 0.987}) == "the velocity channel reads 1.30 % low"
    assert gain.story({"factor": 1.024}) == "the velocity channel reads 2.40 % high"
    assert strain.story({"k": 0.25}).startswith("the core softens with strain, by 25 % at the largest")
    assert strain.story({"k": -0.25}).startswith("the core stiffens with strain, by 25 % at the largest")
