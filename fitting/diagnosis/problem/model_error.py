"""What the model gets wrong, as changes of the response of known size, marginalised in every fit.

Of each resonance of a segment: itself a little off, its damping, and how much is read of it; and what the
instruments read wrongly (`channel_error`). Sizes are the specimen's own (`fitting.discrepancy.model_error`).
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array, Complex
from fitting.diagnosis.problem.base import DiagnosisProblem
from fitting.diagnosis.problem.channel_error import blow_rows, channel_rows
from fitting.diagnosis.problem.narrow_resonances import shapes_of
from fitting.diagnosis.problem.plate_alone import plate_alone
from fitting.diagnosis.problem.plate_answer import Asked, motions
from fitting.discrepancy.model_error import GAIN, STRUCK_GAIN, model_error_at
from fitting.laws import CoreLaw
from fitting.reduced.reduced_plate import ReducedPlate
from fitting.reduced.resonance_parts import Answers, Part, parts_of
from fitting.specimen import PlateSpecimen, StatedSpecimen
from fitting.widened.change import Change

_ALIKE = 1e-3
"""Of a frequency, within which resonances of two files of one plate are the same one."""
_SAME_SHAPE = 0.7
"""Of phi^T M psi, from which two modes are one."""
COMMON = "theory"
"""Kind of the one cause by which all resonances of a plate are off, each in the sense that exact elasticity
says."""


@dataclass(frozen=True)
class OwnErrors:
    """What the theory of a plate gets wrong, and what its channels do. One standard deviation a row."""

    keys: tuple[tuple[float, str], ...]
    """Of each row of `of_plate`: the resonance's frequency in Hz, and what of it is off."""
    of_plate: Complex
    """Shape (rows, points)."""
    of_channels: Complex
    """Gains of every part among them: a plate is not read alike at two spots. Shape (any, points)."""


def model_error(problem: DiagnosisProblem, reduced: ReducedPlate | None, law: CoreLaw, v: Complex) -> Complex:
    """Changes of the velocity `v`, one standard deviation each. Shape (nuisances, points).

    `reduced` is the plate's; None for what knows its own error.
    """
    own = problem.model_error(law, v)
    if own is not None:
        return own
    assert reduced is not None
    found = own_errors(problem, reduced, law, v)
    return np.concatenate([found.of_plate, found.of_channels])


def own_errors(problem: DiagnosisProblem, reduced: ReducedPlate, law: CoreLaw, v: Complex) -> OwnErrors:
    """The same of a plate, its theory's apart from its channels'. Shape of `v` (points,).

    Where the problem's plate is condensed to laws like this one, that serves.
    """
    assert isinstance(problem.specimen, PlateSpecimen)
    omega, index = np.unique(problem.points.omega, return_inverse=True)
    answers = _answers(problem, reduced, omega, law.modulus(omega))

    def velocity(x: Complex) -> Complex:
        return np.asarray((1j * omega * x)[index.ravel()] * problem.points.drive_amplitude)

    keys: list[tuple[float, str]] = [(0.0, COMMON)]
    common, rows, channels = np.zeros(len(v), complex), [], []
    for number in np.unique(problem.sweep.segment):
        inside = problem.sweep.segment == number
        f = problem.sweep.frequency_hz[inside]
        parts = parts_of(answers, law, float(f.min()), float(f.max()))
        beside = shapes_of(problem.nuisances.narrow, problem.plate.take([]), answers, law, f)
        middle = np.array([p.frequency_hz for p in parts])
        size = model_error_at(problem.specimen, middle, law.modulus(2 * np.pi * middle))
        for k, part in enumerate(parts):
            left = _of_others(answers, part, parts, beside) if beside else part.by_frequency
            if left is None:
                continue
            dv = velocity(left)
            # d ln f = 1/2 d ln K, and a loss is the imaginary part of ln K.
            by_loss = 0.5j * float(size.modal_loss[k]) * dv
            keys += [(part.frequency_hz, "frequency"), (part.frequency_hz, "loss")]
            rows += [size.frequency[k] * dv * inside, size.loss[k] * by_loss * inside]
            f_off, loss_off = (float(one[k]) for one in size.signed)
            common += (f_off * dv + loss_off * by_loss) * inside
        each = [velocity(p.displacement) for p in parts[:-1]]
        # The rest has the base's motion too, where the laser reads it.
        gains = [*each, v - sum(each, np.zeros(len(v)))]
        gain = STRUCK_GAIN if len(parts) > 1 and problem.specimen.drive == "force" else GAIN
        channels += channel_rows(
            problem.sweep, inside, v, has_phase=problem.points.has_phase, parts=gains, gain=gain
        )
    if problem.specimen.drive == "force":
        channels += list(blow_rows(problem.sweep.frequency_hz, v))
    return OwnErrors(tuple(keys), np.array([common, *rows]), np.array(channels))


def _of_others(answers: Answers, part: Part, parts: list[Part], beside: list[Array]) -> Complex | None:
    """Derivative of a part to ln f of all resonances in it but those `beside`, whose places the fit finds.

    None where there are no others. Shape (points,), of each shape (k,).
    """

    def same(y: Array, other: Array) -> bool:
        return bool(abs(y @ answers.M @ other) > _SAME_SHAPE)

    if len(parts) > 1 and part.shape is not None:
        return None if any(same(y, part.shape) for y in beside) else part.by_frequency
    apart = [p.shape for p in parts if p.shape is not None] if len(parts) > 1 else []
    known = [answers.by_frequency(y) for y in beside if not any(same(y, other) for other in apart)]
    return np.asarray(part.by_frequency - sum(known))


class OfOnePlate:
    """Errors of plates' theories, file by file: a resonance of one plate is off alike in all its files."""

    def __init__(self, points: int) -> None:
        self._points = points
        self._known: list[tuple[StatedSpecimen, float, str, Complex]] = []

    def add(self, specimen: PlateSpecimen, part: slice | NDArray[np.intp], found: OwnErrors) -> None:
        """Those of a file, whose points are `part` of all; of shape (points of all,) where it is no slice."""
        its = plate_alone(specimen)
        before = [(k, one) for k, one in enumerate(self._known) if one[0] == its]
        for (f, kind), row in zip(found.keys, found.of_plate, strict=True):
            same = [k for k, (_, g, of, _) in before if of == kind and abs(f - g) <= _ALIKE * max(f, g)]
            if same:
                into = self._known[min(same, key=lambda k: abs(self._known[k][1] - f))][3]
            else:
                into = np.zeros(self._points, complex)
                self._known.append((its, f, kind, into))
            into[part] += row

    @property
    def rows(self) -> Complex:
        """Shape (any, points)."""
        return np.array([row for *_, row in self._known]).reshape(-1, self._points)


def _answers(problem: DiagnosisProblem, reduced: ReducedPlate, omega: Array, G: Complex) -> Answers:
    """Of the plate without any effect, its stated numbers where they were found.

    Shape (frequencies,) of `omega` and `G`.
    """
    if not len(problem.plate.shares) and problem.found is None and not problem.nuisances.narrow:
        return reduced.answers(omega, G)
    # Half as many columns: a third of the time, and 1e-6 off.
    plate = problem.plate.take([])
    by = Change() if problem.found is None else problem.nuisances.change(plate, problem.found)
    (moved,) = motions([Asked(plate, omega, G, by, None, with_pitch=False)])
    own = plate.K_0 + by.K, plate.K_1 + by.K_1, plate.M + by.M, plate.observe + by.observe
    return Answers(*own, moved.q, moved.z, G)
