"""Law, shifts and stated numbers fitted to the responses of all temperatures at once.

    chi2 = sum over sweeps of |whitened readings - prediction|^2 + |z|^2 + |b|^2

with G*_k(omega) = b_k G*(a_T omega) at temperature k. The plate is one, its stated numbers are counted once;
gain and delay are each sweep's own.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.optimize import least_squares
from scipy.stats import chi2 as chi_square

from fitting.arrays import Array
from fitting.bent_law import BentLaw
from fitting.diagnosis.begin import Begun
from fitting.diagnosis.response import SweepResponse
from fitting.identification.uncertainty import limits_reached
from fitting.laws import CoreLaw
from fitting.temperature.shifted_law import ShiftedLaw
from fitting.temperature.shifts import Shift
from fitting.temperature.start import start_of

_OF_EACH_SWEEP = ("gain", "delay")
_MOST_EVALUATIONS = 60
"""A bound on time; what has not come to its end by then says `converged = False`."""
_VERTICAL = 0.5
"""Largest ln b looked at."""


@dataclass(frozen=True)
class ShiftedFit:
    """Where the joint fit ended."""

    law: CoreLaw
    """At the reference temperature."""
    shift: Shift
    parameters: Array
    """Of the shift."""
    parameter_errors: Array
    log_shift: Array
    """Ln a_T of every sweep."""
    log_shift_errors: Array
    log_vertical: Array
    log_vertical_errors: Array
    law_covariance: Array
    """Of the law's log parameters."""
    chi2: float
    chi2_free: float
    """Of the sweeps, each with a law of its own."""
    degrees: float
    """How many effective parameters fewer one law has, those with priors by what the data ask of them."""
    noise_known: bool
    converged: bool

    @property
    def p_value(self) -> float:
        """Chance that one law fits so much worse than many, were there one."""
        if not self.noise_known:
            return float("nan")
        return float(chi_square.sf(max(self.chi2 - self.chi2_free, 0.0), self.degrees))


class _Joint:
    def __init__(self, begun: Sequence[Begun], law: CoreLaw, shift: Shift, *, vertical: bool) -> None:
        self.begun, self.law, self.shift = begun, law, shift
        self.responses = [SweepResponse(b.problem, ()) for b in begun]
        self.n, self.m = len(law.names), len(shift.names)
        reference = np.abs(shift.temperature_c - shift.reference_c)
        moved = sorted({float(t) for t in shift.temperature_c} - {_nearest(shift, reference)})
        self.vertical = [moved.index(float(t)) if t in moved else -1 for t in shift.temperature_c]
        self.v = len(moved) if vertical else 0
        keys: dict[tuple[str, int], int] = {}
        self.places = []
        for k, b in enumerate(begun):
            at = [
                keys.setdefault((q.name, k if q.kind in _OF_EACH_SWEEP else -1), len(keys))
                for q in b.problem.nuisances.each
            ]
            self.places.append(np.array(at, dtype=np.intp))
        self.z = len(keys)
        self._last: tuple[bytes, Array, Array] | None = None

    @cached_property
    def limits(self) -> tuple[Array, Array]:
        low, high = self.law.log_limits
        s = self.shift.scales
        return (
            np.concatenate([low, self.shift.lowest / s, np.full(self.v, -_VERTICAL), np.full(self.z, -12.0)]),
            np.concatenate([high, self.shift.highest / s, np.full(self.v, _VERTICAL), np.full(self.z, 12.0)]),
        )

    def start(self, p: Array) -> Array:
        z = np.zeros(self.z)
        for b, at in zip(self.begun, self.places, strict=True):
            z[at] += b.none.z / len(self.begun)
        return np.concatenate([np.log(self.law.values), p / self.shift.scales, np.zeros(self.v), z])

    def vertical_of(self, x: Array) -> Array:
        found = np.zeros(len(self.begun))
        if self.v:
            own = x[self.n + self.m : self.n + self.m + self.v]
            found = np.array([own[k] if k >= 0 else 0.0 for k in self.vertical])
        return found

    def both(self, x: Array) -> tuple[Array, Array]:
        key = x.tobytes()
        if self._last is None or self._last[0] != key:
            self._last = key, *self._both(x)
        return self._last[1:]

    def _both(self, x: Array) -> tuple[Array, Array]:
        n, m, v = self.n, self.m, self.v
        law, p = self.law.with_logs(x[:n]), x[n : n + m] * self.shift.scales
        log_a, slope = self.shift.log_shift(p), self.shift.slope(p) * self.shift.scales
        log_b, z = self.vertical_of(x), x[n + m + v :]
        rows, blocks = [], []
        for k, (b, response, at) in enumerate(zip(self.begun, self.responses, self.places, strict=True)):
            here = ShiftedLaw(law, float(np.exp(log_a[k])), float(np.exp(log_b[k])))
            read, dv = response.with_derivatives(here, z[at])
            J = b.evidence.jacobian(read, dv)
            block = np.zeros((len(J), len(x)))
            block[:, :n] = J[:, :n]
            block[:, n : n + m] = np.outer(J[:, n], slope[k])
            if v and self.vertical[k] >= 0:
                block[:, n + m + self.vertical[k]] = J[:, n + 1]
            block[:, n + m + v + at] = J[:, n + 2 :]
            rows.append(b.evidence.residuals(read))
            blocks.append(block)
        prior = np.zeros((self.z, len(x)))
        prior[:, n + m + v :] = np.eye(self.z)
        bend = np.zeros((law.bend_count, len(x)))
        bend[:, n - law.bend_count : n] = np.eye(law.bend_count)
        rows += [z, x[n - law.bend_count : n]]
        return np.concatenate(rows), np.vstack([*blocks, prior, bend])


def _nearest(shift: Shift, off: Array) -> float:
    return float(shift.temperature_c[int(np.argmin(off))])


def fit_shifted(begun: Sequence[Begun], shift: Shift, *, vertical: bool = False) -> ShiftedFit:
    """One law and its shifts; `begun` are the fits of each sweep by itself."""
    bands = [
        (float(b.problem.sweep.frequency_hz.min()), float(b.problem.sweep.frequency_hz.max())) for b in begun
    ]
    plain, log_a = start_of([b.none.law for b in begun], bands, shift.temperature_c, shift.reference_c)
    p = shift.near(log_a)
    law: CoreLaw = plain
    if not begun[0].problem.specimen.exact:
        a = np.exp(shift.log_shift(p))
        reduced = np.array([f * a_k for band, a_k in zip(bands, a, strict=True) for f in band])
        law = BentLaw.over(plain, reduced)
    joint = _Joint(begun, law, shift, vertical=vertical)
    low, high = joint.limits
    found = least_squares(
        lambda x: joint.both(x)[0],
        np.clip(joint.start(p), low + 1e-12, high - 1e-12),
        jac=lambda x: joint.both(x)[1],
        bounds=(low, high),
        x_scale="jac",
        ftol=1e-6,
        xtol=1e-6,
        max_nfev=_MOST_EVALUATIONS,
    )
    return _result(joint, found.x, converged=bool(found.status > 0))


def _result(joint: _Joint, x: Array, *, converged: bool) -> ShiftedFit:
    r, J = joint.both(x)
    n, m, v = joint.n, joint.m, joint.v
    law, p = joint.law.with_logs(x[:n]), x[n : n + m] * joint.shift.scales
    own = len(law.plain.names)
    data = sum(b.evidence.count for b in joint.begun)
    dof = max(data - own - m - v, 1)
    known = all(b.evidence.scale_known for b in joint.begun)
    misfit = float(np.sum(r[:data] ** 2) / dof)
    scale = max(1.0, misfit) if known else misfit
    C = _covariance(J / np.sqrt(scale), law)
    at_p = C[n : n + m, n : n + m] * np.outer(joint.shift.scales, joint.shift.scales)
    slope = joint.shift.slope(p)
    vertical_errors = np.zeros(len(joint.begun))
    if v:
        sizes = np.sqrt(np.diag(C)[n + m : n + m + v])
        vertical_errors = np.array([sizes[k] if k >= 0 else 0.0 for k in joint.vertical])
    return ShiftedFit(
        law,
        joint.shift,
        p,
        np.sqrt(np.diag(at_p)),
        joint.shift.log_shift(p),
        np.sqrt(np.maximum(np.einsum("ki,ij,kj->k", slope, at_p, slope), 0.0)),
        joint.vertical_of(x),
        vertical_errors,
        C[:n, :n],
        float(r @ r),
        float(sum(b.none.chi2 for b in joint.begun)),
        max(1.0, sum(_effective(b.none.jacobian, b.none.data) for b in joint.begun) - _effective(J, data)),
        known,
        converged,
    )


def _effective(J: Array, data: int) -> float:
    """Trace of the hat matrix of the readings."""
    size = np.linalg.norm(J, axis=0)
    U, s, _ = np.linalg.svd(J / np.where(size > 0, size, 1.0), full_matrices=False)
    return float(np.sum(U[:data, s > 1e-12 * s.max()] ** 2))


def _covariance(J: Array, law: CoreLaw) -> Array:
    """Of what is not at its limit; the law's ranges of search bound what the data leave open."""
    fixed = limits_reached(law)
    kept = np.array([name not in fixed for name in law.names] + [True] * (J.shape[1] - len(law.names)))
    ranges = np.zeros((len(law.search_widths), J.shape[1]))
    ranges[:, : len(ranges)] = np.diag(1 / law.search_widths)
    J = np.vstack([J, ranges])[:, kept]
    size = np.linalg.norm(J, axis=0)
    size = np.where(size > 0, size, 1.0)
    _, s, Vt = np.linalg.svd(J / size, full_matrices=False)
    root = Vt.T / np.maximum(s, 1e-12 * s.max()) / size[:, None]
    found = np.zeros((len(kept), len(kept)))
    found[np.ix_(kept, kept)] = root @ root.T
    return found
