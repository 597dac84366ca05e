"""What the rig would read without noise: a solid beam with its effects, moved and seen as it really is."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache, reduce

import numpy as np
from scipy.linalg import eigh

from campaign.beams.geometry import TrueBeam
from campaign.beams.hidden import HiddenInBeam
from campaign.beams.hidden.core import HiddenAmplitudeSoftening
from campaign.law import TrueLaw
from campaign.plates.channel import ChannelError
from campaign.plates.schedule import Resonance
from campaign.schedule import Schedule
from drivers.simulated.plant.beam_basis import BeamOnBasis, Place, on_basis
from drivers.simulated.plant.one_thread import one_thread
from drivers.simulated.plant.solid_beam import PIECES, BeamBuild, SolidBeam
from fitting.arrays import Array, Complex
from fitting.gravity import PUBLISHED_G_M_S2

_MODULI_PA = np.geomspace(0.1e6, 10e6, 5)
"""That the basis is made at, of a soft core."""
_SPOT, _FORCE, _HUNG = 0, 1, 2
"""Places of the basis in their order."""
_RIGID_HZ = 3.0
_SETTLED, _MOST_STEPS = 1e-6, 30
_RELAXED, _SOFTENED, _MOST_ROUNDS = 0.8, 1e-6, 200


@dataclass(frozen=True)
class BuiltBeam:
    """A beam with its effects, on few motions."""

    true: TrueBeam
    """Its sizes with them."""
    basis: BeamOnBasis
    hidden: tuple[HiddenInBeam, ...] = ()

    @property
    def M(self) -> Array:
        """With air. Shape (n, n)."""
        return self.basis.M + sum(h.air_kg_m3 for h in self.hidden) * self.basis.M_air

    @property
    def load(self) -> Array:
        """M times heave and pitch. Shape (n, 2)."""
        return self.basis.load + sum(h.air_kg_m3 for h in self.hidden) * self.basis.load_air

    @property
    def elastic(self) -> Complex:
        """Faces and root. Shape (n, n)."""
        loss = sum(h.root_loss for h in self.hidden)
        return self.basis.K_faces.sum(axis=0) + (1 + 1j * loss) * self.basis.K_root

    def modulus(self, law: TrueLaw, omega: Array | float) -> Complex:
        """Of the core; shape of `omega`."""
        return self.true.stiffer * law.modulus(omega)


@one_thread
def built(true: TrueBeam, hidden: Sequence[HiddenInBeam] = (), pieces: int | None = None) -> BuiltBeam:
    """A beam with its effects, in a second or two; without any from memory."""
    pieces = pieces or PIECES
    if not hidden:
        return _clean(true, pieces)
    build = reduce(lambda b, h: h.build(b, true), hidden, BeamBuild())
    beam = reduce(lambda t, h: h.beam(t), hidden, true)
    return _built(beam, build, tuple(hidden), pieces)


@lru_cache(maxsize=16)
def _clean(true: TrueBeam, pieces: int) -> BuiltBeam:
    return _built(true, BeamBuild(), (), pieces)


def _built(true: TrueBeam, build: BeamBuild, hidden: tuple[HiddenInBeam, ...], pieces: int) -> BuiltBeam:
    struck = Place(true.force_m if true.force_m is not None else true.spot_m, below=True)
    places = [Place(true.spot_m), struck, *(Place(x) for h in hidden for x in h.places_m())]
    strips = max((h.strips for h in hidden), default=1)
    with_air = any(h.air_kg_m3 for h in hidden)
    solid = SolidBeam(true.solid, pieces, build)
    basis = on_basis(solid, true.stiffer * _MODULI_PA, places, strips, with_air=with_air)
    return BuiltBeam(true, basis, hidden)


@one_thread
def reading(
    beam: BuiltBeam, law: TrueLaw, schedule: Schedule, channel: ChannelError | None = None
) -> Complex:
    """Velocity per acceleration of the base, or per newton, at every point. Shape (points,)."""
    channel = channel or ChannelError()
    omega, basis, force = 2 * np.pi * schedule.frequency_hz, beam.basis, beam.true.force_m is not None
    pitch = sum((h.pitch(omega) for h in beam.hidden), np.zeros(len(omega), complex))
    moves = np.stack([np.ones_like(pitch), pitch], axis=1)
    loads = np.asarray(-(moves @ beam.load.T), complex)
    if force:
        loads = np.tile(basis.w[_FORCE].astype(complex), (len(omega), 1))
    Z: Complex = np.asarray(beam.elastic - omega[:, None, None] ** 2 * beam.M, complex)
    hung = [each for h in beam.hidden for each in h.hung(omega, pitch, force)]
    for each, row in zip(hung, basis.w[_HUNG:], strict=True):
        Z = Z + each.stiffness_n_m[:, None, None] * np.outer(row, row)
        loads = loads + each.force_n[:, None] * row
    q = _displacements(beam, Z, loads, _modulus(beam, law, schedule), schedule)
    v = 1j * omega * (q @ basis.w[_SPOT])
    if not force:
        # What the base itself moves by at the spot, beyond what the laser rides with.
        rides = 1.0 if beam.true.reads == "relative" else 0.0
        v = v + (1 - rides + beam.true.spot_m * pitch) / (1j * omega)
    v = v * channel.factor(omega)
    for h in beam.hidden:
        v = v / h.reference(omega)
    return np.asarray(v)


def _modulus(beam: BuiltBeam, law: TrueLaw, schedule: Schedule) -> Complex:
    """At each point as warm as the core is. Shape (points,)."""
    omega = 2 * np.pi * schedule.frequency_hz
    factors = [h.frequency_factor(schedule.time_s) for h in beam.hidden]
    return beam.modulus(law, reduce(lambda w, f: w if f is None else w * f, factors, omega))


def _displacements(beam: BuiltBeam, Z: Complex, loads: Complex, G: Complex, schedule: Schedule) -> Complex:
    """Relative motion. Shape (points, n). Raises `ArithmeticError` where softening does not settle."""
    K = beam.basis.K_core

    def moved(factor: Complex) -> Complex:
        core = np.tensordot(factor, K, axes=1)
        return np.asarray(np.linalg.solve(Z + G[:, None, None] * core, loads[:, :, None])[:, :, 0])

    factor = np.ones((len(G), len(K)), complex)
    q = moved(factor)
    soft = next((h for h in beam.hidden if isinstance(h, HiddenAmplitudeSoftening)), None)
    if soft is None:
        return q
    first = schedule.segment == schedule.segment.min()
    reference = float(np.sqrt((_strains(beam, q[first]) ** 2).mean(axis=1)).max())
    for _ in range(_MOST_ROUNDS):
        goal = soft.factor(_strains(beam, q) * schedule.level_g[:, None], reference)
        step = goal - factor
        if np.abs(step).max() < _SOFTENED:
            return q
        factor = factor + _RELAXED * step
        q = moved(factor)
    raise ArithmeticError(f"softening k = {soft.k:g} finds no steady state: use a smaller k")


def _strains(beam: BuiltBeam, q: Complex) -> Array:
    """Amplitude of each strip of the core by its energy. Shape (points, strips)."""
    t, K = beam.true, beam.basis.K_core
    volume = t.length_m * t.width_m * t.core.thickness_m * (2 if t.both_sides else 1) / len(K)
    energy = np.einsum("pi,sij,pj->ps", q.conj(), K, q).real
    return np.asarray(np.sqrt(np.maximum(energy / volume, 0.0)))


@one_thread
def resonances(beam: BuiltBeam, law: TrueLaw, below_hz: float = np.inf) -> list[Resonance]:
    """Resonances that the drive excites, in ascending order, the core's modulus taken at each frequency."""
    basis, whole = beam.basis, beam.basis.K_core.sum(axis=0)
    push = basis.w[_FORCE] if beam.true.force_m is not None else beam.load[:, 0]
    M, found = beam.M, []
    first = 3 if not beam.true.clamped else 0
    for r in range(first, first + 6):
        omega = 2 * np.pi * 100.0
        for _ in range(_MOST_STEPS):
            G = complex(beam.modulus(law, omega))
            squared, phi = eigh(beam.elastic.real + G.real * whole, M, subset_by_index=[0, r])
            last, omega = omega, float(np.sqrt(max(squared[r], (2 * np.pi * _RIGID_HZ) ** 2)))
            if abs(omega / last - 1) < _SETTLED:
                break
        shape = phi[:, r]
        eta = G.imag * float(shape @ whole @ shape) / omega**2
        seen = abs(float(basis.w[_SPOT] @ shape) * float(push @ shape)) / (eta * omega)
        if omega < 2 * np.pi * below_hz:
            found.append(Resonance(omega / (2 * np.pi), eta, seen))
    return found


def level_unit(true: TrueBeam) -> float:
    """What level one is: 1 g of the base in m/s^2, or a newton."""
    return PUBLISHED_G_M_S2 if true.force_m is None else 1.0
