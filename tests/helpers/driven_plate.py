"""A plate driven by its base or at a point, reduced and widened, beside its full solves."""

import numpy as np
import scipy.sparse as sp

from fitting.diagnosis.problem.base import DiagnosisProblem
from fitting.diagnosis.response.sweep_response import SweepResponse
from fitting.dynamics.damping import viscous_damping
from fitting.dynamics.direct import solve_direct
from fitting.effects.added_mass import PointMass
from fitting.effects.amplitude_softening import CoreStrain
from fitting.plate.plate import Plate
from fitting.reduced.domain import domain_of
from fitting.reduced.rational import rational_sweep
from fitting.reduced.reduced_plate import reduce_plate
from fitting.sweep import Sweep
from fitting.widened.enriching import enriched
from fitting.widened.full_plate import FullPlate

F_HZ = np.array([31.0, 58.0, 104.0, 161.0, 247.0])
OMEGA = 2 * np.pi * F_HZ


class Driven:
    """A plate reduced and widened for a mass."""

    def __init__(self, specimen):
        self.specimen, self.plate = specimen, Plate(specimen)
        self.damping = viscous_damping(self.plate)
        self.reduced = reduce_plate(self.plate, self.damping, domain_of(specimen, F_HZ))
        full = FullPlate(self.plate, self.damping)
        self.widened = enriched(full, self.plate.carried @ self.reduced.V, [PointMass(), CoreStrain()])
        self.law = specimen.core.law
        self.G = self.law.modulus(OMEGA)

    def full(self, mass_kg=0.0, at=(0.1, 0.1)):
        row = self.plate.observe(*at)
        load = self.plate.load - (mass_kg * row if self.specimen.drive == "base" else 0.0)
        added = sp.csc_array(mass_kg * np.outer(row, row))
        return np.array(
            [
                self.plate.pickup
                @ solve_direct(
                    sp.csc_array(self.plate.dynamic_stiffness(w, g) - w**2 * added),
                    w,
                    self.damping,
                    load[:, None],
                )[:, 0]
                for w, g in zip(OMEGA, self.G, strict=True)
            ]
        )

    def response(self, effects, force_n=None):
        ones = np.ones(len(OMEGA))
        sweep = Sweep(F_HZ, ones + 0j, ones, np.arange(len(OMEGA)), np.ones(len(OMEGA), int), force_n)
        problem = DiagnosisProblem.of(
            sweep, self.specimen, self.widened, lambda omega: rational_sweep(self.reduced, omega)
        )
        return SweepResponse(problem.around(self.law), effects)
