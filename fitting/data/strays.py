"""Readings that leave the curve of their neighbours by far more than these scatter.

A laser that lost its speckle, an overload, a contact that opened for a moment. Every reading is held against
the local model of `fitting.data.noise` through the six beside it. The worst are taken out of the curves, and
the rest judged anew: what is left must lie on its curves, also right beside a gap. A resonance bends its
neighbours too and is none of these; where steps are too coarse to follow one, nothing is said. At an end
there are readings on one side only, and a resonance may begin there: what is off must be so at once, and
from a freer curve as well.
"""

from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array, Complex, Mask
from fitting.data.noise import FEWEST, WINDOW, around, evening, groups_of, local_model, local_residuals
from fitting.sweep import Sweep

Places = NDArray[np.intp]

BEYOND, LEAST = 8.0, 0.02
"""Scatters, and share of the curve: a stray is off by more than both."""
_BESIDE = 4.0
"""Scatters that readings right beside a stray may be off their own curve."""
_MOST = 0.15
"""Of a curve: more of them are no strays."""
_TOGETHER = 8
"""That follow each other: more of them are something else. A choice."""
_TURN = 0.7
"""Radians from one reading to the next: two to three steps within a resonance's width. A choice."""
_TURN_OVER = 2.0
"""Over a gap: more than that is a resonance in it. A choice."""
_SIDE = 4
"""Readings on either side that a curve over a gap is drawn through: twice as many as it has unknowns."""
_MEDIAN = 1.177
"""Of a complex normal variable's size, in standard deviations of a part."""
_NEAREST = 6
"""Readings that the curve at a gap is drawn through."""
_REACH = 2.5
"""Of half of what the readings beside span: no end is judged further from their middle. Of even steps all
are nearer."""
_FREER = 12
"""Readings that the curve of two poles at an end is drawn through: twice as many as it has unknowns."""
_AGREE = 3.0
"""Times the difference of both curves that a stray at an end is off by at least. A choice."""
_AT_ONCE = 0.4
"""Of the largest share by which readings at an end are off: none of them is off by less. A choice."""
_LOST = 0.5
"""Of the curve: one of the readings at an end is off by more, as what is lost is; what is off by less may be
a resonance there."""
_ROUNDING, _NOTHING = 1e-9, 1e-300
"""Of the largest reading: smaller differences are none; and where all readings are zero."""
_REPEATED = 0.1
"""Of the numbers: as many are there twice where they were read or written in steps."""


def strays(sweep: Sweep) -> Array:
    """By how much stray readings are off, m/s; zero for all others. Shape (points,).

    Amplitudes without phase leave too little to judge by.
    """
    off = np.zeros(len(sweep))
    if not sweep.has_phase:
        return off
    even = evening(sweep)
    response = sweep.response_m_s * even
    for group in groups_of(sweep):
        # Of a frequency that is there again the first reading lies on the curve, the others are as they are.
        f, first = np.unique(sweep.frequency_hz[group], return_index=True)
        at = group[first]
        if len(f) >= FEWEST and response[at].any():
            off[at] = _in_group(f, response[at])
    return off / even


def _in_group(f: Array, v: NDArray[Any]) -> Array:
    """Of one curve in ascending order. Shape (points,)."""
    left, size = _leaves(f, v), np.abs(v)
    finest = max(_steps(v.real), _steps(v.imag), _steps(size)) / np.sqrt(12)
    scatter = _scatter(left, size, finest)
    suspect = left > BEYOND * scatter
    out = _missing(f, v, scatter, suspect)
    while True:
        kept = np.flatnonzero(~out)
        if len(kept) < FEWEST:
            return np.zeros(len(f))
        left = _leaves(f[kept], v[kept])
        z = left / _scatter(left, size[kept], finest)
        worst = z > BEYOND
        for k in range(1, WINDOW // 2 + 1):
            # One that is off spoils the curves of those beside it.
            worst[k:] &= z[k:] >= z[:-k]
            worst[:-k] &= z[:-k] >= z[k:]
        if not worst.any():
            break
        out[kept[worst]] = True
        if out.mean() > _MOST:
            return np.zeros(len(f))
    clean = np.zeros(len(f), dtype=bool)
    clean[kept] = z < _BESIDE
    off = np.zeros(len(f))
    for first, last in _runs(out):
        beside = slice(max(first - 2, 0), last + 3)
        lies = last - first < _TOGETHER and np.all(clean[beside] | out[beside])
        if lies and _is_followed(v, out, first, last):
            run = slice(first, last + 1)
            near = kept[np.sort(np.argsort(np.abs(f[kept] - f[run].mean()))[:_NEAREST])]
            curve = _curve(f[near], v[near], f[run])
            far = np.abs(v[run] - curve)
            off[run] = np.where(far > LEAST * np.abs(curve), far, 0.0)
    return off


def _is_followed(v: Complex, out: Mask, first: int, last: int) -> bool:
    """Whether the phase turns little from step to step about a gap, and over it."""
    near = np.arange(max(first - _SIDE, 0), min(last + _SIDE, len(v) - 1) + 1)
    kept = near[~out[near]]
    over = v[kept[1:]] * v[kept[:-1]].conj()
    # A reading of nothing has no phase to follow.
    turns = np.where(over == 0, np.pi, np.abs(np.angle(over)))
    return bool(np.all(turns < np.minimum(_TURN * np.diff(kept), _TURN_OVER)))


def _missing(f: Array, v: Complex, scatter: Array, suspect: Mask) -> Mask:
    """Readings that follow each other, or are at an end, and are off together, the curve running on beside.

    Between themselves they may lie as smoothly as any: a laser that sees nothing reads its floor.
    """
    out, n = np.zeros(len(f), dtype=bool), len(f)
    for count in range(1, _TOGETHER + 1):
        width = count + 2 * _SIDE
        if width > n or (count >= _SIDE and not suspect.any()):
            break
        at = np.arange(n - width + 1)[:, None] + np.arange(width)
        # Between as many on either side where something is suspect; at an end, with what is there before it.
        gaps = [_parted(at[suspect[at].any(axis=1)], _SIDE, count)] if count > 1 else []
        between = sum(len(inner) for inner, _ in gaps)
        for k in range(_SIDE - count + (1 if count == 1 else 2)):
            gaps += [_parted(at[:1], k, count), _parted(at[-1:], 2 * _SIDE - k, count)]
        if not gaps:
            continue
        inner, outer = (np.concatenate(part) for part in zip(*gaps, strict=True))
        off, beside, scatters = _over(f, v, scatter, inner, outer)
        # At an end there is little around: noise may grow within the few readings beside.
        scatters[:between] = 1.0
        far = (off > BEYOND * np.maximum(scatters, 1.0)) & (beside < _BESIDE)
        far[between:] = [
            is_far and _at_once(f, v, inner[k], outer[k]) for k, is_far in enumerate(far[between:], between)
        ]
        out[inner[far]] = True
    return out


def _at_once(f: Array, v: Complex, inner: Places, outer: Places) -> bool:
    """Whether readings at an end leave the curve beside them as no structure does.

    A resonance that begins or ends there takes each further than the one before, and a curve of two poles
    through more readings goes some of the way. Shapes (readings,) and (beside,).
    """
    middle, half = f[outer].mean(), np.ptp(f[outer]) / 2
    if np.abs(f[inner] - middle).max() > _REACH * half:
        return False
    every = np.setdiff1d(np.arange(len(f)), inner)
    near = every[:_FREER] if inner[0] < every[len(every) // 2] else every[-_FREER:]
    curve = _curve(f[outer], v[outer], f[inner])
    freer = _curve(f[near], v[near], f[inner], poles=2)
    off = np.abs(v[inner] - curve)
    share = off * np.abs(curve).max() / np.maximum(np.abs(curve), _ROUNDING * np.abs(curve).max())
    at_once = share.min() > _AT_ONCE * share.max() and share.max() > _LOST * np.abs(curve).max()
    return bool(at_once and np.all(off > _AGREE * np.abs(freer - curve)))


def _parted(at: Places, first: int, count: int) -> tuple[Places, Places]:
    """A gap's readings from the `first` on, and those beside. Shapes (gaps, readings) and (gaps, beside)."""
    return at[:, first : first + count], np.delete(at, np.s_[first : first + count], axis=1)


def _over(f: Array, v: Complex, scatter: Array, inner: Places, outer: Places) -> tuple[Array, Array, Array]:
    """How far gaps leave the curve through what is beside: the least in each; and how far that itself does.

    At most, and what it scatters by. `inner` has shape (gaps, readings), `outer` (gaps, beside). In scatters,
    the curve's doubt counted. Shape (gaps,) each.
    """
    middle = f[outer].mean(axis=1, keepdims=True)
    half = np.ptp(f[outer], axis=1)[:, None] / 2
    t, t_outer = (f[inner] - middle) / half, (f[outer] - middle) / half
    model = local_model(t_outer, v[outer])
    solve = np.linalg.pinv(model)
    a = np.einsum("pun,pn->pu", solve, v[outer])
    beside = np.abs(v[outer] - np.einsum("pnu,pu->pn", model, a)) / scatter[outer]
    numerator = np.stack([np.ones_like(t), t, t**2], axis=-1)
    denominator = 1 - a[:, 3:] * t
    curve = np.einsum("pnu,pu->pn", numerator, a[:, :3]) / denominator
    # The neighbours' noise, as the linearised curve passes it on.
    full = np.concatenate([numerator, (t * curve)[..., None]], axis=-1)
    passed = np.einsum("pnu,pum->pnm", full, solve) / denominator[..., None]
    doubt = np.sqrt(scatter[inner] ** 2 + np.sum(np.abs(passed * scatter[outer][:, None]) ** 2, axis=2))
    off = np.abs(v[inner] - curve) / doubt
    # Of both parts, four unknowns fitted.
    scatters = np.sqrt(np.sum(beside**2, axis=1) / (2 * (outer.shape[1] - model.shape[2])))
    return np.asarray(off.min(axis=1)), np.asarray(beside.max(axis=1)), np.asarray(scatters)


def _leaves(f: Array, v: Complex) -> Array:
    """By how much each reading leaves its curve, scaled to unit gain of noise; 0 for three at either end."""
    left = np.zeros(len(f))
    middles, left_over = local_residuals(f, v)
    left[middles] = np.abs(left_over)
    return left


def _scatter(left: Array, size: Array, finest: float) -> Array:
    """By medians, that strays hardly move: a floor by the smaller half, a share by the larger one.

    More where readings around scatter by more, as those of a blow do where its force has little. None is
    below the `finest`, which is what steps of the reading itself leave.
    """
    inner = slice(WINDOW // 2, -(WINDOW // 2))
    small = size[inner] <= np.median(size[inner])
    floor = np.median(left[inner][small])
    share = np.median(left[inner][~small] / size[inner][~small]) if not small.all() else 0.0
    least = max(finest, _ROUNDING * size.max() + _NOTHING)
    scatter = np.maximum(np.hypot(floor, share * size) / _MEDIAN, least)
    return np.asarray(scatter * np.maximum(around(left[inner] / scatter[inner], len(left)) / _MEDIAN, 1.0))


def _steps(x: Array) -> float:
    """The least difference of numbers of which many are there more than once; 0 where they are not."""
    values = np.unique(x)
    repeated = len(values) < (1 - _REPEATED) * len(x)
    return float(np.diff(values).min()) if repeated and len(values) > 1 else 0.0


def _curve(f: Array, v: Complex, at: Array, *, poles: int = 1) -> Complex:
    """Through these readings at other frequencies: `poles` over a polynomial, linearised. Shape of `at`."""
    middle, half = f.mean(), np.ptp(f) / 2
    t, there = (f - middle) / half, (at - middle) / half
    powers = np.arange(poles + 2)
    columns = np.concatenate([t[:, None] ** powers, v[:, None] * t[:, None] ** powers[1:-1]], axis=1)
    a = np.linalg.lstsq(columns, v, rcond=None)[0]
    above = there[:, None] ** powers @ a[: poles + 2]
    return np.asarray(above / (1 - there[:, None] ** powers[1:-1] @ a[poles + 2 :]))


def _runs(out: Mask) -> list[tuple[int, int]]:
    """First and last of those that follow each other."""
    places = np.flatnonzero(out)
    cuts = [0, *(np.flatnonzero(np.diff(places) > 1) + 1), len(places)]
    return [(int(places[a]), int(places[b - 1])) for a, b in pairwise(cuts) if b > a]
