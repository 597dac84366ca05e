"""Effects on beams against closed forms."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import eigh
from scipy.optimize import brentq

from fitting.effects import CATALOGUE
from fitting.effects.along_a_beam import AlongABeam
from fitting.effects.base import Effect
from fitting.effects.layer_density import SUBSTRATE
from fitting.effects.number_off import NumberOffEffect, changed_by_numbers
from fitting.effects.outside_damping import OutsideDampingEffect
from fitting.laws.constant import ConstantModulus
from fitting.stated.layers import Core, Face
from fitting.structures import Beam
from fitting.structures.small import widened_system_of
from fitting.structures.small_modes import elastic_modes, small_modes
from fitting.widened.change import Change

ALUMINIUM, FOIL = Face(2e-3, 70e9, 0.3, 2700.0), Face(0.5e-3, 70e9, 0.3, 2700.0)
LAW, STIFF = ConstantModulus(1e6, 0.5), ConstantModulus(1e6, 0.01)
CORE = Core(0.3e-3, 0.49, 1000.0, LAW)
L, B = 0.2, 0.02
BARE = Beam(L, B, "clamped-free", ALUMINIUM, pickup_m=0.15, slender=True)
SANDWICH = replace(BARE, constraining=FOIL, core=CORE)
PER_LENGTH, RIGIDITY = 2700 * B * 2e-3, 70e9 * B * 2e-3**3 / 12


def frequencies(beam, name, u, count=3, law=None):
    effect = CATALOGUE[name].standing_on(beam)
    plate = widened_system_of(beam, beam.parts()).take(effect.spans)
    plate = plate.with_part if effect.sharp else plate
    change = effect.change(plate, np.array(u))
    changed = replace(plate, K_0=plate.K_0 + change.K, K_1=plate.K_1 + change.K_1, M=plate.M + change.M)
    return [m.frequency_hz for m in elastic_modes(changed, law, count)]


def roots(determinant, count):
    x = np.linspace(0.3, 12, 3000)
    f = [determinant(a) for a in x]
    found = [brentq(determinant, a, b) for a, b, p, q in zip(x, x[1:], f, f[1:], strict=False) if p * q < 0]
    return [a**2 / L**2 * np.sqrt(RIGIDITY / PER_LENGTH) / (2 * np.pi) for a in found[:count]]


def test_a_mass_at_the_tip_lowers_every_mode_as_it_must():
    mu = 3e-3 / (PER_LENGTH * L)

    def free_with_mass(x):
        return 1 + np.cos(x) * np.cosh(x) + x * mu * (np.cos(x) * np.sinh(x) - np.sin(x) * np.cosh(x))

    assert frequencies(BARE, "added_mass", [3e-3, L]) == pytest.approx(roots(free_with_mass, 3), rel=1e-3)


def test_a_plates_effect_on_a_beam_is_called_with_a_place_on_the_axis():
    class OfPlate(Effect):
        def change(self, plate, u):
            return Change(load=u)

    class OfBeam(AlongABeam, OfPlate):
        pass

    np.testing.assert_array_equal(OfBeam().change(None, np.array([3e-3, L])).load, [3e-3, L, 0.0])


@pytest.mark.parametrize(("name", "u"), [("added_mass", [3e-3, L]), ("tether", [70.0, 0.1, L])])
def test_what_sits_on_a_beam_is_on_its_axis(name, u):
    of_plate, of_beam = CATALOGUE[name], CATALOGUE[name].standing_on(BARE)
    plate = widened_system_of(BARE, BARE.parts())
    assert [q.key for q in of_beam.parameters] == [q.key for q in of_plate.parameters if q.key != "y"]
    found, expected = of_beam.change(plate, np.array(u)), of_plate.change(plate, np.array([*u, 0.0]))
    for entry in ("K", "M", "load", "travel_load"):
        np.testing.assert_array_equal(getattr(found, entry), getattr(expected, entry))


def test_a_magnet_s_pull_is_a_negative_spring_and_what_it_loses_is_lost():
    tether = CATALOGUE["tether"].standing_on(SANDWICH)
    plate = widened_system_of(SANDWICH, SANDWICH.parts()).take(tether.spans)
    cable, magnet = (tether.change(plate, np.array([k, 0.1, L])).K for k in (70.0, -70.0))
    np.testing.assert_allclose(magnet.real, -cable.real)
    np.testing.assert_allclose(magnet.imag, cable.imag)
    assert "a magnet pulls" in tether.story({"k": -70.0, "loss_factor": 0.1, "x": L})
    assert frequencies(BARE, "tether", [-20.0, 0.0, L])[0] < frequencies(BARE, "tether", [0.0, 0.0, L])[0]


def test_what_damps_a_beam_from_outside_damps_it_by_its_face():
    """A mode of unit mass is damped by c over the mass per area, whichever it is."""
    effect = OutsideDampingEffect().standing_on(BARE)
    plate = widened_system_of(BARE, BARE.parts()).take(effect.spans)
    C = effect.change(plate, np.array([7.0])).C
    _, modes = eigh(plate.K_0.real, plate.M)
    damped = modes[:, :4].T @ C @ modes[:, :4]
    # What a slender beam's mass turns about its middle counts for little.
    assert np.diag(damped) == pytest.approx(7.0 * B / PER_LENGTH, rel=2e-3)
    assert np.abs(damped - np.diag(np.diag(damped))).max() < 2e-3 * damped[0, 0]
    assert OutsideDampingEffect().on("plate") is None


def test_a_loose_part_at_the_tip_adds_a_mode_and_moves_the_others_as_it_must():
    mass, f_0 = 3e-3, 60.0

    def free_with_part(x):
        r = x**2 / L**2 * np.sqrt(RIGIDITY / PER_LENGTH) / (2 * np.pi * f_0)
        bends = np.cos(x) * np.sinh(x) - np.sin(x) * np.cosh(x)
        # Felt as m / (1 - r^2): times that, it is smooth.
        return (1 - r**2) * (1 + np.cos(x) * np.cosh(x)) + x * mass / (PER_LENGTH * L) * bends

    found = frequencies(BARE, "loose_part", [mass, f_0, 0.0, L], 4)
    assert found == pytest.approx(roots(free_with_part, 4), rel=1e-3)
    assert found[0] < frequencies(BARE, "added_mass", [0.0, L])[0] < f_0 < found[1]


def test_a_cable_at_the_tip_stiffens_it_as_a_spring_does():
    k = 500.0

    def free_with_spring(x):
        stiff = k * L**3 / (RIGIDITY * x**3)
        return 1 + np.cos(x) * np.cosh(x) - stiff * (np.cos(x) * np.sinh(x) - np.sin(x) * np.cosh(x))

    assert frequencies(BARE, "tether", [k, 0.0, L]) == pytest.approx(roots(free_with_spring, 3), rel=1e-3)


@pytest.mark.parametrize("k", [1e12, 2e13, 1e15])
def test_a_root_on_springs_is_a_beam_on_two_of_them(k):
    lifts, turns = k * B * 2e-3, k * B * 2e-3**3 / 12

    def on_springs(x):
        a = x / L
        rows = np.array(
            [
                [-RIGIDITY * a**2, -turns * a, RIGIDITY * a**2, -turns * a],
                [lifts, -RIGIDITY * a**3, lifts, RIGIDITY * a**3],
                [-np.cos(x), -np.sin(x), np.cosh(x), np.sinh(x)],
                [np.sin(x), -np.cos(x), np.sinh(x), np.cosh(x)],
            ]
        )
        return np.linalg.det(rows / np.abs(rows).max(axis=1, keepdims=True))

    # The very soft one's first modes are of the springs: the first found is the first there is.
    assert frequencies(BARE, "clamp_compliance", [k])[:2] == pytest.approx(roots(on_springs, 2), rel=1e-5)


def test_a_rubbing_root_loses_what_its_springs_hold():
    plate = widened_system_of(SANDWICH, SANDWICH.parts())
    effect = CATALOGUE["clamp_friction"].standing_on(SANDWICH)
    K = effect.change(plate.take(effect.spans), np.array([2e13, 0.2])).K
    assert K.imag == pytest.approx(0.2 * K.real)


def test_another_free_length_is_another_beam():
    longer = [m.frequency_hz for m in small_modes(replace(SANDWICH, length_m=L + 2e-3), LAW, 3)]
    assert frequencies(SANDWICH, "clamp_line", [2e-3, 0.0], law=LAW) == pytest.approx(longer, rel=1e-5)


def test_a_mount_that_bites_elsewhere_makes_both_halves_longer():
    halves = replace(SANDWICH, boundary="centre-driven", length_m=2 * L)
    longer = [m.frequency_hz for m in small_modes(replace(halves, length_m=2 * (L + 2e-3)), LAW, 3)]
    assert frequencies(halves, "clamp_line", [2e-3, 0.0], law=LAW) == pytest.approx(longer, rel=1e-5)


@pytest.mark.parametrize(
    ("name", "scale", "layer", "number"),
    [
        ("core_thickness", 1.1, "core", "thickness_m"),
        ("substrate_stiffness", 1.1, "substrate", "young_pa"),
        ("constraining_stiffness", 0.9, "constraining", "young_pa"),
        ("constraining_thickness", 1.05, "constraining", "thickness_m"),
        ("substrate_thickness", 0.9, "substrate", "thickness_m"),
        ("layer_density", 1.3, "substrate", "density_kg_m3"),
    ],
)
def test_a_factor_on_a_number_is_a_beam_that_has_it(name, scale, layer, number):
    own = getattr(SANDWICH, layer)
    other = replace(SANDWICH, **{layer: replace(own, **{number: scale * getattr(own, number)})})
    expected = [m.frequency_hz for m in small_modes(other, LAW, 3)]
    effect = CATALOGUE[name].standing_on(SANDWICH)
    assert isinstance(effect, NumberOffEffect)
    assert frequencies(SANDWICH, name, [scale, SUBSTRATE], law=LAW) == pytest.approx(expected, rel=1e-5)
    said = {"scale": scale, "layer": SUBSTRATE}
    assert effect.story(said) == CATALOGUE[name].story(said)


def test_nothing_moved_is_nothing_changed():
    change = changed_by_numbers(widened_system_of(SANDWICH, SANDWICH.parts()), {})
    assert not any(np.any(part) for part in (change.K, change.K_1, change.M, change.load))


def test_still_air_is_a_cylinder_of_it_about_the_width():
    lowered = frequencies(BARE, "air_added_mass", [1.2, 0.0])
    own = [m.frequency_hz for m in small_modes(BARE, None, 3)]
    share = 1.2 * np.pi / 4 * B**2 / PER_LENGTH
    assert lowered == pytest.approx([f / np.sqrt(1 + share) for f in own], rel=1e-6)


def test_a_loose_strip_softens_it_less_near_a_clamp_that_lets_no_layer_slip():
    own = small_modes(SANDWICH, STIFF, 1)[0].frequency_hz
    effect = next(f for f in CATALOGUE["partial_debond"].standing_on(SANDWICH).variants() if not f.at_edge)
    plate = widened_system_of(SANDWICH, SANDWICH.parts()).take(effect.spans)
    found = []
    for start in (0.02, 0.16):
        K_1 = effect.change(plate, np.array([start, 0.03])).K_1
        found.append(elastic_modes(replace(plate, K_1=plate.K_1 + K_1), STIFF, 1)[0].frequency_hz)
    assert found[1] < found[0] < own


def test_what_needs_a_base_a_clamp_or_one_piece_stands_where_they_are():
    def names(beam):
        return {n for n, e in CATALOGUE.items() if e.standing_on(beam) is not None}

    shaken = names(SANDWICH)
    assert {"added_mass", "tether", "clamp_compliance", "clamp_line", "base_rocking", "graded_core"} <= shaken
    assert not shaken & {"uneven_clamp", "base_roll", "orthotropic_substrate", "viscous_damping"}
    free = names(replace(SANDWICH, boundary="free-free", force_m=0.02))
    assert shaken - free == {
        *("absolute_velocity", "base_rocking", "fixture_resonance", "level_error"),
        *("clamp_compliance", "clamp_friction", "clamp_line", "treatment_not_gripped"),
    }
    halves = names(replace(SANDWICH, boundary="centre-driven"))
    assert shaken - halves == {"added_mass", "loose_part", "tether"}
    oberst = names(replace(SANDWICH, constraining=None))
    assert shaken - oberst == {
        *("constraining_stiffness", "constraining_thickness", "treatment_not_gripped"),
        *("partial_debond", "graded_core"),
    }
    both = names(replace(SANDWICH, both_sides=True))
    assert shaken - both == {"partial_debond", "graded_core"}


@pytest.mark.parametrize("both_sides", [False, True])
def test_a_treatment_let_go_at_the_clamp_softens_the_first_mode_and_one_held_fast_does_not(both_sides):
    beam = replace(SANDWICH, both_sides=both_sides)
    own = small_modes(beam, LAW, 1)[0].frequency_hz
    loose, fast = (frequencies(beam, "treatment_not_gripped", [k], 1, LAW)[0] for k in (1e6, 1e12))
    assert fast == pytest.approx(own, rel=1e-3)
    assert loose < 0.95 * own
