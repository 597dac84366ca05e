"""The treated plate on its shaker: drive pieces in, what the sensors would see out, exact between changes.

u = A sin(w t + phase) is the real part of U e^{i w t} with the phasor U = A e^{i (phase - pi/2)}.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from drivers.arrays import Array
from drivers.simulated.climate import Climate
from drivers.simulated.drive import DrivePiece
from drivers.simulated.plant.diagonal import Diagonal, diagonalised
from drivers.simulated.plant.effects import Effects, FixtureResonance
from drivers.simulated.plant.law import MaxwellLaw
from drivers.simulated.plant.model import ReducedModel
from drivers.simulated.plant.motion import Motion
from drivers.simulated.plant.mounted import Mounted
from drivers.simulated.plant.one_thread import one_thread
from drivers.simulated.plant.sandwich import sandwich
from drivers.simulated.plant.shaker import ShakerChain
from drivers.simulated.plant.slow_change import SlowChange
from drivers.simulated.plant.structure import Structure, condensed, first_order

OUTPUTS = ("base_acceleration", "base_velocity", "base_displacement", "spot_velocity", "tip_displacement")
"""m/s^2, m/s, m; absolute velocity of the plate at the spot, m/s; tip relative to the base, m."""
LEAST_MOVE = 5e-4
"""Of the core's modulus, relative, before the system is tuned again."""
CHECK_EVERY_S = 0.05


@dataclass(frozen=True)
class _Base:
    """Base motion in the states w_k x_k, x_k' of the shaker and w0 theta, theta' of the fixture."""

    A: Array
    b: Array
    displacement: Array
    velocity: Array
    acceleration: Array
    pitch_rate: Array
    pitch_acceleration: Array
    feed: Array
    """Acceleration and pitch acceleration straight from the volts. Shape (2,)."""


def _base(shaker: ShakerChain, rocking_rad_m: float, fixture: FixtureResonance | None) -> _Base:
    A, b = shaker.first_order()
    n, extra = len(shaker.sections), 2 if fixture else 0
    A, b = np.pad(A, (0, extra)), np.pad(b, (0, extra))
    displacement, velocity = np.zeros(2 * n + extra), np.zeros(2 * n + extra)
    displacement[:n], velocity[n : 2 * n] = [1 / k.omega for k in shaker.sections], 1
    feed = velocity @ b
    rate, pitching, pitch_feed = (
        rocking_rad_m * velocity,
        rocking_rad_m * (velocity @ A),
        rocking_rad_m * feed,
    )
    if fixture:
        w0 = 2 * np.pi * fixture.frequency_hz
        A[-2, -1], A[-1, -2], A[-1, -1] = w0, -w0, -2 * fixture.damping_ratio * w0
        A[-1] += fixture.gain_rad_m * w0**2 * displacement
        rate[-1] += 1
        pitching = pitching + A[-1]
    return _Base(A, b, displacement, velocity, velocity @ A, rate, pitching, np.array([feed, pitch_feed]))


class ShakenPlate:
    """One run: starts at rest at time zero of the sample clock; times never go back beyond the memory."""

    def __init__(
        self,
        effects: Effects | None = None,
        shaker: ShakerChain | None = None,
        memory_s: float = 1.0,
        model: ReducedModel | None = None,
        climate: Climate | None = None,
        mounted: Mounted | None = None,
    ) -> None:
        """`mounted` takes the place of the plate."""
        self.effects, self.shaker = effects or Effects(), shaker or ShakerChain()
        self.plate = mounted or sandwich(self.effects, model)
        self._slow = SlowChange(self.plate.core_law, self.effects, climate)
        self._in_chamber = climate is not None
        rocking, fixture = self.effects.base_rocking, self.effects.fixture_resonance
        self._structure, _ = condensed(self.plate.structure, self._slow.extremes())
        self._base = _base(self.shaker, rocking.pitch_rad_m if rocking else 0.0, fixture)
        harmonics = (self.shaker.second_harmonic, self.shaker.third_harmonic)
        self._law = self._slow.law(0.0)
        self._motion = Motion(self._system(self._law), harmonics, memory_s)
        self._piece = DrivePiece(0.0, 1.0, 0.0, 0.0, 0.0)
        self._checks = 0

    @property
    def law(self) -> MaxwellLaw:
        """Of the core, as it is now; where it rests in a chamber, as it was when last driven."""
        return self._law

    @property
    def structure(self) -> Structure:
        """The condensed plate with the law as it is now."""
        return self._structure.with_laws(self._law)

    def poles(self) -> NDArray[np.complex128]:
        """Of the whole chain, in rad/s, as it is now. Shape (n,)."""
        return self._motion.system.poles

    @one_thread
    def drive(self, piece: DrivePiece) -> None:
        """The drive from `piece.begin_s` on. A time before the last change is refused (ValueError)."""
        self._advance(piece.begin_s)
        if self._rests:
            self._tune(piece.begin_s)
        self._motion.drive(piece)
        self._piece = piece

    @one_thread
    def at(self, first_time_s: float, step_s: float, count: int, outputs: tuple[str, ...] = OUTPUTS) -> Array:
        """Outputs by name at `count` uniform times. Shape (outputs, count)."""
        self._advance(first_time_s + step_s * (count - 1))
        return self._motion.at(first_time_s, step_s, count, outputs)

    def steady_state(self, frequency_hz: float) -> dict[str, complex]:
        """Phasors per volt at the fundamental, as the law is now; `core_strain` is a real amplitude."""
        s = 2j * np.pi * frequency_hz
        found = self._motion.system.transfer(s)
        out = {name: complex(y) for name, y in zip(self._motion.system.names, found, strict=True)}
        return out | {"core_strain": complex(self.core_strain(frequency_hz, 1.0))}

    def core_strain(self, frequency_hz: float, amplitude_v: float) -> float:
        """Steady amplitude of the core's shear strain, rms over its volume."""
        system, s = self._motion.system, 2j * np.pi * frequency_hz
        q = system.from_modal[: len(self._structure.M)] @ (system.b / (s - system.poles))
        square = (q.conj() @ self._structure.branches[0].K @ q).real / self.plate.core_volume_m3
        return float(abs(amplitude_v) * np.sqrt(max(float(square), 0.0)))

    def _advance(self, until_s: float) -> None:
        """Slow changes at multiples of CHECK_EVERY_S, whatever the pieces in which time is asked for."""
        while self._slow.any and (self._checks + 1) * CHECK_EVERY_S <= until_s:
            self._checks += 1
            now_s = self._checks * CHECK_EVERY_S
            amplitude_v = self._piece.amplitude_at(now_s)
            self._slow.follow(self.core_strain(self._piece.frequency_hz, amplitude_v), CHECK_EVERY_S)
            if not self._rests:
                self._tune(now_s)

    @property
    def _rests(self) -> bool:
        """Undriven in a chamber: an hour of soaking is not worth tuning a plate for that does not move."""
        return self._in_chamber and not self._piece.amplitude_v and not self._piece.slope_v_s

    def _tune(self, now_s: float) -> None:
        law = self._slow.law(now_s)
        if self._slow.moved(self._law, law) > LEAST_MOVE:
            self._law = law
            self._motion.retune(now_s, self._system(law))

    def _system(self, law: MaxwellLaw) -> Diagonal:
        """The chain from volts to outputs. Physical states: the plate's, the shaker's, the fixture's."""
        plate, base = self._structure.with_laws(law), self._base
        A_p, B_p, scale_p = first_order(plate)
        n, m, total = len(plate.M), len(A_p), len(A_p) + len(base.A)
        A, scale = np.zeros((total, total)), np.eye(total)
        A[:m, :m], A[m:, m:] = A_p, base.A
        A[:m, m:] = B_p @ np.array([base.acceleration, base.pitch_acceleration])
        scale[:m, :m] = scale_p
        C = np.zeros((len(OUTPUTS), total))
        spot, tip = plate.readings
        C[0, m:], C[1, m:], C[2, m:] = base.acceleration, base.velocity, base.displacement
        C[3, n : 2 * n], C[3, m:] = spot, base.velocity + self.plate.spot_x_m * base.pitch_rate
        C[4, :n] = tip
        b = np.concatenate([B_p @ base.feed, base.b])
        d = np.array([base.feed[0], 0, 0, 0, 0])
        return diagonalised(A, b, np.asarray(np.linalg.solve(scale.T, C.T).T), d, scale, OUTPUTS)
