"""A beam in bending: bare, with a free layer on one side or on both, or a sandwich.

Euler-Bernoulli faces with their own stretching, a core that shears between them (Mead and Markus, J. Sound
Vib. 10 (1969)); a free layer stretches and bends with the beam, E = 2 (1 + mu) G. Over a length L, per width:

    gamma = (u_c - u_b + d w')/H,   d = H + (h_c + h_b)/2

w and the layers' u are polynomials over the length that meet the ends' conditions, projected once on the
modes at a few moduli of the core.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import lru_cache
from typing import Literal

import numpy as np
import scipy.linalg as la
from numpy.polynomial import Legendre, Polynomial

from fitting.arrays import Array, Complex
from fitting.gravity import PUBLISHED_G_M_S2
from fitting.specimen import BaseDriven, Core, Face, Reading
from fitting.structures.small import Parts
from fitting.tolerances import STATED

Ends = Literal["clamped-free", "free-free", "clamped-clamped", "centre-driven"]

ORDER = 18
"""Polynomials of w, and of each u: ten modes to 1e-6."""
_MODES = 10
"""Of each modulus, that the basis holds."""
_MODULI_PA = (1e5, 3e6, 1e8, 3e9)
"""From a core that only stores to a free layer as stiff as a plastic: the modes of each are in the basis."""
_NEGLIGIBLE = 1e-9
"""Of the basis' vectors, relative: what is in the others."""


@dataclass(frozen=True)
class Beam(BaseDriven):
    """What is stated of it, in SI units; x from a clamped end, or from the centre where that is driven."""

    length_m: float
    """Free length; of both halves together where it is driven in its centre, the mount taken off."""
    width_m: float
    boundary: Ends
    substrate: Face
    constraining: Face | None = None
    core: Core | None = None
    """Without a constraining layer it is a free layer."""
    both_sides: bool = False
    """The same on either side: a free layer, or core and constraining layer."""
    pickup_m: float | None = None
    reads: Reading = "relative"
    base_acceleration_m_s2: float = PUBLISHED_G_M_S2
    tolerances: Mapping[str, float] = field(default_factory=dict, hash=False)
    exact: bool = False

    kind = "beam"
    modal_ratios: tuple[float, ...] = ()

    @property
    def span_m(self) -> float:
        """What vibrates as one piece: half of it where the centre is driven."""
        return self.length_m / 2 if self.boundary == "centre-driven" else self.length_m

    @property
    def is_doubled(self) -> bool:
        """Whether a constrained layer is on both sides."""
        return self.both_sides and self.constraining is not None

    @property
    def numbers(self) -> tuple[str, ...]:
        """Kinds of stated numbers that move its matrices."""
        layers: list[tuple[str, tuple[str, ...]]] = [("substrate", ("young", "thickness", "density"))]
        if self.constraining is not None:
            layers.append(("constraining", ("young", "thickness", "density")))
        if self.core is not None:
            # How a free layer stretches depends on Poisson's ratio as on the modulus.
            layers.append(("core", ("thickness", "density")))
        return (*(f"{layer}_{n}" for layer, numbers in layers for n in numbers), "length")

    def parts(self) -> Parts:
        """For unit coefficients, on the basis of modes."""
        return _parts_of(replace(self, core=_without_law(self.core), tolerances={}))

    def coefficients(self, by: Mapping[str, float]) -> Complex:
        """Three of the faces' stiffness, three of slip, three of a free layer, six of inertia, the load.

        Shape (16,).
        """
        b, c, v = (self._moved(name, by) for name in ("substrate", "constraining", "core"))
        length = self.span_m
        L = length + by.get("length", 0.0) * (length / self.length_m)
        width = self.width_m * (2 if self.boundary == "centre-driven" else 1)
        E_b, h_b, m_b = _of_face(b)
        E_c, h_c, m_c = _of_face(c)
        H = v["thickness"] if v else 0.0
        m_v = v["density"] * H if v else 0.0
        # Bending of a beam alike on both sides: its middle does not stretch, and every coating counts twice.
        twice = 2 if self.is_doubled else 1
        m_c, m_v = twice * m_c, (twice if c else 1) * m_v
        K_0 = np.array(
            [E_b * h_b / L, twice * E_c * h_c / L, (E_b * h_b**3 + twice * E_c * h_c**3) / 12 / L**3]
        )
        slip, free = np.zeros(3), np.zeros(3)
        d, e = H + (h_b + h_c) / 2, (h_c - h_b) / 2
        if v and c:
            slip = twice * np.array([L / H, d / H, d**2 / H / L])
            inertia = [m_v / 4 * L, m_v / 4 * e, m_v / 4 * e**2 / L]
            mass = m_b + m_c + m_v
        else:
            sides = 2 if self.both_sides else 1
            low, high = h_b / 2, h_b / 2 + H
            first = 0.0 if self.both_sides else (high**2 - low**2) / 2
            moments = np.array([sides * H, first, sides * (high**3 - low**3) / 3])
            ratio = 2 * (1 + v["poisson"]) if v else 0.0
            free = ratio * moments / np.array([L, L**2, L**3])
            inertia = [0.0, 0.0, 0.0]
            mass = m_b + sides * m_v
        M = np.array([mass * L, m_b * L, m_c * L, *inertia])
        return np.asarray(width * np.concatenate([K_0, slip, free, M, [mass * L]]), complex)

    def _moved(self, name: str, by: Mapping[str, float]) -> dict[str, float]:
        layer = getattr(self, name)
        if layer is None:
            return {}
        values = {
            "young": getattr(layer, "young_pa", 0.0),
            "thickness": layer.thickness_m,
            "density": layer.density_kg_m3,
        }
        found = {key: value * float(np.exp(by.get(f"{name}_{key}", 0.0))) for key, value in values.items()}
        return found | {"poisson": layer.poisson, "loss": getattr(layer, "loss_factor", 0.0)}

    def tolerance(self, name: str) -> float:
        """Named, else typical."""
        return 0.0 if self.exact else float(self.tolerances.get(name, STATED[name].typical))

    def stated_number(self, kind: str) -> tuple[float, float, str]:
        """In SI, with the factor to the unit of results."""
        channels = {"gain": (1.0, 1.0, "1"), "delay": (0.0, 1e6, "us"), "length": (self.length_m, 1e3, "mm")}
        if kind in channels:
            return channels[kind]
        layer, _, quantity = kind.partition("_")
        name, factor, unit = {
            "young": ("young_pa", 1e-9, "GPa"),
            "thickness": ("thickness_m", 1e3, "mm"),
            "density": ("density_kg_m3", 1.0, "kg/m^3"),
        }[quantity]
        return getattr(getattr(self, layer), name), factor, unit


def _of_face(face: dict[str, float]) -> tuple[complex, float, float]:
    """E (1 + i eta), h and mass per area; zero for none."""
    if not face:
        return 0.0, 0.0, 0.0
    young = face["young"] * (1 + 1j * face["loss"]) if face["loss"] else face["young"]
    return young, face["thickness"], face["density"] * face["thickness"]


def _without_law(core: Core | None) -> Core | None:
    # The basis holds for every law: one for all of them is kept.
    return replace(core, law=None) if core is not None else None  # type: ignore[arg-type]


def _shapes(ends: Ends) -> tuple[list[Polynomial], list[Polynomial]]:
    """Polynomials of w and of u over 0 < x < 1 that meet the conditions at the ends."""
    x = Polynomial([0.0, 1.0])
    held = {
        "free-free": (Polynomial([1.0]), Polynomial([1.0])),
        "clamped-clamped": (x**2 * (1 - x) ** 2, x * (1 - x)),
    }.get(ends, (x**2, x))
    found = []
    for factor in held:
        legendre = [Legendre.basis(k, domain=[0.0, 1.0]).convert(kind=Polynomial) for k in range(ORDER)]
        found.append([factor * p for p in legendre])
    return found[0], found[1]


@lru_cache(maxsize=16)
def _full(ends: Ends) -> tuple[Array, Array, Array, Array]:
    """Matrices of K_0, K_1 and M over all polynomials of u_b, u_c and w, and the load.

    Shapes (parts, n, n), (n,).
    """
    w, u = _shapes(ends)
    x, weight = np.polynomial.legendre.leggauss(2 * ORDER)
    x, weight = (x + 1) / 2, weight / 2
    n = ORDER
    place = {"b": slice(0, n), "c": slice(n, 2 * n), "w": slice(2 * n, 3 * n)}

    def rows(which: str, derivative: int = 0) -> Array:
        found = np.zeros((3 * n, len(x)))
        shapes = w if which == "w" else u
        found[place[which]] = [(p.deriv(derivative) if derivative else p)(x) for p in shapes]
        return found

    def both(a: Array, b: Array) -> Array:
        return np.asarray((a * weight) @ b.T)

    def mixed(a: Array, b: Array) -> Array:
        return both(a, b) + both(b, a)

    def square(a: Array) -> Array:
        return both(a, a)

    slope, bend = rows("w", 1), rows("w", 2)
    across, sum_of = rows("c") - rows("b"), rows("c") + rows("b")
    K_0 = np.array([square(rows("b", 1)), square(rows("c", 1)), square(bend)])
    stretch = rows("b", 1)
    K_1 = np.array(
        [
            *(square(across), mixed(across, slope), square(slope)),
            *(square(stretch), -mixed(stretch, bend), square(bend)),
        ]
    )
    M = np.array(
        [
            *(square(rows("w")), square(rows("b")), square(rows("c"))),
            *(square(sum_of), mixed(sum_of, slope), square(slope)),
        ]
    )
    return K_0, K_1, M, -(rows("w") @ weight)


@lru_cache(maxsize=64)
def _basis(beam: Beam) -> Array:
    """Modes at a few moduli, and what rests. Shape (n, k)."""
    K_0, K_1, M, _ = _full(beam.boundary if beam.boundary != "centre-driven" else "clamped-free")
    c = beam.coefficients({}).real
    moving = np.ones(3 * ORDER, bool)
    if beam.constraining is None:
        moving[ORDER : 2 * ORDER] = False
    if beam.is_doubled:
        moving[:ORDER] = False
    kept = np.flatnonzero(moving)
    square = np.ix_(kept, kept)
    stiff, core, mass = (
        np.tensordot(part, P, axes=1)[square] for part, P in ((c[:3], K_0), (c[3:9], K_1), (c[9:15], M))
    )
    # Equal sizes of all polynomials: their squares differ by many orders.
    size = 1 / np.sqrt(np.diag(mass))
    found = []
    for G in _MODULI_PA if beam.core is not None else (0.0,):
        K = (stiff + G * core) * np.outer(size, size)
        _, V = la.eigh(K, mass * np.outer(size, size), subset_by_index=[0, min(_MODES, len(kept)) - 1])
        found.append(V)
    whole = np.hstack(found)
    Q, s, _ = np.linalg.svd(whole / np.linalg.norm(whole, axis=0), full_matrices=False)
    Q = Q[:, s > _NEGLIGIBLE * s[0]]
    V = np.zeros((3 * ORDER, Q.shape[1]))
    V[kept] = size[:, None] * Q
    return V


@lru_cache(maxsize=64)
def _parts_of(beam: Beam) -> Parts:
    ends: Ends = beam.boundary if beam.boundary != "centre-driven" else "clamped-free"
    V = _basis(beam)
    K_0, K_1, M, load = _full(ends)
    w, _ = _shapes(ends)
    at = (beam.pickup_m or 0.0) / beam.span_m
    observe = V[2 * ORDER :].T @ np.array([p(min(at, 1.0)) for p in w])
    if beam.pickup_m is None:
        observe = 0 * observe
    if ends == "free-free":
        load = 0 * load
    project = [np.array([V.T @ P @ V for P in stack]) for stack in (K_0, K_1, M)]
    k = V.shape[1]
    strain = {}
    if beam.core is not None and beam.constraining is not None:
        c = beam.coefficients({})[3:6].real
        shear = np.tensordot(c, project[1][:3], axes=1)
        width = beam.width_m * (2 if beam.boundary == "centre-driven" else 1)
        volume = width * beam.span_m * beam.core.thickness_m * (2 if beam.is_doubled else 1)
        strain = {"strain.mean_square": shear / volume}
    return Parts(
        K_0=project[0],
        K_1=project[1],
        M=project[2],
        load=(V.T @ load)[None],
        observe=observe,
        matrices=strain,
        deflection=np.zeros((4, 3, k)),
        size=(beam.span_m, beam.width_m, 1, 1),
        pickup_m=(at * beam.span_m, 0.0),
    )
