"""Whether what a fit leaves is random: its size, its signs, its memory along frequency.

Thresholds are those that clean sweeps of a solid plate stay below (`fitting.diagnosis.thresholds`).
"""

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array, Mask
from fitting.data.noise import groups_of
from fitting.diagnosis.inference.evidence import Evidence
from fitting.diagnosis.thresholds import VERDICT
from fitting.digits import two_digits, written_out
from fitting.numerics.chances import chi2_exceeded
from fitting.sweep import Sweep

LAGS = 8
"""Neighbours within a resonance; what goes on for longer shows in the runs. A choice."""
_FEWEST = 20
"""Readings of a trace: the usual rule for the normal limit of the runs test."""


def structure(
    sweep: Sweep,
    evidence: Evidence,
    whitened: Array,
    chi2_per_dof: float,
    kind: str = "plate",
    struck: Mask | None = None,
) -> tuple[str, ...]:
    """What is not random in whitened residuals, in words; nothing where the noise is unknown.

    Shape (data,). `kind` is the specimen's, `struck` as `along_frequency` takes it.
    """
    if not evidence.scale_known:
        return ()
    said = []
    if chi2_per_dof > VERDICT.size:
        said.append(
            f"chi-square per degree of freedom is {written_out(chi2_per_dof, 3)} where noise and model error "
            "leave 1"
        )
    runs, memory = along_frequency(sweep, whitened, 2 if evidence.has_phase else 1, struck=struck)
    if runs > VERDICT.runs_sigma:
        said.append(f"its signs keep together along frequency ({runs:.1f} sigma, runs test)")
    if memory > VERDICT.memory_sigma:
        said.append(f"neighbouring points agree ({memory:.1f} sigma, Ljung-Box over {LAGS} lags)")
    along = evidence.whitening.along(whitened)
    if len(along) and along @ along > chi2_exceeded(VERDICT.bent_by_chance, len(along)):
        times = float(np.sqrt(along @ along / len(along)))
        theory = "a layer-wise plate" if kind == "plate" else "its theory"
        said.append(
            f"the {in_words(kind)} would have to be off by {two_digits(times)} times what {theory} is"
        )
    return tuple(said)


def in_words(kind: str) -> str:
    """A specimen's kind, as sentences have it."""
    return kind.replace("-", " ")


def roughness(sweep: Sweep, whitened: Array, parts: int) -> float:
    """Mean square of what jumps from point to point: noise alone, whatever the model misses smoothly.

    Shape (data,): `parts` times the points.
    """
    jumps = [np.diff(r, 2) for r in _traces(sweep, whitened, parts) if len(r) > 2]
    # The variance of r_1 - 2 r_2 + r_3.
    return float(np.mean(np.concatenate(jumps) ** 2) / 6) if jumps else float("nan")


def along_frequency(
    sweep: Sweep, whitened: Array, parts: int, longest: int | None = None, struck: Mask | None = None
) -> tuple[float, float]:
    """Fewer runs than chance, and Ljung-Box's statistic above its mean, both in standard deviations.

    Of whitened residuals, `parts` of every point one after the other. Shape (data,). What is beyond chance
    grows with the readings, however little they have in common: a trace counts as `longest` at most.

    Points that are `struck` (shape (points,)) state as noise what blows scatter by: their force, their places
    and second blows differ, alike at neighbouring lines. What is smooth there and smaller is none of the
    plate's: it counts as it would beside white noise that is as large as stated.
    """
    runs_short, runs_variance, box, expected, traces = 0.0, 0.0, 0.0, 0.0, 0
    of_blows = np.zeros(len(sweep), bool) if struck is None else struck
    for r, blown in zip(
        _traces(sweep, whitened, parts), _traces(sweep, np.tile(of_blows, parts), parts), strict=True
    ):
        if len(r) < _FEWEST:
            continue
        share = min(1.0, float(np.mean(r**2))) if blown.all() else 1.0
        short, variance = _runs(r, share)
        counted = 1.0 if longest is None else min(1.0, longest / len(r))
        runs_short, runs_variance = runs_short + counted * short, runs_variance + counted * variance
        box, expected, traces = box + counted * _ljung_box(r, share), expected + counted * LAGS, traces + 1
    runs = runs_short / np.sqrt(runs_variance) if runs_variance > 0 else 0.0
    memory = (box - expected) / np.sqrt(2 * LAGS * traces) if traces else 0.0
    return float(runs), float(memory)


def _traces(sweep: Sweep, whitened: NDArray[Any], parts: int) -> Iterator[NDArray[Any]]:
    """Residuals along frequency, every pass of a segment and every part for itself."""
    for inside in groups_of(sweep):
        inside = inside[np.argsort(sweep.frequency_hz[inside], kind="stable")]
        for part in range(parts):
            yield whitened[inside + part * len(sweep)]


def _runs(r: Array, share: float = 1.0) -> tuple[float, float]:
    """How many runs of one sign are missing, and the variance of their number (Wald and Wolfowitz).

    `share`: of the variance that r has beside white noise.
    """
    above = r > 0
    n_1, n_2 = int(above.sum()), int((~above).sum())
    if not n_1 or not n_2:
        return float(len(r)), float(len(r)) / 4
    n = n_1 + n_2
    expected = 1 + 2 * n_1 * n_2 / n
    variance = (expected - 1) * (expected - 2) / (n - 1)
    short = expected - (1 + int((above[1:] != above[:-1]).sum()))
    if share < 1.0:
        # Neighbours that agree by rho change their sign in arccos(rho) / pi of steps.
        short = n * np.arcsin(share * np.sin(np.pi * np.clip(short / n, -0.5, 0.5))) / np.pi
    return float(short), max(variance, 1e-9)


def _ljung_box(r: Array, share: float = 1.0) -> float:
    """Q over `LAGS` lags, about chi-square with as many degrees of freedom where r has no memory.

    `share` as in `_runs`: what is not r's is as white noise has it.
    """
    n, r = len(r), r - r.mean()
    power = float(r @ r)
    rho = np.array([float(r[k:] @ r[:-k]) / power for k in range(1, LAGS + 1)])
    q = float(n * (n + 2) * np.sum(rho**2 / (n - np.arange(1, LAGS + 1))))
    return q if share >= 1.0 else share**2 * q + (1 - share**2) * LAGS
