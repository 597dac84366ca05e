"""The core of an identification without a law: G* band by band on the plate that was fitted, and causality.

The same data, the same plate, its stated numbers where the joint fit has them; what is common to all bands
is what the fit still does not know of them, and the plate model's own error.
"""

from dataclasses import dataclass

import numpy as np
from threadpoolctl import threadpool_limits

from fitting.arrays import Array, Complex
from fitting.diagnosis.problem.model_error import model_error
from fitting.diagnosis.response.sweep_response import SweepResponse
from fitting.errors import OutsideModel, TooFewPoints
from fitting.identification.kramers_kronig import KramersKronig, kramers_kronig
from fitting.identification.pointwise import PointwiseLaw, phase_is_kept, pointwise_law, velocity_of_sweep
from fitting.identification.pointwise_roots import VelocityOf
from fitting.nuisances.moved_plate import moved_plate
from fitting.reduced.rational import RationalSweep, rational_sweep
from fitting.sweep import Sweep
from instrument.finding.identification import Identified
from instrument.finding.methods import Joint


@dataclass(frozen=True)
class Pointwise:
    """G* band by band, and whether one causal core has it."""

    law: PointwiseLaw
    causal: KramersKronig | None
    why_not: str
    """Why causality could not be judged; empty where it was."""

    @property
    def words(self) -> str:
        """In a sentence or two."""
        determined = int(np.count_nonzero(self.law.determined))
        said = f"band by band, without a law: {determined} of {len(self.law)} bands determined"
        return f"{said}. {self.causal.words if self.causal is not None else self.why_not}"


def pointwise_of(found: Identified) -> Pointwise:
    """A second look at a direct fit.

    Raises `TooFewPoints` for amplitudes, `OutsideModel` without a joint fit.
    """
    phase_is_kept(found.sweep)
    if found.joint is None:
        raise OutsideModel("band by band: the paper's method has no joint fit, expected the direct one")
    if found.joint.begun.problem.nuisances.masses:
        raise OutsideModel("band by band: known masses are put on by the joint fit, expected no [[mass]]")
    with threadpool_limits(1, "blas"):
        law = _law(found, found.joint)
        try:
            return Pointwise(law, kramers_kronig(law), "")
        except TooFewPoints as error:
            return Pointwise(law, None, str(error))


def _law(found: Identified, joint: Joint) -> PointwiseLaw:
    none, problem, sweep = joint.begun.none, joint.begun.problem, found.sweep
    v, dv = SweepResponse(problem, ()).with_derivatives(none.law, none.u)
    n = len(none.law.names)
    rows = model_error(problem, joint.reduced, none.law, v)
    if none.stated:
        assert found.result.fit.posterior is not None
        known = found.result.fit.posterior[n : n + none.stated, n : n + none.stated]
        rows = np.concatenate([_root(known).T @ dv[n : n + none.stated], rows])
    return pointwise_law(sweep, found.result.noise, _velocity_of(joint, sweep), none.law, rows)


def _velocity_of(joint: Joint, sweep: Sweep) -> VelocityOf:
    """What is read of the fitted plate at every point, under any modulus."""
    problem, z = joint.begun.problem, joint.begun.none.z
    plain = velocity_of_sweep(sweep, _rational(joint), problem.specimen.reads)

    def velocity_of(G: Complex) -> tuple[Complex, Complex]:
        v, dv = plain(G)
        # The channel is linear: what it makes of a derivative is the derivative of what it makes.
        return problem.nuisances.reading(v, sweep.omega, z), problem.nuisances.reading(dv, sweep.omega, z)

    return velocity_of


def _rational(joint: Joint) -> RationalSweep:
    problem = joint.begun.problem
    if joint.reduced is None:
        raise OutsideModel("band by band: several were fitted together, expected one plate read at one spot")
    plate = moved_plate(joint.reduced, problem.nuisances, joint.begun.plate, joint.begun.none.z)
    return rational_sweep(plate, np.unique(problem.sweep.omega))


def _root(C: Array) -> Array:
    """L of C = L L^T. Shape of `C`."""
    values, vectors = np.linalg.eigh(C)
    return np.asarray(vectors * np.sqrt(np.maximum(values, 0)))
