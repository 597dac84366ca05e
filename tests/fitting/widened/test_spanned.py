"""The widened reduced plate beside full solves on every degree of freedom, effect by effect."""

import pickle
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
import scipy.sparse as sp
import scipy.sparse.linalg as sla

from fitting.diagnosis.problem.plate_answer import answer
from fitting.dynamics.damping import viscous_damping
from fitting.effects import CATALOGUE, Change, all_spans
from fitting.effects.base_rocking import BaseRockingEffect
from fitting.effects.clamp_compliance import root_springs
from fitting.effects.clamp_friction import ClampFrictionEffect
from fitting.effects.partial_debond import LEFT, PartialDebondEffect, strips
from fitting.effects.spot_offset import SpotOffsetEffect
from fitting.effects.viscous_damping import ViscousDampingEffect
from fitting.plate.plate import Plate
from fitting.reduced.domain import domain_of
from fitting.reduced.reduced_plate import reduce_plate
from fitting.widened.condensing import Training, condensed
from fitting.widened.enriching import enriched
from fitting.widened.full_plate import FullPlate
from fitting.widened.span import Span
from instrument.files.specimen_file import read_specimen
from instrument.paper_case import case_file

RIGID_N_M3 = 1e17
"""Springs beyond which the root is at rest."""
OMEGA = 2 * np.pi * np.array([19.5, 100.0, 281.0])
G = np.array([0.3e6 * (1 + 0.3j), 0.55e6 * (1 + 0.9j), 1.2e6 * (1 + 1.1j)])
MASS, PLACE = 3e-3, (0.27, 0.06)


class Full:
    """The plate on all degrees of freedom, a coarse mesh."""

    def __init__(self):
        self.specimen = replace(read_specimen(case_file("zn1.toml")), elements=(14, 10))
        self.plate = Plate(self.specimen)
        self.damping = viscous_damping(self.plate)
        self.full = FullPlate(self.plate, self.damping)
        domain = domain_of(self.specimen, np.array([14.0, 300.0]))
        reduced = reduce_plate(self.plate, self.damping, domain)
        self.spanned = enriched(self.full, self.plate.even @ reduced.V, all_spans())

    def direct(self, *, K=0.0, K_1=0.0, M=0.0, load=0.0, row=None, root=None, damping=1.0, pitch=False):
        loose, found = self.full.loose, []
        U, d = self.full.lift @ self.damping.U, self.damping.d * damping
        f = -(loose.M @ (self.full.pitching if pitch else self.full.heave)) + load
        row = loose.observe(*self.full.pickup_m) if row is None else row
        free = np.unique(self.full.lift.indices) if root is None else np.arange(loose.size)
        for w, g in zip(OMEGA, G, strict=True):
            A = loose.K_0 + K + g * (loose.K_1 + K_1) - w**2 * (loose.M + M)
            A = (A + (0 if root is None else root)).tocsc().astype(complex)[free][:, free]
            X = sla.splu(A.tocsc()).solve(np.column_stack([f[free], U[free]]).astype(complex))
            small = np.diag(1 / (1j * w * d)) + U[free].T @ X[:, 1:]
            found.append(row[free] @ (X[:, 0] - X[:, 1:] @ np.linalg.solve(small, U[free].T @ X[:, 0])))
        return np.array(found)

    def reduced(self, effect, u, *, pitch=False):
        plate = self.spanned.take(effect.spans)
        change = effect.change(plate, np.array(u))
        found = answer(plate, OMEGA, G, change, [], with_pitch=pitch)
        return (found.pitch if pitch else found.heave).value


@pytest.fixture(scope="module")
def full():
    return Full()


def error(a, b):
    return float(np.max(np.abs(a / b - 1)))


def test_a_yielding_root_answers_as_the_full_model_on_springs(full):
    S = {axis: root_springs(full.full, axis) for axis in "xyz"}
    for k in (1.2e13, 6e13):
        expected = full.direct(root=k * (S["x"] + S["z"]) + RIGID_N_M3 * S["y"])
        assert error(full.reduced(CATALOGUE["clamp_compliance"], [k]), expected) < 5e-4


def test_a_yielding_root_that_rubs(full):
    S, (k, loss) = {axis: root_springs(full.full, axis) for axis in "xyz"}, (3e13, 0.2)
    expected = full.direct(root=k * (1 + 1j * loss) * (S["x"] + S["z"]) + RIGID_N_M3 * S["y"])
    assert error(full.reduced(ClampFrictionEffect(), [k, loss]), expected) < 5e-4


def test_a_span_that_says_nothing_adds_no_motion(full):
    span, answers = Span(), np.ones((full.full.loose.size, 1))
    at = SimpleNamespace(x=answers[:, 0])
    assert span.forces(full.full, at).shape == (full.full.loose.size, 0)
    assert span.responses(full.full, at, answers) is answers
    assert not span.matrices(full.full)
    assert not span.vectors(full.full)


def test_a_rigid_root_is_the_clamp(full):
    assert error(full.reduced(CATALOGUE["clamp_compliance"], [1e18]), full.direct()) < 1e-5


def test_a_point_mass_off_the_axis(full):
    w = full.full.loose.observe(*PLACE)
    expected = full.direct(M=MASS * sp.csc_array(np.outer(w, w)), load=-MASS * w)
    assert error(full.reduced(CATALOGUE["added_mass"], [MASS, *PLACE]), expected) < 1e-3


@pytest.mark.parametrize("scale", [0.9, 1.08])
def test_another_core_thickness_answers_as_a_plate_built_with_it(full, scale):
    core = replace(full.specimen.core, thickness_m=scale * full.specimen.core.thickness_m)
    other = Plate(replace(full.specimen, core=core, boundary="free"))
    loose = full.full.loose
    expected = full.direct(
        K_1=other.K_1 - loose.K_1, M=other.M - loose.M, load=-((other.M - loose.M) @ full.full.heave)
    )
    assert error(full.reduced(CATALOGUE["core_thickness"], [scale]), expected) < 2e-4


def test_a_stiffer_substrate_answers_as_the_full_model(full):
    expected = full.direct(K=0.05 * full.full.loose.K_substrate)
    assert error(full.reduced(CATALOGUE["substrate_stiffness"], [1.05]), expected) < 1e-4


@pytest.mark.parametrize(("along", "low", "width"), [("x", 0.15, 0.03), ("x", 0.27, 0.03), ("y", 0.09, 0.03)])
def test_a_loose_strip_answers_as_the_full_model_without_its_core(full, along, low, width):
    rows = strips(full.full, along)
    side = full.specimen.length_m if along == "x" else full.specimen.width_m
    edges = np.linspace(0, side, len(rows) + 1)
    share = np.diff(np.clip(edges, low, low + width)) / np.diff(edges)
    lost = sum(s * A for s, A in zip(share, rows, strict=True))
    expected = full.direct(K_1=-(1 - LEFT) * lost)
    assert error(full.reduced(PartialDebondEffect(along), [low, width]), expected) < 2e-3


@pytest.mark.parametrize("along", ["x", "y"])
def test_a_strip_at_an_edge_is_the_one_that_ends_there(full, along):
    side = full.specimen.length_m if along == "x" else full.specimen.width_m
    anywhere, at_edge = PartialDebondEffect(along), PartialDebondEffect(along, at_edge=True)
    plate = full.spanned.take(anywhere.spans)
    for edge, low in ((0.0, 0.0), (side, side - 0.02)):
        expected = anywhere.change(plate, np.array([low, 0.02])).K_1
        assert np.allclose(at_edge.change(plate, np.array([edge, 0.02])).K_1, expected, rtol=1e-9)
        assert at_edge.story({f"{along}_edge": edge, "width": 0.02}) == anywhere.story(
            {f"{along}_from": low, "width": 0.02}
        )


def test_more_viscous_damping_answers_as_the_full_model(full):
    expected = full.direct(damping=2.5)
    assert error(full.reduced(ViscousDampingEffect(), [2.5]), expected) < 1e-6


def test_a_shifted_spot_reads_as_the_full_model_there(full):
    x, y = full.full.pickup_m
    expected = full.direct(row=full.full.loose.observe(x + 8e-3, y - 5e-3))
    assert error(full.reduced(SpotOffsetEffect(), [8e-3, -5e-3]), expected) < 1e-5


def test_a_pitching_base_answers_as_the_full_model(full):
    plate = full.spanned.take(BaseRockingEffect.spans)
    found = answer(plate, OMEGA, G, Change(), [], with_pitch=True).pitch.value
    assert error(found, full.direct(pitch=True)) < 1e-5


def over_sizes(factors):
    return Training(np.tile(OMEGA, len(factors)), np.concatenate([abs(G) * f for f in factors]))


def test_between_what_it_was_condensed_on_a_reading_is_off_by_a_hundred_thousandth(full):
    plate = full.spanned.take([])
    factors = [size * np.exp(1j * angle) for size in (0.25, 0.5, 1, 2, 4) for angle in (0.2, 0.6, 1.0)]
    fewer = condensed(plate, over_sizes(factors))
    random = np.random.default_rng(4)
    for _ in range(5):
        here = abs(G) * random.uniform(0.3, 3) * np.exp(1j * random.uniform(0.2, 1))
        found, expected = (
            answer(p, OMEGA, here, Change(), [], with_pitch=False).heave.value for p in (fewer, plate)
        )
        assert error(found, expected) < 1e-5


def test_condensing_keeps_the_answers_it_was_condensed_on(full):
    plate = full.spanned.take([])
    fewer = condensed(plate, Training(OMEGA, G))
    assert len(fewer.group) < len(plate.group) / 2
    found, expected = (
        answer(p, OMEGA, G, Change(), [], with_pitch=False).heave.value for p in (fewer, plate)
    )
    assert error(found, expected) < 1e-6


def test_a_rough_plate_has_fewer_motions_of_its_own_and_of_an_effects(full):
    factors = [size * np.exp(1j * angle) for size in (0.25, 0.5, 1, 2, 4) for angle in (0.2, 0.6, 1.0)]
    plate = condensed(full.spanned, over_sizes(factors))
    fine = plate.take(CATALOGUE["clamp_compliance"].spans)
    rough = fine.roughly
    assert np.sum(rough.group == "plate") < 0.8 * np.sum(fine.group == "plate")
    assert 0.6 * np.sum(fine.group == "root") < np.sum(rough.group == "root") < np.sum(fine.group == "root")
    soft = CATALOGUE["clamp_compliance"].starts(fine, None)[0]
    found, expected = (
        answer(p, OMEGA, G, CATALOGUE["clamp_compliance"].change(p, soft), [], with_pitch=False).heave.value
        for p in (rough, fine)
    )
    assert 0 < error(found, expected) < 1e-3
    assert rough.roughly is rough
    assert full.spanned.roughly is full.spanned


def test_the_plate_of_the_latest_effects_is_taken_once_and_stays_in_its_process(full):
    plate = replace(full.spanned)
    spans = CATALOGUE["tether"].spans
    taken = plate.take(spans)
    assert plate.take(list(spans)) is taken
    for span in all_spans():
        plate.take([span])
    few = [plate.take([span]) for span in all_spans()[:3]]
    assert len({id(one) for one in few}) == 3
    sent = pickle.loads(pickle.dumps(plate))
    assert len(pickle.dumps(plate)) == len(pickle.dumps(replace(plate)))
    np.testing.assert_array_equal(sent.take(spans).parts, taken.parts)


def test_a_condensed_plate_has_what_the_whole_one_has_along_the_same_motions(full):
    plate = full.spanned
    fewer = condensed(plate, Training(OMEGA, G))
    own = plate.group == "plate"
    count = np.sum(fewer.group == "plate")
    # Its motions, from rows that read them: as many places as it takes to know every column.
    T = np.zeros((len(plate.group), len(fewer.group)))
    T[~own, count:] = np.eye(np.sum(~own))
    read = plate.deflection.reshape(-1, len(own))
    T[own, :count] = np.linalg.lstsq(read[:, own], fewer.deflection.reshape(-1, len(fewer.group)))[0][
        :, :count
    ]
    for name in ("M", "K_0", "K_1", "gram", "matrices", "parts"):
        expected = T.T @ getattr(plate, name) @ T
        np.testing.assert_allclose(getattr(fewer, name), expected, atol=1e-6 * np.abs(expected).max())
    for name in ("load", "pitch", "observe", "vectors", "load_part"):
        expected = getattr(plate, name) @ T
        np.testing.assert_allclose(getattr(fewer, name), expected, atol=1e-6 * np.abs(expected).max())
    np.testing.assert_allclose(fewer.U, T.T @ plate.U, atol=1e-6 * np.abs(plate.U).max())


def test_a_spans_matrices_are_looked_up_once(full):
    plate = full.spanned.take(CATALOGUE["partial_debond"].spans)
    stack = plate.stack("strips_x.")
    assert plate.stack("strips_x.") is stack
    assert np.shares_memory(stack, plate.matrices)
    places = [k for k, name in enumerate(plate.names) if str(name).startswith("strips_x.")]
    np.testing.assert_array_equal(stack, plate.matrices[places])
