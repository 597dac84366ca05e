"""G'(f) and eta(f) with their standard errors, from the rows of a fit or a diagnosis. No Qt."""

from collections.abc import Sequence
from dataclasses import dataclass, fields
from functools import cached_property
from typing import TypeVar

import numpy as np
from scipy.interpolate import CubicSpline

from fitting.arrays import Array
from fitting.identification.quoted import quoted_hz
from fitting.laws import CoreLaw
from fitting.sweep import segments_by_gap
from instrument.facts.diagnosis import PointLeft
from instrument.facts.identification import PointFitted
from instrument.facts.rows import LawRow

P = TypeVar("P", PointFitted, PointLeft)

_SAME = 1e-9


@dataclass(frozen=True)
class At:
    """The law at one frequency."""

    storage_mpa: float
    storage_error_mpa: float
    loss: float
    loss_error: float


@dataclass(frozen=True)
class LawCurve:
    """Ascending in frequency; errors are standard errors, NaN where there is none. Shape (rows,) each."""

    frequency_hz: Array
    storage_mpa: Array
    storage_error_mpa: Array
    loss: Array
    loss_error: Array

    @classmethod
    def of(cls, rows: Sequence[LawRow]) -> "LawCurve":
        """From the law of an identification, or of a diagnosis's stage."""
        return cls(
            np.array([row.frequency_hz for row in rows], dtype=float),
            1e-6 * np.array([row.storage_modulus_pa for row in rows], dtype=float),
            1e-6 * np.array([row.storage_modulus_standard_error_pa for row in rows], dtype=float),
            np.array([row.loss_factor for row in rows], dtype=float),
            np.array([row.loss_factor_standard_error for row in rows], dtype=float),
        )

    @classmethod
    def stated(cls, law: CoreLaw, frequency_hz: Array) -> "LawCurve":
        """Of a law whose errors nobody states."""
        G, eta = law.storage_and_loss(2 * np.pi * frequency_hz)
        unknown = np.full(len(frequency_hz), np.nan)
        return cls(frequency_hz, 1e-6 * G, unknown, eta, unknown)

    def at(self, frequency_hz: float) -> At | None:
        """Between the rows by a spline over log f, errors linearly; None outside the measured range."""
        f = self.frequency_hz
        if not len(f) or not f[0] * (1 - _SAME) <= frequency_hz <= f[-1] * (1 + _SAME):
            return None
        x = float(np.log(frequency_hz))
        errors = (np.interp(x, self._x, e) for e in (self.storage_error_mpa, self.loss_error))
        storage_error, loss_error = (float(e) for e in errors)
        if len(f) < 2:
            return At(float(self.storage_mpa[0]), storage_error, float(self.loss[0]), loss_error)
        storage, loss = (float(v) for v in self._spline(x))
        return At(storage, storage_error, loss, loss_error)

    @cached_property
    def _x(self) -> Array:
        return np.log(self.frequency_hz)

    @cached_property
    def _spline(self) -> CubicSpline:
        return CubicSpline(self._x, np.stack([self.storage_mpa, self.loss], axis=1))


def joined(curves: Sequence[LawCurve]) -> LawCurve:
    """Several as one, a gap after each: drawn as one line they stay apart."""
    gap = np.array([np.nan])
    if not curves:
        return LawCurve(*(gap[:0] for _ in fields(LawCurve)))
    return LawCurve(
        *(np.concatenate([p for c in curves for p in (getattr(c, f.name), gap)]) for f in fields(LawCurve))
    )


def resonances_hz(points: Sequence[PointFitted]) -> dict[int, float]:
    """Segment to the frequency of its largest measured response; `points` of an identification.

    A sentinel far off its segment's other points is not asked; a segment without a peak in it has none.
    """
    found = {}
    for number in sorted({p.segment for p in points}):
        near = together([p for p in points if p.segment == number])
        peak = max(near, key=lambda p: p.measured_m_s)
        if near[0].frequency_hz < peak.frequency_hz < near[-1].frequency_hz:
            found[number] = peak.frequency_hz
    return found


def together(points: Sequence[P]) -> list[P]:
    """Of one segment: the largest cluster, ascending in frequency; a sentinel far off is left out."""
    points = sorted(points, key=lambda p: p.frequency_hz)
    cluster = segments_by_gap(np.array([p.frequency_hz for p in points], dtype=float))
    largest = np.bincount(cluster).argmax()
    return [p for p, c in zip(points, cluster, strict=True) if c == largest]


def places_hz(resonances: dict[int, float], curve: LawCurve) -> list[tuple[float, str]]:
    """Where the law is stated in numbers: frequency, and what is there."""
    places = [(f, "") for f in quoted_hz(curve.frequency_hz)]
    places += [(f, f"peak of segment {n}") for n, f in resonances.items()]
    return sorted(p for p in places if curve.at(p[0]) is not None)
