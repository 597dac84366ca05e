"""What the theory of a small structure gets wrong, as changes of its response of known size.

Its resonances lie a little elsewhere and are damped a little otherwise, each by itself: another one about
every octave. What its width does is one number for all of them. It is read, and driven, on one of two faces
that move apart, nobody says which, and in the middle of a width that bends.
"""

from dataclasses import replace
from itertools import product

import numpy as np

from fitting.arrays import Array, Complex
from fitting.diagnosis.problem.narrow_resonances import shapes_of
from fitting.dynamics.dynamic_stiffness import dynamic_stiffness, stacked
from fitting.laws import CoreLaw
from fitting.nuisances.narrow import NONE, NarrowResonances
from fitting.reduced.resonance_parts import Answers
from fitting.structures.small import SmallSpecimen, SmallSystem, displacement
from fitting.widened.enriched_plate import EnrichedReducedPlate

OCTAVE = 0.7
"""In ln f."""
_H = 1e-4
"""Relative step of differences."""


def theory_rows(
    specimen: SmallSpecimen,
    system: SmallSystem,
    omega: Array,
    law: CoreLaw,
    drive: Array,
    narrow: NarrowResonances = NONE,
) -> list[Complex]:
    """Changes of the velocity, one standard deviation each; `drive` is what drives it, at every point.

    Where `narrow` resonances lie, and how lossy they are, are numbers of the fit. Shape (points,) each.
    """
    error = specimen.theory_error(omega / (2 * np.pi), law.modulus(omega))
    if error is None:
        return []
    own, G = system.take([]), law.modulus(omega)
    x = displacement(own, omega, G)
    per_x = 1j * omega * drive
    stiffer = displacement(replace(own, K_0=(1 + _H) * own.K_0), omega, (1 + _H) * G)
    # d ln f = 1/2 d ln K, and a loss is the imaginary part of ln K.
    dv = per_x * (stiffer - x) / (_H / 2)
    if narrow:
        answers = _answers(own, omega, G)
        known = shapes_of(narrow, own, answers, law, omega / (2 * np.pi))
        dv = dv - per_x * sum(answers.by_frequency(y) for y in known)
    by_loss = 0.5j * error.modal_loss * dv
    shares = octaves(omega)
    rows = [error.frequency * share * dv for share in shares]
    rows += [shift * dv for shift in error.together]
    rows += [error.loss * share * by_loss for share in shares]
    return rows + [per_x * displacement(side, omega, G) for side in _read_otherwise(system, own)]


def _answers(own: EnrichedReducedPlate, omega: Array, G: Complex) -> Answers:
    """To its load and to a unit force where it is read."""
    A = dynamic_stiffness(stacked(own.K_0, own.K_1, own.M, own.viscous()), omega, G)
    sides = np.stack([own.load, own.observe], axis=1).astype(complex)
    q, z = np.moveaxis(np.linalg.solve(A, np.broadcast_to(sides, (len(omega), *sides.shape))), 2, 0)
    return Answers(own.K_0, own.K_1, own.M, own.observe, q, z, G)


def _read_otherwise(system: SmallSystem, own: EnrichedReducedPlate) -> list[EnrichedReducedPlate]:
    """Itself, read or driven by what a place may move beside what the theory has, one standard deviation."""
    found = []
    for why, name in product(("apart", "middle"), ("observe", "load")):
        if f"{why}.{name}" in system.vector_names:
            row = system.vector(f"{why}.{name}")[system.group == "plate"]
            found.append(replace(own, **{name: row}))
    return found


def octaves(omega: Array) -> Array:
    """Hats over ln f, that add up to one. Shape (hats, points)."""
    t = np.log(omega)
    at = np.linspace(t.min(), t.max(), 2 + int(np.ptp(t) / OCTAVE))
    if at[-1] == at[0]:
        return np.ones((1, len(t)))
    return np.maximum(0, 1 - np.abs(t - at[:, None]) / (at[1] - at[0]))
