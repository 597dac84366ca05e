"""A clamped-free sandwich beam by finite elements of its own: w cubic, both faces' stretching quadratic.

Mead and Markus' assumptions. It shares nothing with the beam that is fitted.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.linalg as la
from numpy.polynomial import Polynomial

_W = [Polynomial(c) for c in ([1, 0, -3, 2], [0, 1, -2, 1], [0, 0, 3, -2], [0, 0, -1, 1])]
_U = [Polynomial(c) for c in ([1, -3, 2], [0, 4, -4], [0, -1, 2])]
_ELEMENTS = 16


@dataclass(frozen=True)
class Sandwich:
    """Faces 1 and 3 about a core, in SI units, of unit width."""

    length_m: float
    thickness_m: tuple[float, float, float]
    young_pa: tuple[float, float]
    density_kg_m3: tuple[float, float, float]

    def matrices(self):
        """Of the faces' stiffness, of slip for a modulus of one, and of mass, held at x = 0."""
        (h_1, h_2, h_3), (E_1, E_3), rho = self.thickness_m, self.young_pa, self.density_kg_m3
        L, n = self.length_m / _ELEMENTS, _ELEMENTS
        in_w, in_u = 2 * (n + 1), 2 * n + 1
        K, S, M = (np.zeros((in_w + 2 * in_u,) * 2) for _ in range(3))
        z, weight = np.polynomial.legendre.leggauss(6)
        z, weight = (z + 1) / 2, weight / 2 * L
        size = [1.0, L, 1.0, L]
        w, dw, ddw = (np.array([s * p.deriv(d)(z) for s, p in zip(size, _W, strict=True)]) for d in range(3))
        u, du = (np.array([p.deriv(d)(z) for p in _U]) for d in range(2))
        dw, ddw, du = dw / L, ddw / L**2, du / L
        for e in range(n):
            at_w = list(range(2 * e, 2 * e + 4))
            at_1 = [in_w + 2 * e + k for k in range(3)]
            at_3 = [k + in_u for k in at_1]
            K[np.ix_(at_w, at_w)] += (E_1 * h_1**3 + E_3 * h_3**3) / 12 * (ddw * weight) @ ddw.T
            K[np.ix_(at_1, at_1)] += E_1 * h_1 * (du * weight) @ du.T
            K[np.ix_(at_3, at_3)] += E_3 * h_3 * (du * weight) @ du.T
            M[np.ix_(at_w, at_w)] += np.dot(rho, self.thickness_m) * (w * weight) @ w.T
            M[np.ix_(at_1, at_1)] += rho[0] * h_1 * (u * weight) @ u.T
            M[np.ix_(at_3, at_3)] += rho[2] * h_3 * (u * weight) @ u.T
            slip = np.vstack([(h_2 + (h_1 + h_3) / 2) * dw, -u, u]) / h_2
            every = at_w + at_1 + at_3
            S[np.ix_(every, every)] += h_2 * (slip * weight) @ slip.T
        kept = np.setdiff1d(np.arange(len(K)), [0, 1, in_w, in_w + in_u])
        return tuple(A[np.ix_(kept, kept)] for A in (K, S, M))

    def modes(self, law, count, stiffer=1.0):
        """F in Hz and loss factor, `law` of rad/s at each mode's own frequency. Shape (count,) each."""
        K, S = self._few
        found, omega = [], 2 * np.pi * 50
        for k in range(count):
            for _ in range(60):
                values = np.linalg.eigvals(stiffer * K + law(omega) * S)
                value = values[np.argsort(values.real)][k]
                before, omega = omega, float(np.sqrt(value.real))
                if abs(omega - before) < 1e-10 * omega:
                    break
            found.append((omega / (2 * np.pi), value.imag / value.real))
        return np.array(found).T

    @cached_property
    def _few(self):
        """On real modes of a few moduli, as an ordinary problem."""
        K, S, M = self.matrices()
        V = np.hstack([la.eigh(K + G * S, M, subset_by_index=[0, 7])[1] for G in np.geomspace(3e4, 3e9, 7)])
        Q, s, _ = la.svd(V / np.linalg.norm(V, axis=0), full_matrices=False)
        Q = Q[:, s > 1e-7 * s[0]]
        back = la.inv(la.cholesky(Q.T @ M @ Q, lower=True))
        return tuple(back @ Q.T @ A @ Q @ back.T for A in (K, S))
