"""Where the joint fit starts: shift factors and one law from the laws of each temperature by itself."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from scipy.optimize import least_squares

from fitting.arrays import Array
from fitting.laws import CoreLaw
from fitting.temperature.one_law import OneLaw

Band = tuple[float, float]
"""Lowest and highest frequency in Hz."""
_POINTS = 15
"""Over a sweep's band: curves are laid over each other at them."""
_STORAGE, _LOSS = 0.02, 0.04
"""What a curve is worth, relative, of G' and of eta."""
_BEGUN = 6
"""Laws of single temperatures that one law is sought from. A choice."""
_FAR = np.linspace(-18.0, 18.0, 361)
"""Ln a_T between neighbouring temperatures that are looked at."""


def start_of(
    laws: Sequence[CoreLaw], bands_hz: Sequence[Band], temperature_c: Array, reference_c: float
) -> tuple[CoreLaw, Array]:
    """A law at the reference and ln a_T of every sweep, from curves alone.

    Shape (sweeps,), as `temperature_c`.
    """
    omegas = [2 * np.pi * np.geomspace(low, high, _POINTS) for low, high in bands_hz]
    curves = [_curve(law, w) for law, w in zip(laws, omegas, strict=True)]
    order = np.argsort(temperature_c)
    shift = np.zeros(len(laws))
    for before, k in pairwise(order):
        # Both ways: neither law is known beyond its own band.
        off = [
            np.sum((_curve(laws[before], omegas[k] * np.exp(s)) - curves[k]) ** 2)
            + np.sum((_curve(laws[k], omegas[before] * np.exp(-s)) - curves[before]) ** 2)
            for s in _FAR
        ]
        shift[k] = shift[before] + _FAR[int(np.argmin(off))]
    nearest = int(np.argmin(np.abs(temperature_c - reference_c)))
    shift -= shift[nearest]
    return _one_law(laws, omegas, curves, shift, nearest, temperature_c)


def laws_near(one: OneLaw, forms: Sequence[CoreLaw], bands_hz: Sequence[Band]) -> list[CoreLaw]:
    """Of each form, unbent, the law that lies nearest one law at its sweep's temperature, over its band."""
    omegas = [2 * np.pi * np.geomspace(low, high, _POINTS) for low, high in bands_hz]
    aims = [_curve(one.at(k), omega) for k, omega in enumerate(omegas)]
    return [_nearest(one.law.plain, *each) for each in zip(aims, forms, omegas, strict=True)]


def _nearest(begin: CoreLaw, aim: Array, form: CoreLaw, omega: Array) -> CoreLaw:
    plain = form.plain
    low, high = plain.log_limits
    fits = [
        least_squares(
            lambda x: _curve(plain.with_logs(x), omega) - aim,
            np.clip(np.log(law.values), low, high),
            bounds=(low, high),
        )
        for law in (plain, begin)
    ]
    found = plain.with_logs(min(fits, key=lambda f: float(f.cost)).x)
    return form.with_values(np.append(found.values, np.ones(form.bend_count)))


def _some(laws: Sequence[CoreLaw], temperature_c: Array) -> list[CoreLaw]:
    """Laws of few temperatures, from the coldest to the warmest: each is a place to begin."""
    order = np.argsort(temperature_c, kind="stable")
    few = np.unique(np.linspace(0, len(laws) - 1, min(_BEGUN, len(laws))).astype(int))
    return [laws[order[k]] for k in few]


def _curve(law: CoreLaw, omega: Array) -> Array:
    storage, eta = law.storage_and_loss(omega)
    return np.concatenate([np.log(storage) / _STORAGE, np.log(np.maximum(eta, 1e-9)) / _LOSS])


def _one_law(
    laws: Sequence[CoreLaw],
    omegas: list[Array],
    curves: list[Array],
    shift: Array,
    nearest: int,
    temperature_c: Array,
) -> tuple[CoreLaw, Array]:
    free = np.arange(len(laws)) != nearest
    plain = [law.plain for law in laws]
    n = len(plain[0].names)
    low, high = plain[0].log_limits
    wide = np.full(int(free.sum()), 60.0)

    def residuals(x: Array) -> Array:
        law, s = plain[0].with_logs(x[:n]), np.zeros(len(laws))
        s[free] = x[n:]
        found = [_curve(law, w * np.exp(a)) - c for w, a, c in zip(omegas, s, curves, strict=True)]
        return np.concatenate(found)

    fits = [
        least_squares(
            residuals,
            np.clip(np.append(np.log(law.values), shift[free]), np.append(low, -wide), np.append(high, wide)),
            bounds=(np.append(low, -wide), np.append(high, wide)),
            loss="soft_l1",
            max_nfev=200,
        )
        for law in [plain[nearest], *_some(plain, temperature_c)]
    ]
    best = min(fits, key=lambda f: float(f.cost))
    found = np.zeros(len(laws))
    found[free] = best.x[n:]
    return plain[0].with_logs(best.x[:n]), found
