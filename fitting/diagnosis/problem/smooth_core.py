"""What of one curve no core explains: any smooth modulus fitted to it, by least absolute residuals.

G* = G_0(omega) e^{c . B(ln f)}, with B hats over ln f and, for what softens with strain, the size of the
deflection and its square; times a gain, a phase and a delay of the channel. Gauss-Newton, each step
reweighted to the least sum of sizes: a stretch that is off by much pulls no more than one that is off by
little. G_0 is where a search begins; hats follow what it lacks.
"""

import numpy as np

from fitting.arrays import Array, Complex
from fitting.identification.pointwise import velocity_of_sweep
from fitting.identification.pointwise_roots import VelocityOf
from fitting.laws import CoreLaw
from fitting.reduced.rational import RationalSweep
from fitting.specimen import Reading
from fitting.sweep import Sweep

_A_KNOT = 0.45
"""In ln f: what the core may follow."""
_MODULUS, _CHANNEL = 0.2, 0.01
"""How far modulus and channels may plausibly be off: what needs more of them is none of theirs."""
_HELD = 4e-4
"""Weight of that beside a reading: as much as so much more of its misfit, where a modulus is off by 20 %."""
_REWEIGHTED = 25
"""Times, towards the least sum of sizes. A choice."""
_STEPS = 15
"""Of Gauss-Newton; real curves need four to six."""
_STILL = 1e-4
"""Of a modulus: a step that moves nothing by more is the last."""
_NEWTON, _LONGEST = 60, 0.3
"""Steps for each reading by itself, and how far one goes in ln G*. A choice."""
_HALVED = 6
"""Times at most, where a step goes too far."""
_LEAST_LEFT, _ROUNDING = 1e-4, 1e-12
"""Of the largest misfit, and a bit more: what is met more closely gets no more weight for it."""
_SIZES = np.geomspace(0.05, 20.0, 41)
"""Times the law that a search begins with: a stated one may be off by that."""
_ANGLES = (-0.2, 0.0, 0.2, 0.4)
"""And radians more of its argument."""


def unexplained(
    sweep: Sweep, rational: RationalSweep, reads: Reading, law: CoreLaw
) -> tuple[Complex, Complex]:
    """What is left of each reading, relative, and the core's modulus in Pa. Shape (points,) each.

    `rational` holds the sweep's frequencies, ascending as its points are; `law` is a first guess.
    """
    velocity_of = velocity_of_sweep(sweep, rational, reads)
    read, f = sweep.response_m_s, sweep.frequency_hz
    drift = 1j * f / f.max()
    whole = _begin(velocity_of, read, law.modulus(sweep.omega))
    each = _by_points(velocity_of, read, whole)
    B, felt = (_of_modulus(f, np.abs(rational.displacement(G))) for G in (whole, each))
    nothing, near = np.zeros(B.shape[1], complex), _laid_through(felt, np.log(each / whole))
    left = [
        _followed(velocity_of, read, whole, B, nothing, drift),
        _followed(velocity_of, read, whole, felt, near, drift),
    ]
    return min(left, key=lambda found: float(np.sum(np.abs(found[0]))))


def _followed(
    velocity_of: VelocityOf, read: Complex, G_0: Complex, B: Array, start: Complex, drift: Complex
) -> tuple[Complex, Complex]:
    """As `unexplained`, hats `B` having gone from a `start` to the least sum of sizes."""
    bend = B.shape[1]
    expected = np.repeat([_MODULUS, _CHANNEL], [bend, 2])
    held = np.diag(np.sqrt(_HELD * len(read)) / expected)

    def at(c: Complex) -> tuple[Complex, Complex, float]:
        """What is left, d ln v / d ln G*, and the sum to be least."""
        G = G_0 * np.exp(B @ c[:bend])
        v, by_G = velocity_of(G)
        off = read / (v * np.exp(c[bend] + c[bend + 1] * drift)) - 1
        return off, by_G * G / v, float(np.sum(np.abs(off)) + np.sum(np.abs(held @ c) ** 2))

    c: Complex = np.append(start, np.zeros(2))
    off, feels, cost = at(c)
    for _ in range(_STEPS):
        A = np.hstack([feels[:, None] * B, np.ones((len(read), 1)), drift[:, None]])
        step = _least_sizes(A, off, held, c)
        for halved in range(_HALVED):
            there, felt, costs = at(c + step / 2**halved)
            if costs < cost:
                break
        else:
            break
        c, off, feels, cost = c + step / 2**halved, there, felt, costs
        if np.abs(step).max() < _STILL:
            break
    return off, G_0 * np.exp(B @ c[:bend])


def _by_points(velocity_of: VelocityOf, read: Complex, G: Complex) -> Complex:
    """A modulus of every reading by itself, by Newton's method on ln v. Shape (points,).

    A search that begins with one beside a narrow resonance takes the whole of it for an outlier: all that
    readings say of the core is nearer.
    """
    for _ in range(_NEWTON):
        v, by_G = velocity_of(G)
        with np.errstate(divide="ignore", invalid="ignore"):
            step = np.log(read / v) * v / (by_G * G)
        size = np.abs(step)
        step = np.where(np.isfinite(size), step * np.minimum(1, _LONGEST / np.maximum(size, _STILL)), 0)
        G = G * np.exp(step)
        if size[np.isfinite(size)].max(initial=0.0) < _STILL:
            break
    return G


def _laid_through(B: Array, moved: Complex) -> Complex:
    """Coefficients of the hats nearest to a modulus moved point by point. Shapes (points, n), (points,)."""
    return np.asarray(np.linalg.lstsq(B, moved, rcond=None)[0], complex)


def _begin(velocity_of: VelocityOf, read: Complex, stated: Complex) -> Complex:
    """A modulus moved as a whole to where the readings are nearest. Shape (points,)."""
    tried = [stated * size * np.exp(1j * angle) for size in _SIZES for angle in _ANGLES]
    tried = [G for G in tried if np.all(G.imag > 0)] or [stated]
    return min(tried, key=lambda G: float(np.sum(np.abs(read / velocity_of(G)[0] - 1))))


def _of_modulus(f: Array, size: Array) -> Array:
    """What ln G* may do over a curve: shape (points, unknowns)."""
    t, share = np.log(f), size / size.max()
    knots = np.linspace(t.min(), t.max(), max(3, int(np.ptp(t) / _A_KNOT) + 2))
    hats = np.maximum(0, 1 - np.abs(t[:, None] - knots) / (knots[1] - knots[0]))
    return np.column_stack([hats, share, share**2])


def _least_sizes(A: Complex, off: Complex, held: Array, c: Complex) -> Complex:
    """The step that leaves the least sum of sizes. Shapes (points, n), (points,), (n, n), (n,)."""
    weight, step = np.ones(len(off)), c
    floor = _LEAST_LEFT * np.abs(off).max() + _ROUNDING
    for _ in range(_REWEIGHTED):
        rows = np.vstack([A * weight[:, None], held])
        wanted = np.append(off * weight, -held @ c)
        step = np.asarray(np.linalg.lstsq(rows, wanted, rcond=None)[0], complex)
        weight = 1 / np.sqrt(np.maximum(np.abs(off - A @ step), floor))
    return step
