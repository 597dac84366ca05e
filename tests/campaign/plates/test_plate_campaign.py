"""The campaign on many plates: its solid, its cases, what a specimen may know and its files."""

from dataclasses import replace

import numpy as np
import pytest
import scipy.sparse as sp
from coarse_solid import COARSE, MODULI, P2

from campaign.law import TrueLaw
from campaign.plates import cases, kept, simulate
from campaign.plates.cases import NONE, PAIR, draw_case
from campaign.plates.channel import ChannelError
from campaign.plates.geometry import PLATES, plate_named
from campaign.plates.grid import Fineness
from campaign.plates.hidden import HIDDEN, STRANGE
from campaign.plates.hidden.attached import (
    HiddenAddedMass,
    HiddenAirAddedMass,
    HiddenLoosePart,
)
from campaign.plates.hidden.base import Setting
from campaign.plates.hidden.core import HiddenAmplitudeSoftening
from campaign.plates.hidden.layers import HiddenMissingPiece
from campaign.plates.materials import KINDS as LAWS
from campaign.plates.materials import LOSS, STORAGE_PA, draw_law
from campaign.plates.reduced import reduced
from campaign.plates.response import BaseMotion, Shaken, remaining_damping
from campaign.plates.schedule import Schedule
from campaign.plates.simulate import built, moduli_of, reading
from campaign.plates.solid import Build, RootSprings, Solid, factorised
from campaign.plates.stated import CAREFUL, draw_stated, specimen_from, toml
from fitting.dynamics.real_modes import real_modes
from fitting.plate.plate import Plate

LAW = TrueLaw("fractional-zener", (0.4e6, 8e6, 2e-4, 0.7))

pytestmark = pytest.mark.usefixtures("coarse_plates")


def few_points():
    f = np.concatenate([np.linspace(18, 28, 8), np.linspace(110, 140, 8), np.linspace(300, 350, 8)])
    segment = np.repeat([1, 2, 3], 8)
    return Schedule(f, segment, segment, np.ones(24), np.arange(24.0))


def setting(plate=P2):
    return Setting(plate, (23.0, 120.0, 325.0), 600.0)


def test_the_solid_of_an_exact_clean_case_has_the_frequencies_of_the_fits_own_plate():
    plate = plate_named("P1")
    specimen = specimen_from(toml(plate, None, 100.0))
    omega = real_modes(Plate(replace(specimen, elements=(24, 16))), 1e6, 5).omega
    solid = reduced(Solid(plate, None, Fineness(9, 6)), (1e6,), modes=6)
    lam, phi = solid.modes(1e6, 5)
    even = np.abs(phi.T @ solid.load[:, 0]) > 1e-6
    assert even.sum() >= 3
    assert np.abs(omega / np.sqrt(lam) - 1)[even].max() < 3e-3


def test_thin_bricks_do_not_lock():
    """A coarse solid is within 0.3 % of a finer one in what the base excites."""
    coarse, finer = (
        np.sqrt(reduced(Solid(P2.bare, None, mesh), modes=4).modes(0.0, 3)[0])
        for mesh in (COARSE, Fineness(10, 8))
    )
    assert np.abs(coarse / finer - 1).max() < 3e-3


def test_a_rigid_motion_of_a_free_solid_costs_nothing():
    """The assumed strain keeps the energy of stretching and turning as a whole: none."""
    solid = Solid(plate_named("P7"), Build(), COARSE)
    K = solid.K_0 + 1e6 * solid.K_1
    stiffness = np.einsum("ij,ij->j", solid.rigid, K @ solid.rigid)
    stretched = np.abs(K.diagonal()).max()
    assert np.abs(stiffness).max() < 1e-9 * stretched


def test_the_reduced_plate_answers_as_the_whole_solid_does():
    solid = Solid(P2, None, COARSE)
    plate, free = kept.clean_plate(P2), solid.free
    for f, G in ((20.0, 0.3e6 * (1 + 0.5j)), (330.0, 2e6 * (1 + 1j))):
        omega = 2 * np.pi * f
        Z = (solid.K_0 + G * solid.K_1 - omega**2 * solid.M)[free][:, free]
        full = factorised(sp.csr_array(Z.astype(complex))).solve(
            -(solid.M @ solid.rigid)[free].astype(complex)
        )
        wanted = (solid.displacement(*P2.spot_m)[:, free] @ full).ravel()
        q = np.linalg.solve(plate.K_0 + G * plate.whole_core - omega**2 * plate.M, -plate.load)
        assert np.abs(plate.reading(*P2.spot_m) @ q / wanted - 1)[:2].max() < 1e-3


def test_a_patch_weighs_what_it_weighs_and_air_makes_heavier():
    solid = Solid(P2, HiddenAddedMass(0.01, 0.2, 0.1, 0.01).build(Build(), P2), COARSE)
    bare = Solid(P2, None, COARSE)
    heave = solid.rigid[:, 0]
    assert heave @ (solid.M - bare.M) @ heave == pytest.approx(0.01)
    air = HiddenAirAddedMass(1.2)
    in_air = built(P2, (air,), MODULI, COARSE)
    assert in_air.modes(1e6, 1)[0][0] < kept.clean_plate(P2).modes(1e6, 1)[0][0]


def clean_reading(hidden, schedule, channel):
    """Without noise."""
    plate = built(P2, hidden, moduli_of(LAW, schedule.frequency_hz), COARSE)
    return reading(plate, P2, hidden, LAW, schedule, channel)


def test_a_loose_part_far_below_its_resonance_is_a_mass():
    schedule, channel = few_points(), ChannelError()
    part = HiddenLoosePart(0.004, 1e5, 0.0, 0.25, 0.05, 0.0)
    mass = HiddenAddedMass(0.004, 0.25, 0.05, 1e-4)
    hung, laid = (clean_reading((h,), schedule, channel) for h in (part, mass))
    assert np.abs(hung / laid - 1).max() < 2e-3


def test_a_corner_that_is_gone_takes_its_mass_and_leaves_the_plate_its_modes():
    side = 0.03
    layers = (P2.substrate, P2.core, P2.constraining)
    gone = side**2 * sum(k.thickness_m * k.density_kg_m3 for k in layers)
    chipped = HiddenMissingPiece(side)
    solids = [Solid(P2, b, COARSE) for b in (Build(), chipped.build(Build(), P2))]
    whole, rest = (float(s.rigid[:, 0] @ s.M @ s.rigid[:, 0]) for s in solids)
    assert whole - rest == pytest.approx((1 - chipped.left) * gone, rel=1e-6)
    before, after = (reduced(s, MODULI).modes(1e6, 3)[0] for s in solids)
    # A cantilever's free end is mass alone: without a piece of it the first mode is faster.
    assert 0 < after[0] / before[0] - 1 < 0.1
    assert np.abs(after / before - 1).max() < 0.1


def test_a_stiff_clamp_is_a_rigid_one():
    springs = RootSprings(lambda y: np.full(y.shape, 1e18), lambda y: np.full(y.shape, 1e18))
    soft = reduced(Solid(P2, Build(root=springs), COARSE), MODULI).modes(1e6, 3)[0]
    assert np.abs(soft / kept.clean_plate(P2).modes(1e6, 3)[0] - 1).max() < 1e-3


def test_softening_settles_brick_by_brick():
    schedule, soft = few_points(), HiddenAmplitudeSoftening(0.15, 0.5)
    plate = built(P2, (soft,), MODULI, COARSE)
    shaken = Shaken(
        plate,
        remaining_damping(plate, np.array(P2.ratios)),
        2 * np.pi * schedule.frequency_hz,
        BaseMotion.pure(24),
    )
    G = LAW.modulus(shaken.omega)
    row = plate.reading(*P2.spot_m)
    q = simulate.softened(shaken, G, soft, schedule) @ row
    faint = simulate.softened(shaken, G, soft, replace(schedule, level_g=np.full(24, 1e-6))) @ row
    linear = shaken.displacements(G) @ row
    assert np.abs(faint / linear - 1).max() < 1e-4
    assert np.abs(q / linear - 1)[:8].max() > 0.03


@pytest.mark.parametrize("name", [n for n in HIDDEN if not HIDDEN[n].changes_solid])
def test_an_effect_of_base_or_channels_shows(name):
    schedule, channel = few_points(), ChannelError()
    effect = HIDDEN[name].draw(np.random.default_rng(1), setting())
    seen, clean = (clean_reading(h, effect.paused(schedule), channel) for h in ((effect,), ()))
    off_axis = name == "base_roll"
    assert off_axis or np.abs(seen / clean - 1).max() > 2e-3


@pytest.mark.parametrize("name", list(HIDDEN))
def test_severities_are_plain_facts_and_come_back(name):
    effect = HIDDEN[name].draw(np.random.default_rng(3), setting())
    assert HIDDEN[name](**effect.facts) == effect


@pytest.mark.parametrize("kind", LAWS)
def test_laws_keep_within_the_campaigns_limits(kind):
    law = draw_law(np.random.default_rng(5), (15.0, 400.0), kind)
    G = law.modulus(2 * np.pi * np.geomspace(15, 400, 9))
    assert STORAGE_PA[0] < G.real.min()
    assert G.real.max() < STORAGE_PA[1]
    assert LOSS[0] < (G.imag / G.real).min()
    assert (G.imag / G.real).max() < LOSS[1]


def test_geometries_are_of_the_wanted_kinds():
    assert len(PLATES) >= 8
    for plate in PLATES:
        assert 0.149 < plate.length_m < 0.401
        assert 1.2 <= plate.length_m / plate.width_m < 2.2
        assert 0 < plate.spot_m[0] < plate.length_m


def test_what_is_stated_scatters_about_the_truth_as_its_tolerances_say():
    rng = np.random.default_rng(0)
    stated = [draw_stated(rng, P2) for _ in range(400)]
    young = np.log([s.substrate.young_pa / P2.substrate.young_pa for s in stated])
    lengths = [s.length_m - P2.length_m for s in stated]
    assert np.std(young) == pytest.approx(CAREFUL.young, rel=0.1)
    assert np.std(lengths) == pytest.approx(CAREFUL.length_m, rel=0.1)


def test_a_case_is_the_same_again_and_its_specimen_hides_the_truth():
    case, again = (draw_case(NONE, 4, plate="P2") for _ in range(2))
    np.testing.assert_array_equal(case.sweep.velocity_m_s, again.sweep.velocity_m_s)
    assert case.specimen == again.specimen
    assert not case.specimen.exact
    assert case.specimen.tolerances["substrate_young"] == pytest.approx(0.01)
    assert case.specimen.length_m != P2.length_m
    other = draw_case(NONE, 5, plate="P2")
    assert len(other.sweep) != len(case.sweep) or other.specimen != case.specimen


def test_an_exact_case_states_the_truth_of_the_same_sweep():
    case, stated = draw_case(NONE, 4, exact=True, plate="P2"), draw_case(NONE, 4, plate="P2")
    assert case.specimen.exact
    assert case.specimen.length_m == pytest.approx(P2.length_m)
    assert case.truth.law == stated.truth.law
    np.testing.assert_array_equal(case.sweep.frequency_hz, stated.sweep.frequency_hz)


def test_a_pair_comes_from_two_places_of_the_catalogue():
    names = {cases.names_of(PAIR, np.random.default_rng(k)) for k in range(20)}
    for first, second in names:
        assert HIDDEN[first].place != HIDDEN[second].place
        assert not {first, second} & set(STRANGE)


def test_an_unknown_kind_is_refused():
    with pytest.raises(ValueError, match="expected one of"):
        draw_case("gremlins", 1)
