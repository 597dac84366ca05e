"""What may stand in for a cause that is in no catalogue."""

from types import SimpleNamespace

import numpy as np
import pytest
from fitted_by_hand import FittedByHand

from fitting.diagnosis.search.stand_in import asks_for_more, stands_in, too_large, unsized
from fitting.effects import CATALOGUE
from fitting.effects.given import Points

SHEET = SimpleNamespace(thickness_m=2e-3, density_kg_m3=2700.0)
LAYERS = SimpleNamespace(substrate=SHEET, core=None, constraining=None)
PLATE = SimpleNamespace(length_m=0.3, width_m=0.2, specimen=LAYERS)
OMEGA = 2 * np.pi * np.linspace(90.0, 110.0, 21)
PROBLEM = SimpleNamespace(
    plate=PLATE,
    points=Points(OMEGA, np.ones(21), np.arange(21.0), True, True, "relative"),
    resonances=np.array([2 * np.pi * (300 + 3j)]),
)


def fitted(**effects):
    found = {CATALOGUE[name]: np.array(u) for name, u in effects.items()}
    return SimpleNamespace(effects=tuple(found), of=found.__getitem__)


@pytest.mark.parametrize(
    ("effects", "why"),
    [
        ({"gain_error": [1.02]}, ""),
        ({"fixture_resonance": [100.0, 0.02, 0.02, 0.0, 1.0]}, ""),
        ({"fixture_resonance": [150.0, 0.02, 0.02, 0.0, 1.0]}, "no measured points"),
        ({"segment_gain": [1.02, 90.0, 110.0, 0.0]}, ""),
        ({"segment_gain": [1.02, 90.0, 110.0, 0.0], "gain_error": [1.02]}, "what one segment alone shows"),
        ({"added_masses": [1e-3, 0.1, 0.1, 1e-3, 0.2, 0.1]}, ""),
        ({"added_masses": [1e-3, 0.1, 0.1, 1e-3, 0.2, 0.1], "gain_error": [1.02]}, "so many things"),
        # Quite free is as far as a treatment goes.
        ({"treatment_not_gripped": [1e6]}, ""),
        ({"viscous_damping": [CATALOGUE["viscous_damping"].parameters[0].upper]}, "larger than is plausible"),
    ],
)
def test_an_explanation_says_why_it_may_stand_in(effects, why):
    said = stands_in(PROBLEM, fitted(**effects))
    assert said.startswith(why) or why in said
    assert too_large(fitted(**effects), PLATE) == ("viscous_damping" if "larger" in why else "")
    assert bool(said) == bool(why)


@pytest.mark.parametrize(
    ("mass_error", "factor_error", "nothing"),
    [(1e-3, 1e-3, False), (6e-3, 1e-3, True), (1e-3, 0.05, True), (np.nan, 1e-3, False)],
)
def test_of_two_effects_each_is_of_a_size_or_one_may_be_what_the_other_lacks(
    mass_error, factor_error, nothing
):
    mass, gain = CATALOGUE["added_mass"], CATALOGUE["gain_error"]
    # A place that is well known says nothing of what is there.
    errors = np.array([mass_error, 1e-3, 1e-3, factor_error])
    both = FittedByHand(
        effects=(mass, gain),
        u=np.array([0.3, 5e-3, 0.1, 0.1, 1.04]),
        stated=1,
        free=np.array([False, True, True, True, True]),
        law=SimpleNamespace(names=("g_pa", "loss")),
        covariance=np.diag(np.concatenate([[1e8, 1e-4], errors**2])),
    )
    assert unsized(both) == nothing
    alone = FittedByHand(**vars(both) | {"effects": (gain,)})
    assert not unsized(alone)


@pytest.mark.parametrize("name", sorted(n for n, e in CATALOGUE.items() if e.parameters))
def test_no_effect_asks_for_more_where_it_is_absent_or_usual(name):
    effect = CATALOGUE[name]
    lower, upper = effect.limits(PLATE)
    typical = np.clip([q.typical for q in effect.parameters], lower, upper)
    absent = [t if q.neutral is None else q.neutral for q, t in zip(effect.parameters, typical, strict=True)]
    assert not asks_for_more(effect, typical, PLATE)
    assert not asks_for_more(effect, np.clip(absent, lower, upper), PLATE)


@pytest.mark.parametrize("kind", ["plate", "beam", "shear-pair"])
@pytest.mark.parametrize("end", ["lower", "upper"])
def test_a_tether_as_stiff_as_may_be_asks_for_more(kind, end):
    tether = CATALOGUE["tether"].on(kind)
    u = np.array([q.typical for q in tether.parameters])
    assert not asks_for_more(tether, u, PLATE)
    u[0] = getattr(tether.parameters[0], end)
    assert asks_for_more(tether, u, PLATE)
