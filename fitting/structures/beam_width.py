"""What a beam's width and its faces' own shear do to its stiffness, beside Euler and Bernoulli.

A beam curves across as it curves along, by Poisson's ratio (anticlastic). Where its curvature w'' changes
along it the one across changes too, and that is twist; and a clamp that is a block holds it at zero. With
the curvature across a field V of its own, -nu V, an energy of plate theory (Kirchhoff), over the width b:

    E I/2 int w''^2 + nu^2/(1 - nu^2) [(V - w'')^2 + l^2 V'^2],   l^2 = (1 - nu) b^2/6

Faces that stretch narrow so too, and may bow in their plane. Both fields, and the turn of sections that shear
by themselves (Timoshenko), are what makes the energy least: what stays is a form of w, u_b and u_c alone. All
lengths are in shares of the beam's.
"""

from functools import lru_cache

import numpy as np
from numpy.polynomial import legendre

from fitting.arrays import Array
from fitting.structures.beam_shapes import gauss, square

_ORDER, _PLACES = 30, 80
"""Polynomials of such a field, for what a clamp does within a fortieth of the length; and of quadrature."""
_TORSION = 0.63
"""Times thickness over width: of the twist of a wide strip its edges take less (Saint-Venant)."""
_NARROWEST = 0.2
"""Share of the twist that is left at least, of a strip hardly wider than thick."""
_SHEAR = 5 / 6
"""Of a rectangle's area, that shears."""

PLACES, WEIGHT = gauss(_PLACES)
"""Where fields are integrated, in shares of the length, and the weights. Shape (places,) each."""


def reach(width: float, thickness: float, poisson: float) -> float:
    """How far from a clamp its hold of the width goes: l, of a face; all lengths in shares of the beam's."""
    edges = max(1 - _TORSION * thickness / width, _NARROWEST)
    return float(width * np.sqrt((1 - poisson) / 6 * edges))


def curved_across(curvature: Array, reach: float, ends: str, *, held: bool) -> Array:
    """Least of int (V - w'')^2 + l^2 V'^2; `held`: V is zero at clamped ends.

    `curvature` of shape (k, places); returns (k, k).
    """
    V, slope = _field(ends, held)
    A = square(V, WEIGHT) + reach**2 * square(slope, WEIGHT)
    return _left(A, (V * WEIGHT) @ curvature.T, square(curvature, WEIGHT))


def narrowed(stretch: Array, width: float, poisson: float, ends: str, *, held: bool) -> Array:
    """Least of int (s - u')^2 + (1 - nu)/2 b^2/12 (p + s')^2 + b^4/720 p'^2, of a face in its plane.

    -nu s y is its motion across, p how far its section bows along. `stretch` of shape (k, places).
    """
    (s, s_slope), n = _field(ends, held), _ORDER
    shear, bow = (1 - poisson) / 24 * width**2, width**4 / 720
    crossed = shear * (s_slope * WEIGHT) @ s.T
    A = np.block(
        [
            [square(s, WEIGHT) + shear * square(s_slope, WEIGHT), crossed],
            [crossed.T, shear * square(s, WEIGHT) + bow * square(s_slope, WEIGHT)],
        ]
    )
    C = np.vstack([(s * WEIGHT) @ stretch.T, np.zeros((n, len(stretch)))])
    return _left(A, C, square(stretch, WEIGHT))


def followed(curvature: Array, reach: float, ends: str) -> Array:
    """V of `curved_across` at its least, where no clamp holds it: w'' without its short waves.

    `curvature` and what returns are of shape (k, places).
    """
    V, slope = _field(ends, False)
    A = square(V, WEIGHT) + reach**2 * square(slope, WEIGHT)
    return np.asarray(np.linalg.solve(A, (V * WEIGHT) @ curvature.T).T @ V)


def at_the_middle(curvature: Array, reach: float, ends: str, x: Array) -> tuple[Array, Array]:
    """V of `curved_across` at its least where clamps hold it, and its slope, at some places.

    Over the width the deflection is w - nu V (y^2/2 - b^2/24): in the middle nu V b^2/24 more than w, which
    is its mean. Shapes: `curvature` (k, places), `x` (n,); returns (k, n) each.
    """
    V, slope = _field(ends, True)
    A = square(V, WEIGHT) + reach**2 * square(slope, WEIGHT)
    c = np.linalg.solve(A, (V * WEIGHT) @ curvature.T)
    there, rising = _field_at(x, ends, held=True)
    return np.asarray(c.T @ there), np.asarray(c.T @ rising)


def flowing(strain: Array, reach: float, ends: str) -> Array:
    """Integral of strain times V, V - l^2 V'' = strain: zero at free ends, V' zero at clamped ones.

    `strain` of shape (k, places); returns (k, k).
    """
    V, slope = _field(ends, False, shut=True)
    A = square(V, WEIGHT) + reach**2 * square(slope, WEIGHT)
    C = (V * WEIGHT) @ strain.T
    return np.asarray(C.T @ np.linalg.solve(A, C))


def give_of_face(thickness: float, poisson: float) -> float:
    """What E I is over G times the area that shears: how far a face gives way by its own shear, squared."""
    return thickness**2 * (1 + poisson) / 6 / _SHEAR


def give_of_layer(thickness: float, poisson: float) -> float:
    """The same of a layer with one face free, that the other one stretches: 2 (1 + nu) h^2/3."""
    return 2 * (1 + poisson) * thickness**2 / 3


def sheared(strain: Array, other: Array, give: float, ends: str) -> Array:
    """What of the integral of two strains a layer's own shear takes off.

    Its sections turn by w' less an angle of shear that a clamp holds at zero. Both strains of shape
    (k, places); returns (k, k).
    """
    angle, slope = _field(ends, True)
    A = square(slope, WEIGHT) + square(angle, WEIGHT) / give
    C, D = ((slope * WEIGHT) @ one.T for one in (strain, other))
    return np.asarray(C.T @ np.linalg.solve(A, D))


def _left(A: Array, C: Array, whole: Array) -> Array:
    return np.asarray(whole - C.T @ np.linalg.solve(A, C))


@lru_cache(maxsize=8)
def _field(ends: str, held: bool, *, shut: bool = False) -> tuple[Array, Array]:
    """Polynomials, and their slopes: zero at clamped ends where `held`, at free ones where `shut`.

    Shape (order, places) each.
    """
    return _field_at(PLACES, ends, held=held, shut=shut)


def _field_at(x: Array, ends: str, *, held: bool, shut: bool = False) -> tuple[Array, Array]:
    """The same at some places. Shape (n,) of `x`; returns (order, n) each."""
    t, each = 2 * x - 1, np.eye(_ORDER)
    P = legendre.legval(t, each)
    slope = legendre.legval(t, legendre.legder(each, scl=2.0))
    none = np.ones_like(x), np.zeros_like(x)
    one, both = (x, none[0]), (x * (1 - x), 1 - 2 * x)
    factors = {}
    if held:
        factors = {"clamped-free": one, "clamped-clamped": both}
    if shut:
        factors = {"clamped-free": (1 - x, -none[0]), "free-free": both}
    f, f_slope = factors.get(ends, none)
    return f * P, f * slope + f_slope * P
