"""What the model gets wrong, as changes of the response of known size, marginalised in every fit.

Of each segment: its resonances a little off, their damping, and what the instruments read wrongly
(`channel_error`). Sizes are the specimen's own (`fitting.model_error`).
"""

import numpy as np

from fitting.arrays import Array, Complex
from fitting.diagnosis.channel_error import channel_rows
from fitting.diagnosis.plate_answer import Asked, motions
from fitting.diagnosis.problem import DiagnosisProblem
from fitting.effects.change import Change
from fitting.laws import CoreLaw
from fitting.model_error import model_error_at
from fitting.reduced import ReducedPlate
from fitting.specimen import Specimen


def model_error(problem: DiagnosisProblem, reduced: ReducedPlate | None, law: CoreLaw, v: Complex) -> Complex:
    """Changes of the velocity `v`, one standard deviation each. Shape (nuisances, points).

    `reduced` is the plate's; None for what knows its own error. Where the task's plate is condensed to laws
    like this one, that serves.
    """
    own = problem.model_error(law, v)
    if own is not None:
        return own
    assert reduced is not None
    assert isinstance(problem.specimen, Specimen)
    omega, index = np.unique(problem.points.omega, return_inverse=True)
    dx = _by_frequency(problem, reduced, omega, law.modulus(omega))
    dv = (1j * omega * dx)[index.ravel()] * problem.points.acceleration_m_s2
    rows = []
    for number in np.unique(problem.sweep.segment):
        inside = problem.sweep.segment == number
        f = problem.sweep.frequency_hz[inside]
        middle = np.array([np.sqrt(f.min() * f.max())])
        size = model_error_at(problem.specimen, middle, law.modulus(2 * np.pi * middle))
        # d ln f = 1/2 d ln K, and a loss is the imaginary part of ln K.
        by_loss = 0.5j * float(size.modal_loss[0]) * dv
        rows += [size.frequency[0] * dv * inside, size.loss[0] * by_loss * inside]
        rows += channel_rows(problem.sweep, inside, v, has_phase=problem.points.has_phase)
    return np.array(rows)


def _by_frequency(problem: DiagnosisProblem, reduced: ReducedPlate, omega: Array, G: Complex) -> Complex:
    """Derivative of the displacement to the logarithm of all natural frequencies. Shape (points,)."""
    if not len(problem.plate.shares):
        return reduced.by_frequency(omega, G)
    # Half as many columns: a third of the time, and 1e-6 off.
    asked = Asked(problem.plate.take([]), omega, G, Change(), None, with_pitch=False)
    (moved,) = motions([asked])
    K_0, K_1 = asked.matrices[:2]
    return np.asarray(-2 * (moved.z * (moved.q @ K_0.T + G[:, None] * (moved.q @ K_1.T))).sum(axis=1))
