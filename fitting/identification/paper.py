"""Identification as the paper does it: Eq. (20) to (25), on its real-mode response.

Residuals are relative to the measured value and parameters to their own, so that the printed weights
are numbers of one size. Eq. (25) stands with the second W_x and dx = theory - experiment.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares

from fitting.arrays import Array, Complex
from fitting.dynamics.real_mode_response import RealModePlate
from fitting.errors import TooFewPoints
from fitting.identification.fit import Fit
from fitting.identification.model import velocity
from fitting.laws import CoreLaw
from fitting.specimen import Reading
from fitting.sweep import Sweep, resonance_points

STEP = 1e-4
"""Delta b over b in Eq. (20)."""
WEIGHT_AT_RESONANCE = 0.2
"""As printed, of the points at each resonance."""
WEIGHT_ELSEWHERE = 0.06
"""As printed."""
WEIGHT_OF_PARAMETERS = 0.25
"""As printed: the diagonal of W_b."""
CRITERION = 0.05
"""Largest relative difference at which the paper stops."""
MOST_STEPS = 1000
"""A bound: Table 5 comes to rest in 292 (docs/paper.md)."""
PLAIN_STEPS = 60
"""So many steps are exactly the printed ones; later every `_HURRY_EVERY`-th is extrapolated."""
_HURRY_EVERY = 10
"""Steps between two extrapolations: their ratio has to settle first. A choice."""
_LARGEST_STEP = 0.5
"""Relative change of a parameter in one step, at most. A choice."""
_MOST_EVALUATIONS = 100
"""Of a fit to other data from where the iteration has come to rest. A bound on time."""
_SMALLEST_STEP = 1e-6
"""Relative change of every parameter at which the iteration has come to rest."""


@dataclass(frozen=True)
class PaperProblem:
    """Theory and experiment at the sweep's points, amplitudes only."""

    sweep: Sweep
    plate: RealModePlate
    reads: Reading
    weight: Array
    """Diagonal of W_x. Shape (points,)."""

    @classmethod
    def of(cls, sweep: Sweep, plate: RealModePlate, reads: Reading) -> "PaperProblem":
        """W_x from the file's weights where it gives them, else the printed ones."""
        printed = np.where(resonance_points(sweep), WEIGHT_AT_RESONANCE, WEIGHT_ELSEWHERE)
        return cls(sweep, plate, reads, printed if sweep.weight is None else sweep.weight)

    def velocity(self, laws: list[CoreLaw]) -> Complex:
        """Theory of several laws at once, in m/s. Shape (laws, points)."""
        omega = np.tile(self.sweep.omega, len(laws))
        G = np.concatenate([law.modulus(self.sweep.omega) for law in laws])
        v = velocity(omega, self.plate.displacement(omega, G), self.reads)
        return np.asarray(v.reshape(len(laws), -1) * self.sweep.commanded_m_s2)

    def linearise(self, law: CoreLaw) -> tuple[Array, Array]:
        """The dx relative to the measured values and S to the parameters' own size: Eq. (20), (21), (23b).

        Shapes (points,) and (points, parameters).
        """
        b = law.values
        # A step up would leave the limits where a parameter sits at its upper one.
        upper = np.array([q.upper for q in law.limits])
        step = np.where(b * (1 + STEP) > upper, -STEP, STEP)
        stepped = [law.with_values(b * (1 + step * (np.arange(len(b)) == k))) for k in range(len(b))]
        theory = np.abs(self.velocity([law, *stepped]))
        measured = np.abs(self.sweep.response_m_s)
        S = (theory[1:] - theory[0]) / step[:, None] / measured
        return (theory[0] - measured) / measured, S.T

    def take(self, points: NDArray[np.intp] | NDArray[np.bool_]) -> "PaperProblem":
        """Some of the points, their weights kept. Numbers or shape (points,), true or false."""
        return PaperProblem(self.sweep.take(points), self.plate, self.reads, self.weight[points])


def fit_paper(
    problem: PaperProblem, start: CoreLaw, progress: Callable[[int], None] = lambda step: None
) -> Fit:
    """Iterate Eq. (25) until the 5 % criterion is met or the parameters come to rest.

    Raises `TooFewPoints` for one point, or a law without parameters.
    """
    if not start.names:
        raise TooFewPoints(f"core law {start.kind} has no parameter to identify, choose another law")
    if len(problem.sweep) < 2:
        raise TooFewPoints(f"1 point cannot carry {len(start.names)} parameters, expected more than that")
    start = start.lifted()
    W_x = problem.weight[:, None]
    W_b = WEIGHT_OF_PARAMETERS * np.eye(len(start.names))
    change: Array = np.zeros(len(start.names))
    law, steps, met, stands = start, 0, False, False
    while True:
        dx, S = problem.linearise(law)
        met = bool(np.max(np.abs(dx)) < CRITERION)
        if met or stands or steps == MOST_STEPS:
            break
        before = change
        change = _change(W_x * S, W_b, W_x[:, 0] * dx)
        stands = bool(np.max(np.abs(change)) < _SMALLEST_STEP)
        steps += 1
        hurry = steps > PLAIN_STEPS and steps % _HURRY_EVERY == 0
        law = _stepped(law, _extrapolated(change, before) if hurry else change)
        progress(steps)
    return Fit(
        law=law,
        residuals=problem.weight * dx,
        jacobian=W_x * S,
        velocity_m_s=problem.velocity([law])[0],
        iterations=steps,
        evaluations=(steps + 1) * (1 + len(start.names)),
        converged=met or stands,
        weights=problem.weight,
        criterion_met=met,
    )


def _change(WS: Array, W_b: Array, Wdx: Array) -> Array:
    """The relative change of the parameters in Eq. (25), before its sign."""
    solved: NDArray[Any] = np.linalg.solve(WS.T @ WS + W_b.T @ W_b, WS.T @ Wdx)
    return solved


def _extrapolated(change: Array, before: Array) -> Array:
    """Aitken's sum of all further steps, where they shrink along one slow direction.

    W_b makes Eq. (25) creep along what the data hardly fix: thousands of steps to the same rest.
    """
    ratio = float(change @ before / (before @ before))
    return change / (1 - ratio) if 0 < ratio < 1 else change


def refit(problem: PaperProblem, start: CoreLaw) -> CoreLaw:
    """Where Eq. (25) comes to rest on other data: the least of |W_x dx|, found without its small steps."""
    lower, upper = start.log_limits

    def residuals(logs: Array) -> Array:
        return problem.weight * problem.linearise(start.with_logs(logs))[0]

    def jacobian(logs: Array) -> Array:
        return problem.weight[:, None] * problem.linearise(start.with_logs(logs))[1]

    found = least_squares(
        residuals,
        np.clip(np.log(start.values), lower, upper),
        jac=jacobian,
        bounds=(lower, upper),
        x_scale="jac",
        max_nfev=_MOST_EVALUATIONS,
    )
    return start.with_logs(found.x)


def _stepped(law: CoreLaw, change: Array) -> CoreLaw:
    """Parameters b (1 - change), kept within the limits and at most halved or raised by half."""
    return law.with_logs(np.log(law.values * (1 - np.clip(change, -_LARGEST_STEP, _LARGEST_STEP))))
