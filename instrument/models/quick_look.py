"""Data beside the stated plate before they are fitted: a wrong unit, sign, cable or plate is asked about.

Any core from soft to stiff is tried. Where none comes near, the same is asked of the data with one mistake
taken back; the mistake that explains by far the most is named. Whoever knows better insists.
"""

from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from fitting.arrays import Array, Complex
from fitting.errors import FittingError
from fitting.gravity import STANDARD_GRAVITY_M_S2
from fitting.identification.model import velocity
from fitting.rational import RationalSweep, rational_sweep
from fitting.specimen import Specimen
from fitting.sweep import Sweep
from instrument.models.specimen_models import Models
from instrument.progress import Progress, quiet

NEAR, FAR = 0.55, 1.1
"""Median distance ln(measured/predicted) of the best core: nothing to ask below, another plate above."""
_BETTER = 0.4
"""A mistake taken back has to leave at most this part of the distance."""
_LOWEST_HZ = 1.0
_ENOUGH = 2000
"""Points, spread over the sweep: the median of more is the same one."""
_MODULI, _LOSSES = 25, (0.05, 0.3, 1.0)


class _Mistake(NamedTuple):
    words: str
    taken_back: Callable[[Sweep, Complex], Complex | None]
    """The response as it should have been; None where these data cannot have it."""


def _times(factor: float) -> Callable[[Sweep, Complex], Complex | None]:
    return lambda sweep, v: v * factor


def _by_frequency(power: int) -> Callable[[Sweep, Complex], Complex | None]:
    return lambda sweep, v: v * (2j * np.pi * sweep.frequency_hz) ** power


def _with_phase(change: Callable[[Complex], Complex]) -> Callable[[Sweep, Complex], Complex | None]:
    return lambda sweep, v: change(v) if sweep.has_phase else None


def _uncrossed(sweep: Sweep, v: Complex) -> Complex | None:
    if sweep.base_m_s2 is None:
        return None
    return np.asarray(sweep.base_m_s2 / sweep.velocity_m_s * sweep.commanded_m_s2)


_MISTAKES = (
    _Mistake("the velocity is in mm/s, expected m/s", _times(1e-3)),
    _Mistake("the velocity is in um/s, expected m/s", _times(1e-6)),
    _Mistake("the velocity is 1000 times too small, expected m/s", _times(1e3)),
    _Mistake("the base acceleration is in g, expected m/s^2", _times(1 / STANDARD_GRAVITY_M_S2)),
    _Mistake("level_g is in m/s^2, expected g", _times(STANDARD_GRAVITY_M_S2)),
    _Mistake("displacement stands for velocity, or has to be named so", _by_frequency(1)),
    _Mistake("acceleration stands for velocity, or has to be named so", _by_frequency(-1)),
    _Mistake("the phase is conjugated, expected e^{+i omega t}", _with_phase(np.conj)),
    _Mistake(
        "the sign is turned, expected velocity and base acceleration in one direction",
        _with_phase(np.negative),
    ),
    _Mistake("velocity and base acceleration are swapped: cables, or columns", _uncrossed),
)


def data_doubt(sweep: Sweep, specimen: Specimen, progress: Progress = quiet) -> str:
    """What seems wrong with data of this plate, in a sentence; empty where a core of some kind comes near.

    Raises `FittingError` where the plate cannot be modelled over these frequencies.
    """
    sweep = sweep.thinned(_ENOUGH)
    f = sweep.frequency_hz
    if f.max() < _LOWEST_HZ:
        return f"{f.min():g} to {f.max():g} Hz: the frequencies are in kHz, expected Hz"
    try:
        sums = _sums(specimen, f, progress)
    except FittingError:
        if not _near_in_rad_s(sweep, specimen, progress):
            raise
        return _RAD_S
    response = np.asarray(sweep.response_m_s, dtype=complex)
    as_is = _distance(sweep, response, sums, specimen)
    if as_is < NEAR or _distance(sweep, response, sums, _read_otherwise(specimen)) < NEAR:
        # That the laser reads otherwise than stated is the diagnosis's to say.
        return ""
    taken_back = {
        m.words: _distance(sweep, v, sums, specimen)
        for m in _MISTAKES
        if (v := m.taken_back(sweep, response)) is not None
    }
    words = min(taken_back, key=taken_back.__getitem__)
    if taken_back[words] < min(NEAR, _BETTER * as_is):
        return f"it looks as if {words}"
    if _near_in_rad_s(sweep, specimen, progress):
        return _RAD_S
    if as_is > FAR:
        return (
            f"no core makes this plate answer so (typically {np.exp(as_is):.2g} times off): another plate or "
            "layer, unit, level or pickup"
        )
    return ""


_RAD_S = "it looks as if the frequencies are in rad/s, expected Hz"


def _read_otherwise(specimen: Specimen) -> Specimen:
    return replace(specimen, reads="relative" if specimen.reads == "absolute" else "absolute")


def _near_in_rad_s(sweep: Sweep, specimen: Specimen, progress: Progress) -> bool:
    f = sweep.frequency_hz / (2 * np.pi)
    try:
        sums = _sums(specimen, f, progress)
    except FittingError:
        return False
    return _distance(sweep, np.asarray(sweep.response_m_s, dtype=complex), sums, specimen, f) < NEAR


def _sums(specimen: Specimen, frequency_hz: Array, progress: Progress) -> RationalSweep:
    models = Models.of(specimen, frequency_hz, progress)
    return rational_sweep(models.reduced, 2 * np.pi * frequency_hz)


def _distance(
    sweep: Sweep,
    response: Complex,
    sums: RationalSweep,
    specimen: Specimen,
    frequency_hz: Array | None = None,
) -> float:
    """Median over the points of |ln(measured/predicted)|, of the core that makes it least."""
    omega = 2 * np.pi * (sweep.frequency_hz if frequency_hz is None else frequency_hz)
    low, high = np.log10(np.abs(sums.G_ref)) + np.array([-2.0, 2.0])
    G = np.logspace(low, high, _MODULI)[:, None] * (1 + 1j * np.array(_LOSSES))
    laws = G.reshape(-1, 1) * np.ones(len(omega))
    assert specimen.core is not None
    laws = np.concatenate([laws, specimen.core.law.modulus(omega)[None]])
    v = velocity(omega, sums.displacement(laws), specimen.reads)
    off = np.log(response / (v * sweep.commanded_m_s2))
    size = np.abs(off) if sweep.has_phase else np.abs(off.real)
    return float(np.min(np.median(size, axis=1)))
