"""Which resonances of a plate or a beam are narrow in some data, and the structure that can move them."""

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from fitting.arrays import Array, Complex
from fitting.diagnosis.problem.plate_poles import PLAIN
from fitting.discrepancy.model_error import ModelError
from fitting.laws import CoreLaw
from fitting.nuisances.narrow import NARROW, NarrowResonance, NarrowResonances
from fitting.reduced.resonance_parts import Moving, RealMode, modes_between
from fitting.sweep import Sweep
from fitting.widened.enriched_plate import EnrichedReducedPlate

BESIDE = 1.5
"""Of a segment's ends, within which resonances beside it count. A choice: between two of them little is read,
and where each lies says how much."""
_ALIKE = 0.7
"""Of phi^T M psi, from which two modes are one: the law has moved by a little since."""

Errs = Callable[[Array, Complex], ModelError]
"""What the theory gets wrong at some frequencies in Hz, the modulus there given. Shape (points,) each."""


def narrow_of(
    errs: Errs, plate: EnrichedReducedPlate, sweeps: Sequence[Sweep], law: CoreLaw
) -> tuple[NarrowResonances, EnrichedReducedPlate]:
    """Those in or beside a segment of some sweeps, under a law, and the structure with what moves them."""
    own = plate.take([])
    found: dict[int, tuple[NarrowResonance, Array]] = {}
    for sweep in sweeps:
        for number in np.unique(sweep.segment):
            f = sweep.frequency_hz[sweep.segment == number]
            for mode in modes_between(own, law, float(f.min()) / BESIDE, float(f.max()) * BESIDE):
                one = _narrow(errs, own, mode, law)
                if one is not None:
                    found.setdefault(mode.number, (one, 2 * np.pi * mode.frequency_hz * mode.shape))
    each = [found[number] for number in sorted(found)]
    return NarrowResonances(tuple(one for one, _ in each)), with_sides(plate, [y for _, y in each])


def with_sides(plate: EnrichedReducedPlate, each: Sequence[Array]) -> EnrichedReducedPlate:
    """A plate with the sides s = omega M phi that move some of its modes; `each` is omega phi, shape (k,)."""
    shapes = np.zeros((len(plate.load), len(each)))
    if each:
        shapes[plate.group == PLAIN] = np.array(each).T
    return replace(plate, U=np.hstack([plate.U, plate.M @ shapes]), d=np.append(plate.d, np.zeros(len(each))))


def _narrow(errs: Errs, plate: EnrichedReducedPlate, mode: RealMode, law: CoreLaw) -> NarrowResonance | None:
    """A mode as one whose place is a number of the fit; None where it is wide enough."""
    f = np.array([mode.frequency_hz])
    size = errs(f, law.modulus(2 * np.pi * f))
    by_itself, (by_theory, loss_by_theory) = size.frequency[0], size.in_common
    if 2 * np.hypot(by_itself, by_theory) < NARROW * loss_of(plate, mode, law):
        return None
    own = float(size.modal_loss[0])
    return NarrowResonance(
        number=mode.number + 1,
        frequency_hz=mode.frequency_hz,
        by_itself=float(by_itself),
        by_theory=by_theory,
        loss=own,
        loss_by_itself=own * float(size.loss[0]),
        loss_by_theory=own * loss_by_theory,
    )


def loss_of(plate: EnrichedReducedPlate, mode: RealMode, law: CoreLaw) -> float:
    """Loss factor of a mode of a plate on its own columns, the core's and the faces'."""
    omega, y = 2 * np.pi * mode.frequency_hz, mode.shape
    (G,) = law.modulus(np.array([omega]))
    stiffness = y @ plate.K_0 @ y + G * (y @ plate.K_1 @ y)
    return float((stiffness.imag + omega * (y @ plate.viscous() @ y)) / stiffness.real)


def shapes_of(
    narrow: NarrowResonances, plate: EnrichedReducedPlate, moving: Moving, law: CoreLaw, band_hz: Array
) -> list[Array]:
    """Of modes in a band and beside it, those of a plate's narrow ones. Shape (k,) each.

    `plate` is on its own columns and `moving` is like it, its stated numbers where they may be.
    """
    if not narrow.each:
        return []
    sides = plate.U[:, -len(narrow) :]
    omega = 2 * np.pi * np.array([one.frequency_hz for one in narrow.each])
    near = modes_between(moving, law, float(band_hz.min()) / (2 * BESIDE), float(band_hz.max()) * 2 * BESIDE)
    return [m.shape for m in near if np.any(np.abs(m.shape @ sides) > _ALIKE * omega)]
