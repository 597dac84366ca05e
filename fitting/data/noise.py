"""How noisy each point of a sweep is: stated, seen as local scatter, or unknown.

Local scatter is what a model of seven neighbours leaves of the middle one. The model is one pole over
a parabola (the local rational method), so that a peak, however coarsely stepped, is not taken for
noise. Within a segment the variance is alpha^2 + beta^2 |v|^2: a floor and a share of the response. Over a
band that is wide the floor is as likely flat in displacement or in acceleration as in velocity, or between:
an accelerometer's is not flat in what is made of its reading.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array
from fitting.data.levels import by_level, to_one_level
from fitting.numerics.chances import chi2_exceeded
from fitting.sweep import Sweep

WINDOW = 7
"""Points that a local model is laid through: three more than it has unknowns for phasors, one for
amplitudes."""
FEWEST = 15
"""Points a segment needs before its scatter says anything by itself."""
_LEAST_GAIN = 1e-6
"""Of a reading's variance that a local model leaves, at least: one that passes through it says nothing."""
_ROUNDING = 1e-12
"""Of the peak's square: no reading scatters by less."""
_NOTHING = 1e-300
"""In the place of a reading that is nothing."""
_FEWEST_LEFT = 12
"""Numbers that local models must leave to tell what shorter segments scatter by, two of a phasor: known to a
fifth then."""
_LEAST = 0.15
"""Of the points, that lie in no window of a resonance however sharp: a choice."""
_SPLITS = 24
"""Of a floor's part in the variance at the peak, that are tried: a choice, fine beside what scatter tells."""
_AROUND = 41
"""Points whose median says how much is left around the middle one: eight that are off do not move it. A
choice."""
_WIDE = 1e-4
"""Of the peak's square: what is smaller is read in a sweep over many resonances, where a floor far below the
first split is seen too."""
_BELOW = 10
"""Times smaller than the smallest reading's square the finest split then is. A choice."""
_TILTS = (-2.0, -1.0, 0.0, 1.0, 2.0)
"""Powers of the frequency that a floor's variance may follow in velocity: flat in acceleration, in velocity,
in displacement, and between."""
_WIDE_BAND = 3.0
"""Highest over lowest frequency, from which on it matters. A choice."""


@dataclass(frozen=True)
class Noise:
    """Standard deviation of every point (of each part of a phasor)."""

    std_m_s: Array
    source: Literal["stated", "local scatter", "misfit", "unknown"]
    """`unknown`: relative to the reading, known up to a common factor only; `misfit`: what a fit has left."""

    @property
    def is_known(self) -> bool:
        """Whether readings have a size of error to be weighed by."""
        return self.source != "unknown"


def noise_of(sweep: Sweep) -> Noise:
    """Stated where the file says it, local scatter where segments are dense enough, else unknown.

    A segment of few points, or one frequency read again, scatters as the others do together.
    """
    stated = sweep.response_std_m_s
    if stated is not None:
        return Noise(stated, "stated")
    groups, even = groups_of(sweep), evening(sweep)
    f, response = sweep.frequency_hz, sweep.response_m_s * even
    long = [group for group in groups if _frequencies(sweep, group) >= FEWEST]
    std = np.zeros(len(sweep))
    if len(long) < len(groups):
        telling = [group for group in groups if _frequencies(sweep, group) > WINDOW]
        parts = 2 if sweep.has_phase else 1
        if parts * sum(len(group) - WINDOW + 1 for group in telling) < _FEWEST_LEFT:
            return Noise(np.abs(sweep.response_m_s), "unknown")
        std = _scatter_of_all(telling, f, response)
    for group in long:
        std[group] = _scatter(f[group], response[group])
    return Noise(std / even, "local scatter")


def noises_of(sweeps: Sequence[Sweep]) -> list[Noise]:
    """Of sweeps of one laboratory: one that shows no noise has that of the others, by its readings' size."""
    each = [noise_of(sweep) for sweep in sweeps]
    shares = [
        np.median(noise.std_m_s / np.maximum(np.abs(sweep.response_m_s), _NOTHING))
        for noise, sweep in zip(each, sweeps, strict=True)
        if noise.is_known
    ]
    if not shares:
        return each
    share = float(np.median(shares))
    return [n if n.is_known else Noise(share * n.std_m_s, "local scatter") for n in each]


def scatter_of_left(sweep: Sweep, left: NDArray[Any]) -> Array:
    """Noise of every point by what a fit leaves, of the form that `noise_of` has: by what jumps there.

    What the model misses smoothly does not jump from point to point. Where a resonance has but a few points
    the local model of readings leaves most of it, and its scatter is many times the noise. Shape (points,)
    of `left`, phasors or amplitudes.
    """
    std, even = np.zeros(len(sweep)), evening(sweep)
    response, left = sweep.response_m_s * even, left * even
    for group in groups_of(sweep):
        order = group[np.argsort(sweep.frequency_hz[group], kind="stable")]
        # The variance of r_1 - 2 r_2 + r_3.
        square = np.abs(np.diff(left[order], 2)) ** 2 / 6
        parts = 2 if np.iscomplexobj(left) else 1
        size = np.abs(response[order]) ** 2
        middle = np.arange(1, len(order) - 1)
        std[order] = np.sqrt(_variance(sweep.frequency_hz[order], size, middle, square / parts, parts))
    return np.asarray(std / even)


def scatter_over_stated(sweep: Sweep) -> float | None:
    """Local scatter over stated noise, over all points; None where either is not there.

    The median of `noise_of`'s, and what the seventh of the points says of which the local model leaves least:
    the nearer to one of both. A resonance that is sharp beside the lines' spacing leaves much more than noise
    in its windows, and so in all that is smoothed; it leaves those in between as they are.
    """
    stated = sweep.response_std_m_s
    if stated is None:
        return None
    ratios, squares, even = [], [], evening(sweep)
    response, stated = sweep.response_m_s * even, stated * even
    for group in groups_of(sweep):
        f, v = sweep.frequency_hz[group], response[group]
        if len(np.unique(f)) < FEWEST:
            continue
        ratios.append(_scatter(f, v) / stated[group])
        order = np.argsort(f, kind="stable")
        middle, left_over = local_residuals(f[order], v[order])
        squares.append(np.abs(left_over / stated[group][order][middle]) ** 2)
    if not ratios:
        return None
    parts = 2 if sweep.has_phase else 1
    least = np.quantile(np.concatenate(squares), _LEAST) / chi2_exceeded(1 - _LEAST, parts)
    logs = np.log(np.median(np.concatenate(ratios))), np.log(max(float(least), _NOTHING)) / 2
    if logs[0] * logs[1] <= 0:
        return 1.0
    return float(np.exp(min(logs, key=abs)))


def groups_of(sweep: Sweep) -> list[NDArray[np.intp]]:
    """Points of one segment, one pass and one level: each group a curve of its own. Shape (n,) each."""
    keys = np.column_stack([sweep.segment, sweep.sweep])
    _, which = np.unique(keys, axis=0, return_inverse=True)
    passes = [np.flatnonzero(which.ravel() == k) for k in range(int(which.max()) + 1)]
    return [one[level] for one in passes for level in by_level(sweep.commanded_m_s2[one])]


def shortest_group(sweep: Sweep) -> int:
    """Frequencies of the group that has fewest."""
    return min(_frequencies(sweep, group) for group in groups_of(sweep))


def _frequencies(sweep: Sweep, group: NDArray[np.intp]) -> int:
    return len(np.unique(sweep.frequency_hz[group]))


def evening(sweep: Sweep) -> Array:
    """Factor that takes a reading to the one level of its group: a curve is smooth there. Shape (points,)."""
    factor = np.ones(len(sweep))
    for group in groups_of(sweep):
        factor[group] = to_one_level(sweep.commanded_m_s2[group])
    return factor


def _scatter(frequency_hz: Array, response: NDArray[np.complex128] | Array) -> Array:
    order = np.argsort(frequency_hz, kind="stable")
    std = np.empty(len(order))
    std[order] = _scatter_of_all([np.arange(len(order))], frequency_hz[order], response[order])
    return std


def _scatter_of_all(
    groups: list[NDArray[np.intp]], f: Array, response: NDArray[np.complex128] | Array
) -> Array:
    """One floor and one share by all of `groups`, of every point: each alone has too few. Shape (points,)."""
    parts = 2 if np.iscomplexobj(response) else 1
    middles, squares = [], []
    for group in groups:
        order = group[np.argsort(f[group], kind="stable")]
        middle, left_over = local_residuals(f[order], response[order])
        middles.append(order[middle])
        squares.append(np.abs(left_over) ** 2 / parts)
    size = np.abs(response) ** 2
    return np.sqrt(_variance(f, size, np.concatenate(middles), np.concatenate(squares), parts))


def local_residuals(f: Array, v: NDArray[Any]) -> tuple[NDArray[np.intp], NDArray[Any]]:
    """Middle points of the windows and what the local model leaves there, scaled to unit gain of noise.

    Of readings in ascending order. Shape (points - WINDOW + 1,) each.
    """
    half = WINDOW // 2
    middles = np.arange(half, len(f) - half)
    at = middles[:, None] + np.arange(-half, half + 1)
    span = np.maximum(f[at[:, -1]] - f[at[:, 0]], 1e-12)
    Q, _ = np.linalg.qr(local_model((f[at] - f[middles][:, None]) / span[:, None], v[at]))
    row = Q[:, half]
    left_over = v[middles] - np.einsum("pu,pwu,pw->p", row, Q.conj(), v[at])
    gain = 1 - np.sum(np.abs(row) ** 2, axis=1)
    return middles, left_over / np.sqrt(np.maximum(gain, _LEAST_GAIN))


def local_model(t: Array, v: NDArray[Any]) -> NDArray[Any]:
    """Columns of (a + b t + c t^2)/(1 + d t), linearised, for phasors; a quintic for amplitudes.

    The first column is one, all others vanish at t = 0. Shapes (..., points) to (..., points, columns).
    """
    if np.iscomplexobj(v):
        return np.stack([np.ones_like(t), t, t**2, v * t], axis=-1)
    return np.stack([t**k for k in range(6)], axis=-1)


def around(left: Array, count: int) -> Array:
    """Median of what is left around each of `count` points, of those in their middle. Shape (count,).

    Zero where there are too few to speak of places.
    """
    if len(left) < 2 * _AROUND:
        return np.zeros(count)
    medians = np.median(np.lib.stride_tricks.sliding_window_view(left, _AROUND), axis=1)
    before = (count - len(medians)) // 2
    return np.pad(medians, (before, count - len(medians) - before), mode="edge")


def _variance(f: Array, size_squared: Array, middle: NDArray[np.intp], square: Array, parts: int) -> Array:
    """Of a part of each reading: the mean over floors and shares, a floor's part as likely anywhere.

    `square` are squared residuals of a part of the readings at `middle`, `parts` of each. Few points hardly
    say how much of their scatter is a floor: the likeliest split is often none, and far from the peak
    readings would then count for several times what they are worth. Shapes (points,), (points,),
    (residuals,) twice.
    """
    largest = float(np.max(size_squared[middle]))
    tiny = _ROUNDING * largest + _NOTHING
    edges = _splits(float(np.min(size_squared[middle])) / (largest or 1.0))
    floor = (edges[1:] + edges[:-1]) / 2
    relative = f / np.exp(np.mean(np.log(f)))
    tilts = _TILTS if f.max() > _WIDE_BAND * f.min() else (0.0,)
    # var = s (floor tilt + (1 - floor) |v|^2 / largest); s has an inverse gamma distribution for each.
    whole = np.array(
        [
            floor[:, None] * relative**tilt + (1 - floor[:, None]) * (size_squared / (largest or 1.0))
            for tilt in tilts
        ]
    )
    form = whole[:, :, middle]
    freedom = parts * len(square) / 2
    sums = parts / 2 * np.sum((square + tiny) / form, axis=2)
    log_weight = -parts / 2 * np.sum(np.log(form), axis=2) - freedom * np.log(sums)
    weight = np.exp(log_weight - log_weight.max()) * np.diff(edges)
    scale = weight / weight.sum() * sums / (freedom - 1)
    return np.asarray(np.einsum("tk,tkp->p", scale, whole)) + tiny


def _splits(smallest: float) -> Array:
    """Edges of the floor's parts that are tried; `smallest` reading's square over the largest. Shape (n,)."""
    edges = np.arange(_SPLITS + 1) / _SPLITS
    if not 0 < smallest < _WIDE:
        return edges
    finer = np.geomspace(smallest / _BELOW, edges[1], 2 * _SPLITS)
    return np.concatenate([[0.0], finer, edges[2:]])
