"""Beams with something hidden: named, with its size and place, and the core's law found beside it."""

from dataclasses import replace

import numpy as np
import pytest
from rivals import among

from fitting.effects import CATALOGUE
from fitting.identification.model import velocity
from fitting.laws import LAWS
from fitting.stated.layers import Core, Face
from fitting.structures import Beam
from fitting.structures.small import widened_system_of
from fitting.sweep import Sweep
from instrument.finding.diagnosis import diagnose
from instrument.finding.identification import identify
from instrument.models.files import File, spots_of

TRUTH = LAWS["fractional-zener"](0.45e6, 7e6, 7e-5, 0.62)
STATED = LAWS["fractional-zener"](0.3e6, 5e6, 1e-4, 0.7)
ALUMINIUM, FOIL = Face(2e-3, 70e9, 0.3, 2700.0), Face(0.5e-3, 70e9, 0.3, 2700.0)
CLAMPED = Beam(
    *(0.2, 0.02, "clamped-free", ALUMINIUM),
    constraining=FOIL,
    core=Core(0.3e-3, 0.49, 1000.0, STATED),
    pickup_m=0.15,
)
FREE = replace(CLAMPED, boundary="free-free", force_m=0.02)
FREQUENCY_HZ = np.geomspace(20, 1500, 160)


def read(beam, name, u, seed, law=TRUTH):
    """What is read of a beam that has an effect, 0.4 % noise: every degree of freedom solved."""
    omega, rng = 2 * np.pi * FREQUENCY_HZ, np.random.default_rng(seed)
    plate, drive = widened_system_of(beam, beam.parts()), 1.0 if beam.drive == "force" else 9.81
    if name is not None:
        effect = CATALOGUE[name].standing_on(beam)
        plate = plate.take(effect.spans)
        change = effect.change(plate, np.array(u))
        M, K_0, K_1 = plate.M + change.M, plate.K_0 + change.K, plate.K_1 + change.K_1
        load = plate.load + (change.load if beam.drive == "base" else 0.0)
        plate = replace(plate, M=M, K_0=K_0, K_1=K_1, load=load, observe=plate.observe + change.observe)
    else:
        plate = plate.take([])
    w = omega[:, None, None]
    A = plate.K_0 + law.modulus(omega)[:, None, None] * plate.K_1 - w**2 * plate.M
    sides = np.broadcast_to(plate.load.astype(complex)[:, None], (len(omega), len(plate.load), 1))
    v = velocity(omega, np.linalg.solve(A, sides)[:, :, 0] @ plate.observe, beam.reads) * drive
    noise = rng.normal(size=len(omega)) + 1j * rng.normal(size=len(omega))
    one = np.ones(len(omega), int)
    return Sweep(FREQUENCY_HZ, v * (1 + 0.004 / np.sqrt(2) * noise), drive * one, one, one)


def off(law):
    """Of G' and of the loss factor, where resonances of either beam tell of the core."""
    omega = 2 * np.pi * np.array([250.0, 500.0, 800.0])
    G, true = law.modulus(omega), TRUTH.modulus(omega)
    return np.abs(G.real / true.real - 1).max(), np.abs(G.imag / G.real * true.real / true.imag - 1).max()


MASS = {"mass": 3e-3, "x": 0.16}, {"mass": 3e-4, "x": 1e-3}
"""Hidden, and within what it is to be found."""


@among("added_mass", "clamp_compliance", "clamp_line", "core_thickness", "tether", "gain_error")
@pytest.mark.parametrize(
    ("beam", "name", "hidden", "found_within"),
    [
        *(
            pytest.param(beam, "added_mass", *MASS, marks=pytest.mark.long, id=f"mass-{ends}")
            for beam, ends in ((CLAMPED, "clamped"), (FREE, "free"))
        ),
        pytest.param(CLAMPED, "clamp_compliance", {"k": 1e13}, {"k": 2e12}, id="clamp-yields"),
    ],
)
def test_what_is_hidden_is_named_with_its_size_and_place(beam, name, hidden, found_within, without):
    files = [File(read(beam, name, list(hidden.values()), 1), beam)]
    result = diagnose(files, without=without).result
    assert result.effects[0].name == name
    for key, within in found_within.items():
        assert result.effects[0].parameters[key].value == pytest.approx(hidden[key], abs=within)
    assert max(off(result.after.law)) < 0.06
    # Without it the law is off, or a stated number is where none can be.
    pulled = max(abs(one.pull) for one in result.before.adjusted)
    assert pulled > 3 if name == "clamp_compliance" else max(off(result.before.law)) > 0.1


@pytest.mark.long
def test_a_clean_free_beam_struck_at_a_point_has_nothing():
    result = diagnose([File(read(FREE, None, (), 3), FREE)]).result
    assert result.verdict == "none"
    assert max(off(result.after.law)) < 0.08


def test_two_spots_of_one_file_are_fitted_together_where_each_was_read():
    beam = replace(FREE, pickup_m=0.05, further_pickups_m=(0.15,))
    both = [read(beam.at_pickup(k), None, (), k) for k in (0, 1)]
    sweep = Sweep(
        **{
            name: np.concatenate([getattr(one, name) for one in both])
            for name in ("frequency_hz", "velocity_m_s", "commanded_m_s2", "segment", "sweep")
        },
        pickup=np.repeat([0, 1], len(FREQUENCY_HZ)),
    )
    files = spots_of(sweep, beam)
    assert [f.specimen.pickup_m for f in files] == [0.05, 0.15]
    found = identify(files).result
    assert max(off(found.fit.law)) < 0.05
    names = [one.name for one in found.fit.adjusted]
    assert {"pickup_x [pickup 0]", "pickup_x [pickup 1]", "force_x"} <= set(names)


def test_a_reading_lost_at_one_spot_of_a_file_is_said_with_the_spot():
    beam = replace(FREE, pickup_m=0.05, further_pickups_m=(0.15,))
    files = [
        File(read(beam.at_pickup(k), None, (), k), beam.at_pickup(k), pickup=k, number=1) for k in (0, 1)
    ]
    spoiled = files[1].sweep.velocity_m_s.copy()
    spoiled[60] *= 3
    files[1] = replace(files[1], sweep=replace(files[1].sweep, velocity_m_s=spoiled))
    result = diagnose(files, accept=[]).result
    (lost,) = [one for one in result.channels if one.name == "signal_dropout"]
    assert lost.parameters["pickup"].value == 1
    assert "at pickup 1 one reading leaves" in " ".join(result.explanation).lower()


@among("substrate_thickness", "clamp_compliance", "core_thickness", "gain_error")
def test_beside_a_free_layer_stiffer_than_usual_laws_every_explanation_fits_as_well_as_none(without):
    """A fit that began ten times too soft was given up, and nothing but none was left."""
    metal = Face(1.2e-3, 200e9, 0.3, 7850.0)
    layer = Core(3e-3, 0.42, 1300.0, LAWS["fractional-zener"](2e8, 1e9, 3e-5, 0.6))
    stated = Beam(0.2, 0.012, "clamped-free", metal, core=layer, pickup_m=0.15)
    really = replace(stated, substrate=replace(metal, thickness_m=1.03 * metal.thickness_m))
    sweep = read(really, None, None, 5, LAWS["fractional-zener"](1.6e8, 1.3e9, 4e-5, 0.5))
    result = diagnose([File(sweep, stated)], without=without).result
    none = next(c for c in result.candidates if c.name == "none")
    assert len(result.candidates) > 4
    assert all(c.chi2_per_dof < 1.1 * none.chi2_per_dof for c in result.candidates)
    assert none.probability < 0.95
