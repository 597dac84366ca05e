"""What is held out of a sweep: its segments; of one in a single piece, a stretch about each resonance."""

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array
from fitting.diagnosis.problem.base import DiagnosisProblem
from fitting.digits import written_out
from fitting.identification.validation import MOST_POINTS_ONE_BY_ONE
from fitting.laws import CoreLaw
from fitting.reduced.resonance_parts import modes_between
from fitting.sweep import Sweep

_MOST = 5
"""Stretches: each is a fit more. Of more resonances those closest to each other are held out together."""
_FEW = 3
"""Stretches of a sweep with one resonance, or several in one place: a flank, the rest, the other flank."""
_HARDLY = 0.01
"""Of what the mode moves that is driven and read most: one with less shows nothing. A choice."""
_APART = 1.2
"""Ratio of two resonances from which on they share no flanks with a core's loss factor. A choice."""
_LEAST = 8
"""Points of a stretch: fewer are no resonance. A choice."""


def parts_held_out(problem: DiagnosisProblem, law: CoreLaw) -> NDArray[np.intp]:
    """The number of the part that every point is in, each to be predicted from the others. Shape (points,).

    `law` says where the resonances are.
    """
    segment, f = problem.sweep.segment, problem.sweep.frequency_hz
    if len(np.unique(segment)) > 1:
        return segment
    plate = problem.plate.take([])
    modes = modes_between(plate, law, float(f.min()), float(f.max()))
    shown = np.array([abs(plate.observe @ m.shape) * abs(plate.load @ m.shape) for m in modes])
    resonances = [
        m.frequency_hz for m, size in zip(modes, shown, strict=True) if size > _HARDLY * shown.max()
    ]
    return 1 + np.digitize(f, stretches(f, np.array(resonances)))


def stretches(frequency_hz: Array, resonances_hz: Array) -> Array:
    """Between what frequencies a sweep is cut, ascending. Shapes (points,) and (resonances,), (cuts,)."""
    f, r = np.sort(frequency_hz), np.sort(resonances_hz)
    apart = r[1:] / r[:-1]
    widest = np.argsort(-apart, kind="stable")[: min(_MOST - 1, int(np.sum(apart > _APART)))]
    cuts = np.sort(np.sqrt(r[1:] * r[:-1])[widest])
    if not len(cuts):
        cuts = np.quantile(f, np.arange(1, _FEW) / _FEW)
    kept, last = list[float](), 0
    for cut in cuts:
        place = int(np.searchsorted(f, cut))
        if place - last >= _LEAST and len(f) - place >= _LEAST:
            kept.append(float(cut))
            last = place
    return np.array(kept)


def words_of_stretches(sweep: Sweep, parts: NDArray[np.intp]) -> tuple[str, ...]:
    """That what is held out are no segments of the sweep; empty where they are. Shape (points,)."""
    f, numbers = sweep.frequency_hz, np.unique(parts)
    few = len(sweep) <= MOST_POINTS_ONE_BY_ONE
    if few or len(numbers) < 2 or len(np.unique(sweep.segment)) > 1:
        return ()
    ends = [(written_out(f[parts == k].min(), 3), written_out(f[parts == k].max(), 3)) for k in numbers]
    each = ", ".join(f"{low} to {high}" for low, high in ends)
    return (
        f"the sweep is in one piece: held out as segments {numbers[0]} to {numbers[-1]} are its stretches of "
        f"{each} Hz",
    )
