"""What a fit, and a diagnosis with its effects, say at the session's own points. No Qt."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Self

import numpy as np

from fitting.arrays import Array, Mask
from gui.actions.rediagnosis import ShownDiagnosis
from gui.pages.sweep.points import Index, PointsMeasured
from instrument.facts.diagnosis import PointLeft, Residual
from instrument.facts.identification import PointFitted
from instrument.results.standing import fit_words, stage_before
from instrument.stream.derived import FitUpdated, PointMeasured


def _none() -> Array:
    return np.zeros(0)


@dataclass(frozen=True)
class Predicted:
    """Of the points that were taken: their numbers, and what is said of them. Shape (taken,) each."""

    index: Index = field(default_factory=lambda: np.zeros(0, dtype=np.intp))
    amplitude_m_s: Array = field(default_factory=_none)
    """At the level commanded."""
    turn_deg: Array = field(default_factory=_none)
    """Phase less the measured one, -180 to 180; NaN where only amplitudes are known."""
    name: str = ""
    """For the legend, `with clamp_compliance`; empty of a fit."""

    @classmethod
    def by_fit(cls, points: PointsMeasured, fit: FitUpdated | None, left_out: Mask) -> Self:
        """What the law of a live fit predicts, without any effect.

        Empty where there is none, or its rows do not belong to these points. `left_out` are points that the
        fit has set aside, shape (points,).
        """
        if fit is None or fit.result is None:
            return cls()
        rows = fit.result.points
        taken = taken_of(points, rows, fit.last_step, left_out)
        if taken is None:
            return cls()
        return cls(
            taken, np.array([row.predicted_m_s for row in rows], dtype=float), np.full(len(taken), np.nan)
        )

    @classmethod
    def with_effects(
        cls, points: PointsMeasured, shown: ShownDiagnosis | None, last_step: int | None, left_out: Mask
    ) -> Self:
        """The law with the effects accepted. Empty where none are, or its rows do not belong to these points.

        `last_step` is the last that the session's own diagnosis took; one made here took all points.
        `left_out` are points that the diagnosis has set aside, shape (points,).
        """
        if shown is None or stage_before(shown.found) is None:
            return cls()
        rows = shown.found.points
        if all(row.after == row.before for row in rows):
            return cls()
        taken = taken_of(points, rows, last_step if shown.asked is None else None, left_out)
        if taken is None:
            return cls()
        off = np.array([row.after.amplitude_percent for row in rows], dtype=float)
        measured = np.abs(points.over_base_s[taken]) * points.level_m_s2[taken]
        turn = np.array([_turn_deg(row.after) for row in rows], dtype=float)
        name = shown.in_legend(f"with {fit_words(shown.found)}")
        return cls(taken, measured * (1 + off / 100), turn, name)

    def of(self, point: int) -> float | None:
        """Amplitude of one point, if it was taken."""
        place = np.flatnonzero(self.index == point)
        return float(self.amplitude_m_s[place[0]]) if place.size else None


def taken_of(
    points: PointsMeasured,
    rows: Sequence[PointFitted | PointLeft],
    last_step: int | None,
    left_out: Mask,
) -> Index | None:
    """Number of the point that each row of a result is of; None where they do not belong to these points.

    `left_out` are points that the result has set aside, shape (points,). Shape (rows,).
    """
    taken = [k for k in _in_order_of_rows(points, last_step) if not left_out[k]]
    fits = len(rows) == len(taken) and all(
        _is_row_of(row, points.timed[k].point) for k, row in zip(taken, rows, strict=True)
    )
    return np.array(taken, dtype=np.intp) if fits else None


def _is_row_of(row: PointFitted | PointLeft, point: PointMeasured) -> bool:
    return row.frequency_hz == point.frequency_hz and (row.pickup is None or row.pickup == point.pickup)


def _in_order_of_rows(points: PointsMeasured, last_step: int | None) -> list[int]:
    """Numbers up to a step as a result has them: by mounting and mass as they came, then by spot."""
    came: dict[tuple[int, float, tuple[float, float] | None], int] = {}
    taken = []
    for k, t in enumerate(points.timed):
        p = t.point
        if last_step is None or p.step <= last_step:
            taken.append((came.setdefault((p.mounting, p.mass_kg, p.mass_at_mm), len(came)), p.pickup, k))
    return [k for _, _, k in sorted(taken)]


def _turn_deg(left: Residual) -> float:
    return float(np.degrees(np.angle(complex(100 + left.re_percent, left.im_percent))))
