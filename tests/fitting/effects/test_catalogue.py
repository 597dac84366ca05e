"""What every effect says of itself."""

from inspect import getdoc, getmodule

import numpy as np
import pytest

from fitting.effects import CATALOGUE

FORMS = [form for effect in CATALOGUE.values() for form in effect.variants()]
SHOWN_BY_CHANNELS = ("level_error", "mains_hum", "signal_dropout", "fixture_transfer")
"""What they say has no parameter of a fit in it."""
SAID = {
    "absolute_velocity": ("relative to the clamp",),
    "ac_coupling corner": ("corner at 0.5 Hz",),
    "added_mass mass": ("a mass of 3 g", "near (50, 50) mm"),
    "added_masses mass_1": ("3 g near (50, 50) mm and 3 g near (50, 50) mm",),
    "air_added_mass density": ("air of 1.2 kg/m^3",),
    "amplitude_softening k": ("by 10 % at the largest strain",),
    "axial_stress stress_x": ("along x with 3 MPa",),
    "axial_stress stress_y": ("along y with 3 MPa",),
    "base_rocking pitch": ("(+0.05 rad/m)",),
    "base_roll roll": ("(+0.05 rad/m)",),
    "channel_delay delay": ("lags by 50 microseconds",),
    "clamp_compliance k": ("(5e+13 N/m^3 of clamped face)",),
    "clamp_friction k": ("loss factor 0.1 in springs of 5e+13 N/m^3",),
    "clamp_line dlength": ("1.0 mm more",),
    "constraining_stiffness scale": ("+3 % off its stated stiffness",),
    "constraining_thickness scale": ("+3 % off its stated thickness",),
    "core_difference stiffer": ("G' +10 %", "loss factor +10 %"),
    "core_law": ("another law than the stated one",),
    "core_thickness scale": ("+5 % off its stated thickness",),
    "exponential_window tau": ("window of 0.3 s",),
    "fixture_resonance frequency": ("resonates at 100 Hz", "damping ratio 0.02"),
    "gain_error factor": ("reads 2.00 % high",),
    "partial_debond x_from": ("x = 20 to 45 mm",),
    "partial_debond y_from": ("y = 20 to 45 mm",),
    "partial_debond x_edge": ("x = -5 to 20 mm",),
    "partial_debond y_edge": ("y = -5 to 20 mm",),
    "graded_core grade_x": ("1.22 times as large at the plate's tip as at its root",),
    "graded_core grade_y": ("1.22 times as large at the plate's far edge as at its near edge",),
    "layer_density scale": ("+3 % off its stated density",),
    "loose_part mass": ("a part of 1 g near (50, 50) mm", "100 Hz", "loss factor 0.06"),
    "missing_piece mass": ("2 g of the plate are gone near (50, 50) mm",),
    "orthotropic_substrate ratio": ("+3.0 % stiffer across than along",),
    "outside_damping c": ("5 N s/m per square metre",),
    "phase_offset phase": ("leads by +1.1 degrees",),
    "phase_scale factor": ("+2 % off",),
    "segment_gain factor": ("reads +3 % off",),
    "sensor_lowpass corner": ("corner at 3e+03 Hz",),
    "sensor_mounting frequency": ("resonance at 3e+03 Hz",),
    "spot_offset dx": ("off by (+3.0, +3.0) mm along x and y",),
    "substrate_stiffness scale": ("+3 % off its stated stiffness",),
    "substrate_thickness scale": ("+3 % off its stated thickness",),
    "temperature_drift warming": ("warms by 2 K", "within 10 min"),
    "temperature_drift step": ("1 K warmer",),
    "temperature_drift swing_sine": ("swings by 0.42 K", "every 15 min"),
    "temperature_difference warmer": ("2 K warmer",),
    "tether k": ("near (50, 50) mm", "50 N/m", "loss factor 0.2"),
    "treatment_not_gripped k": ("1e+08 N/m^2",),
    "uneven_clamp k": ("5e+13 N/m^3", "2 times as stiff"),
    "viscous_damping scale": ("2 times the bare plate's",),
}
"""Of what is expected of an effect, by its name and the first of its unknowns: numbers with their units."""
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


@pytest.mark.parametrize("form", [f for f in FORMS if f.name not in SHOWN_BY_CHANNELS], ids=ids)
def test_it_tells_its_size_as_a_number_with_its_unit(form):
    said = form.story({q.key: q.typical for q in form.parameters})
    for words in SAID[" ".join([form.name, *(q.key for q in form.parameters[:1])])]:
        assert words in said


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
