"""What the model gets wrong, as changes of the response of known size, marginalised in every fit.

Of each resonance of a segment: itself a little off, its damping, and how much is read of it; and what the
instruments read wrongly (`channel_error`). Sizes are the specimen's own (`fitting.model_error`).
"""

import numpy as np

from fitting.arrays import Array, Complex
from fitting.diagnosis.channel_error import channel_rows
from fitting.diagnosis.plate_answer import Asked, motions
from fitting.diagnosis.problem import DiagnosisProblem
from fitting.effects.change import Change
from fitting.laws import CoreLaw
from fitting.model_error import GAIN, STRUCK_GAIN, model_error_at
from fitting.reduced import ReducedPlate
from fitting.resonance_parts import Answers, parts_of
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
    answers = _answers(problem, reduced, omega, law.modulus(omega))

    def velocity(x: Complex) -> Complex:
        return np.asarray((1j * omega * x)[index.ravel()] * problem.points.acceleration_m_s2)

    rows = []
    for number in np.unique(problem.sweep.segment):
        inside = problem.sweep.segment == number
        f = problem.sweep.frequency_hz[inside]
        parts = parts_of(answers, law, float(f.min()), float(f.max()))
        middle = np.array([p.frequency_hz for p in parts])
        size = model_error_at(problem.specimen, middle, law.modulus(2 * np.pi * middle))
        for k, part in enumerate(parts):
            dv = velocity(part.by_frequency)
            # d ln f = 1/2 d ln K, and a loss is the imaginary part of ln K.
            by_loss = 0.5j * float(size.modal_loss[k]) * dv
            rows += [size.frequency[k] * dv * inside, size.loss[k] * by_loss * inside]
        each = [velocity(p.displacement) for p in parts[:-1]]
        # The rest has the base's motion too, where the laser reads it.
        gains = [*each, v - sum(each, np.zeros(len(v)))]
        gain = STRUCK_GAIN if len(parts) > 1 and problem.specimen.drive == "force" else GAIN
        rows += channel_rows(
            problem.sweep, inside, v, has_phase=problem.points.has_phase, parts=gains, gain=gain
        )
    return np.array(rows)


def _answers(problem: DiagnosisProblem, reduced: ReducedPlate, omega: Array, G: Complex) -> Answers:
    """Of the plate without any effect. Shape (frequencies,) of `omega` and `G`."""
    if not len(problem.plate.shares):
        return reduced.answers(omega, G)
    # Half as many columns: a third of the time, and 1e-6 off.
    plate = problem.plate.take([])
    (moved,) = motions([Asked(plate, omega, G, Change(), None, with_pitch=False)])
    return Answers(plate.K_0, plate.K_1, plate.M, plate.observe, moved.q, moved.z, G)
