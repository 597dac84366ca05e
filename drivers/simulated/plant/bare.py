"""The bare plate under a hammer: half a period of (1 - cos) of force at a point, acceleration at another."""

from dataclasses import dataclass

import numpy as np

from drivers.arrays import Array
from drivers.simulated.plant import grid, specimen
from drivers.simulated.plant.diagonal import Diagonal, diagonalised
from drivers.simulated.plant.effects import Effects
from drivers.simulated.plant.model import ReducedModel, shipped
from drivers.simulated.plant.motion import Motion, Tone
from drivers.simulated.plant.one_thread import one_thread
from drivers.simulated.plant.sandwich import clamp
from drivers.simulated.plant.structure import Structure, first_order, modal_damping

OUTPUTS = ("force", "acceleration", "velocity")
"""N on the plate along +w; m/s^2 and m/s of the plate where it is read."""
OTHER_RATIO = 0.001
"""Damping of the modes above the eighth, as a fraction of critical."""


@dataclass(frozen=True)
class Pulse:
    """One blow: peak (1 - cos(2 pi t / width)) / 2."""

    begin_s: float
    width_s: float
    """0.1 to 5 ms."""
    peak_n: float

    def tones(self, time_s: float) -> tuple[Tone, ...]:
        """What of it acts from a time on, none outside its width."""
        if not self.begin_s <= time_s < self.begin_s + self.width_s:
            return ()
        omega = 2 * np.pi / self.width_s
        half = 0.5 * self.peak_n
        phase = omega * (time_s - self.begin_s) + np.pi / 2
        return (Tone(half, 0.0, 0.0, np.pi / 2), Tone(-half, 0.0, omega, phase))


@one_thread
def bare_structure(
    effects: Effects,
    hit_m: tuple[float, float],
    response_m: tuple[float, float],
    sensor_kg: float,
    model: ReducedModel | None = None,
) -> Structure:
    """The bare plate with a sensor. Effects heeded: clamp, substrate stiffness, air, viscous damping."""
    model = model or shipped("bare")
    springs = clamp(effects, model)
    n = len(model["M_substrate"]) if springs else model.rigid_count
    K = (effects.substrate_stiffness.scale if effects.substrate_stiffness else 1.0) * model["K_substrate"][
        :n, :n
    ]
    M = model["M_substrate"][:n, :n]
    if effects.air_added_mass:
        M = M + effects.air_added_mass.density_kg_m3 * model["M_air"][:n, :n]
    held = K + sum((b.law.modulus(0.0).real * b.K for b in springs), np.zeros((n, n)))
    ratios = np.full(n, OTHER_RATIO)
    ratios[:8] = specimen.BARE_MODAL_RATIOS
    ratios *= effects.viscous_damping.scale if effects.viscous_damping else 1.0
    C = modal_damping(M, held, ratios)
    hit, response = (grid.on_plate(*at) @ model["w_top"][:, :n] for at in (hit_m, response_m))
    M = M + sensor_kg * np.outer(response, response)
    return Structure(M, C, K, springs, hit[:, None], response[None])


class StruckPlate:
    """One run: starts at rest at time zero of the sample clock."""

    def __init__(
        self,
        hit_m: tuple[float, float],
        response_m: tuple[float, float],
        sensor_kg: float = 0.0,
        effects: Effects | None = None,
        memory_s: float = 1.0,
        model: ReducedModel | None = None,
        structure: Structure | None = None,
    ) -> None:
        """`structure` takes the place of the plate."""
        structure = structure or bare_structure(effects or Effects(), hit_m, response_m, sensor_kg, model)
        self.structure = structure.projected(np.linalg.inv(np.linalg.cholesky(structure.M)).T)
        self._motion = Motion(self._system(), memory_s=memory_s)
        self._pulses: list[Pulse] = []

    def _system(self) -> Diagonal:
        plate = self.structure
        A, B, scale = first_order(plate)
        n = len(plate.M)
        C = np.zeros((3, len(A)))
        C[1] = plate.readings[0] @ A[n : 2 * n]
        C[2, n : 2 * n] = plate.readings[0]
        d = np.array([1.0, plate.readings[0] @ plate.loads[:, 0], 0.0])
        return diagonalised(A, B[:, 0], C, d, scale, OUTPUTS)

    def modes(self, count: int = 8) -> tuple[Array, Array]:
        """Natural frequencies in Hz (of the poles' modulus) and damping ratios, the sensor on the plate.

        Shape (count,) each, or fewer.
        """
        poles = self._motion.system.poles
        poles = poles[poles.imag > 0]
        poles = poles[np.argsort(np.abs(poles))][:count]
        return np.abs(poles) / (2 * np.pi), -poles.real / np.abs(poles)

    @one_thread
    def strike(self, pulse: Pulse) -> None:
        """One more blow, not before the last change (ValueError). Blows may overlap."""
        self._pulses.append(pulse)
        edges = {p.begin_s for p in self._pulses} | {p.begin_s + p.width_s for p in self._pulses}
        self._motion.take_back(pulse.begin_s)
        for edge_s in sorted(e for e in edges if e >= pulse.begin_s):
            tones = [tone for p in self._pulses for tone in p.tones(edge_s)]
            self._motion.excite(edge_s, tuple(tones))

    @one_thread
    def at(
        self, first_time_s: float, step_s: float, count: int, outputs: tuple[str, ...] = OUTPUTS[:2]
    ) -> Array:
        """Outputs by name at `count` uniform times. Shape (outputs, count)."""
        return self._motion.at(first_time_s, step_s, count, outputs)

    def accelerance(self, frequency_hz: float) -> complex:
        """Acceleration per force."""
        return complex(self._motion.system.transfer(2j * np.pi * frequency_hz)[1])

    def mobility(self, frequency_hz: float) -> complex:
        """Velocity per force."""
        return complex(self._motion.system.transfer(2j * np.pi * frequency_hz)[2])
