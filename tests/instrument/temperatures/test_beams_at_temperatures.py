"""Tables of modes of sandwich beams at several temperatures, made by elements of their own, under one law."""

from dataclasses import replace

import numpy as np
import pytest
from beam_temperatures import REFERENCE, beam, measured, of_no_formula, wlf, zener

from fitting.structures.shear_pair import ShearPair
from instrument.errors import BadInput
from instrument.temperatures.members import Members
from instrument.temperatures.shifted import identify_shifted
from instrument.temperatures.temperature_remarks import remarks_at_temperatures

T = [0.0, 20.0, 35.0, 50.0]
MORE = [-15.0, *T]
C = (8.0, 110.0)


def shift(temperature_c):
    return wlf(temperature_c, *C)


def off(found):
    """Of every factor that is not the reference's, in standard errors."""
    t = found.fit.shift.temperature_c
    moved = t != REFERENCE
    return ((found.fit.log_shift - shift(t)) / np.maximum(found.fit.log_shift_errors, 1e-12))[moved]


def law_off(found, law):
    """Of G' and of eta over all reduced frequencies, in standard errors."""
    b = found.band
    G = law(2 * np.pi * b.frequency_hz)
    storage = (b.storage_modulus_pa - G.real) / b.storage_modulus_standard_error_pa
    return storage, (b.loss_factor - G.imag / G.real) / b.loss_factor_standard_error


@pytest.fixture(scope="module")
def made():
    return measured(zener, T, shift, count=3)


@pytest.fixture(scope="module")
def more():
    return measured(zener, MORE, shift)


@pytest.fixture(scope="module")
def found(made):
    return identify_shifted(made, beam(), "wlf", REFERENCE)


def test_factors_and_law_lie_in_their_bands_and_the_law_is_one(found):
    assert found.verdict.simple is True
    assert np.abs(off(found)).max() < 3
    storage, eta = law_off(found, zener)
    assert np.abs(storage).max() < 3.5
    assert np.abs(eta).max() < 3.5
    # Three modes a temperature, between which there are gaps.
    error = found.band.storage_modulus_standard_error_pa / found.band.storage_modulus_pa
    assert np.median(error) < 0.1


def test_numbers_of_a_beam_are_one_at_all_its_temperatures_and_its_metal_is_found_to_soften(found):
    named = {one.name: one for one in found.adjusted}
    assert len(named) == len(found.adjusted)
    assert {"length", "substrate_thickness", "substrate_young", "core_thickness"} <= set(named)
    per_k = named["substrate_young_per_k"]
    assert (per_k.stated, per_k.tolerance, per_k.unit) == pytest.approx((-0.04, 0.02, "%/K"))
    assert abs(per_k.found + 0.03) < 2.5 * per_k.standard_error
    assert any("is taken to change by -0.04 +- 0.02 % a kelvin" in one for one in found.warnings)


def test_modes_are_told_beside_those_that_were_measured(found, made):
    f, eta = found.predicted_modes
    measured_hz = np.concatenate([one.data.frequency_hz for one in made])
    np.testing.assert_allclose(f, measured_hz, rtol=5e-3)
    np.testing.assert_allclose(eta, np.concatenate([one.data.loss_factor for one in made]), rtol=0.15)


@pytest.mark.long
def test_one_wrong_thermometer_is_named_and_the_material_is_not_blamed(more):
    wrong = [replace(one, temperature_c=one.temperature_c + 12.0 * (one.temperature_c == 35)) for one in more]
    words = identify_shifted(wrong, beam(), "wlf", REFERENCE).verdict.words
    assert "beam 1.csv is stated at 47 degC, its readings are those of 3" in words
    assert "loss factor" not in words


def with_row(made, at, place, **columns):
    """The members with one reading of the one at a temperature changed."""

    def changed(one):
        values = {name: getattr(one.data, name).copy() for name in columns}
        for name, times in columns.items():
            values[name][place] *= times
        return replace(one, data=replace(one.data, **values))

    return [changed(one) if one.temperature_c == at else one for one in made]


@pytest.mark.long
def test_one_wrong_row_is_named_before_material_or_temperatures_are_blamed(more):
    words = identify_shifted(with_row(more, 20.0, 2, loss_factor=2.0), beam(), "wlf", REFERENCE).verdict.words
    assert words.startswith("whether one shifted law serves cannot be told")
    assert "at 20 degC mode 3 does not go with the others" in words


@pytest.mark.long
def test_modes_that_are_numbered_wrongly_are_asked_about_at_once(more):
    lost = [replace(one, data=replace(one.data, mode=one.data.mode + (one.data.mode > 1))) for one in more]
    with pytest.raises(BadInput, match=r"beam 1\.csv: no core of its own .* expected another specimen"):
        identify_shifted(lost, beam(), "wlf", REFERENCE)


@pytest.mark.long
def test_errors_that_nobody_states_refuse_no_material(more):
    unsaid = [
        replace(one, data=replace(one.data, frequency_std_hz=None, loss_factor_std=None)) for one in more
    ]
    wrong = [
        replace(one, temperature_c=one.temperature_c + 12.0 * (one.temperature_c == 35)) for one in unsaid
    ]
    found = identify_shifted(wrong, beam(), "wlf", REFERENCE)
    assert found.verdict.simple is None
    assert "the errors of the modes are not stated" in found.verdict.words
    assert any("assumed are" in one for one in found.warnings)


@pytest.mark.long
def test_a_temperature_of_one_mode_takes_part(more):
    few = [replace(one, data=first(one.data)) if one.temperature_c == 0 else one for one in more]
    found = identify_shifted(few, beam(), "wlf", REFERENCE)
    assert found.verdict.simple is True
    assert np.abs(off(found)).max() < 3


def first(table):
    return replace(
        table,
        **{
            name: getattr(table, name)[1:2]
            for name in (
                *("mode", "frequency_hz", "loss_factor"),
                *("frequency_std_hz", "loss_factor_std", "temperature_c"),
            )
        },
    )


@pytest.mark.long
def test_a_law_that_no_formula_has_is_one_law_all_the_same_and_its_band_holds_it():
    made = measured(of_no_formula, [-20.0, 0.0, 20.0, 40.0, 60.0], shift, seed=3)
    found = identify_shifted(made, beam(), "wlf", REFERENCE)
    assert found.verdict.simple is True
    assert np.abs(off(found)).max() < 3
    for one in law_off(found, of_no_formula):
        assert np.mean(np.abs(one) < 1.96) > 0.8
        assert np.abs(one).max() < 4


def test_structures_of_two_kinds_make_no_shift(made):
    pair = ShearPair(0.2, 2, 1e-3, beam().core)
    with pytest.raises(BadInput, match="--shift: beam and shear-pair, expected one of them"):
        identify_shifted(made, [beam(), pair], "wlf", REFERENCE)


def test_of_an_exact_beam_that_states_its_metal_nothing_is_guessed(made):
    stated = beam(young_per_k=-3e-4)
    assert not any(
        "a kelvin" in one for one in remarks_at_temperatures(Members(made, [stated]), vertical=False)
    )
    exact = replace(beam(), exact=True)
    members = Members(made, [exact])
    assert not any("a kelvin" in one for one in remarks_at_temperatures(members, vertical=False))
    assert members.specimen(made[0]) == exact
    assert Members(made, [stated]).specimen(made[0]).temperature_c == 0.0


@pytest.mark.long
@pytest.mark.parametrize("law", [zener, of_no_formula])
def test_over_many_draws_bands_hold_what_they_say(law):
    shifts, storage, eta = [], [], []
    for seed in range(8):
        made = measured(law, [-20.0, -5.0, 10.0, 20.0, 35.0, 50.0], shift, beams=2, seed=100 + seed)
        found = identify_shifted(made, [beam(0), beam(1)], "wlf", REFERENCE)
        assert found.verdict.simple is True
        shifts += off(found).tolist()
        for every, one in zip((storage, eta), law_off(found, law), strict=True):
            every += one[::5].tolist()
    for one in (shifts, storage, eta):
        assert np.mean(np.abs(one) < 1.96) > 0.85
        assert np.sqrt(np.mean(np.square(one))) < 1.4


def test_that_a_rubber_s_modulus_goes_with_the_temperature_is_said_where_it_is_not_let(made):
    members = Members(made, [beam()])
    of_rubber = [one for one in remarks_at_temperatures(members, vertical=False) if "--vertical" in one]
    T = [one.temperature_c + 273.15 for one in made]
    assert len(of_rubber) == 1
    assert f"besides, by {100 * (max(T) / min(T) - 1):.0f} % over these" in of_rubber[0]
    assert not any("--vertical" in one for one in remarks_at_temperatures(members, vertical=True))
