"""What the panes show at this moment: points, which of them, the model, the point looked at. No Qt."""

from dataclasses import dataclass, field, replace
from typing import Literal, Self

import numpy as np

from fitting.arrays import Array, Complex, Mask
from fitting.gravity import PUBLISHED_G_M_S2
from gui.pages.sweep.curve import Curve, CurveStretch
from gui.pages.sweep.overlay import OverlaidSweep
from gui.pages.sweep.points import PointsMeasured
from gui.pages.sweep.predicted import Predicted
from instrument.check.piece import Region
from instrument.files.acceleration import acceleration_unit
from instrument.session.points import elsewhere

Quantity = Literal["ratio", "velocity"]


@dataclass(frozen=True)
class Way:
    """How the response is shown."""

    quantity: Quantity = "ratio"
    """Velocity over base acceleration, or that times the level commanded."""
    log_amplitude: bool = False
    log_frequency: bool = False

    @property
    def unit(self) -> str:
        """Unit of the amplitude's axis."""
        return f"(mm/s)/{acceleration_unit().under}" if self.quantity == "ratio" else "mm/s"

    @property
    def label(self) -> str:
        """Name of the amplitude's axis."""
        return "|v/a|" if self.quantity == "ratio" else "|v| at its level"

    def factor(self, level_m_s2: Array | float) -> Array:
        """From v/a in s to what is shown. Shape of the levels."""
        ratio = acceleration_unit().m_s2 * np.ones_like(level_m_s2)
        return np.asarray(1e3 * (ratio if self.quantity == "ratio" else level_m_s2))


@dataclass(frozen=True)
class PaneContents:
    """Everything a pane needs; a pane never looks elsewhere."""

    points: PointsMeasured
    segment: int | None = None
    """None: all of them."""
    regions: tuple[Region, ...] = ()
    """Of the segments known of, begun or not."""
    curve: Curve | None = None
    predicted: Predicted = field(default_factory=Predicted)
    """By the fit."""
    explained: Predicted = field(default_factory=Predicted)
    """By the diagnosis shown, with the effects that it accepts."""
    foreseen: Curve | None = None
    """Of the specimen as it is stated, known before anything is measured."""
    fit: int = 0
    """Number of the fit `curve` and `predicted` are of."""
    doubt: str = ""
    """Why what is drawn of the fit is not to be relied on; empty where it may be."""
    beside: tuple[OverlaidSweep, ...] = ()
    chosen: int | None = None
    """Number of the point looked at."""
    way: Way = field(default_factory=Way)
    planned_m_s2: float = PUBLISHED_G_M_S2
    """Level of the sweep as its file has it."""
    reads: str = "relative"
    """What the laser reads: velocity relative to the base, or absolute."""

    @property
    def fit_name(self) -> str:
        """Of what is drawn of the fit."""
        return f"fit {self.fit}" + (f", {self.doubt}" if self.doubt else "")

    @property
    def whose(self) -> str:
        """Of which spot and clamping a curve is, where there are points of others; begins with a comma."""
        timed = zip(self.points.timed, self.points.sentinel, strict=True)
        steps = [t.point for t, is_sentinel in timed if not is_sentinel]
        said = ", spot of the specimen file" if any(elsewhere(p) for p in steps) else ""
        return said + (", first clamping" if any(p.mounting for p in steps) else "")

    def stretches(self, curve: Curve | None) -> list[CurveStretch]:
        """Of the segment chosen, without those that have points only of other spots, masses or clampings."""
        if curve is None:
            return []
        return [s for s in curve.of_segments(self.segment) if self.levels(s.segment).size]

    @property
    def wanted(self) -> Mask:
        """Points of the segment chosen; a sentinel that lies elsewhere is left out. Shape (points,)."""
        p = self.points
        if self.segment is None:
            return np.ones(len(p), dtype=bool)
        low, high = self.band_hz or (0.0, np.inf)
        inside = (p.frequency_hz >= low) & (p.frequency_hz <= high)
        return np.asarray((p.segment == self.segment) & (inside | ~p.sentinel))

    @property
    def band_hz(self) -> tuple[float, float] | None:
        """The whole region of the segment chosen, measured or not; None for all of them."""
        mine = [(low, high) for number, low, high in self.regions if number == self.segment]
        return mine[0] if mine else None

    @property
    def chosen_here(self) -> int | None:
        """The point looked at, where it is one of those wanted."""
        return self.chosen if self.chosen is not None and self.wanted[self.chosen] else None

    @property
    def shown(self) -> Complex:
        """Response of every point, in the unit of the way chosen. Shape (points,)."""
        return np.asarray(self.points.over_base_s * self.way.factor(self.points.level_m_s2))

    def levels(self, segment: int) -> Array:
        """Levels in m/s^2 of a segment's points that were read as the specimen file says.

        Where none of it are measured yet, of all, or the one planned. Shape (levels,): none where all of
        its points were read elsewhere.
        """
        p = self.points
        mine = p.segment == segment
        if not len(p):
            return np.array([self.planned_m_s2])
        if mine.any():
            mine &= p.read_at("")
            return np.unique(np.round(p.level_m_s2[mine], 6))
        return np.unique(np.round(p.level_m_s2, 6))

    def neighbour(self, by: int) -> int | None:
        """The point so many places further along the frequency; the first or last where there is none."""
        order = self.points.in_order(self.wanted)
        if not order.size:
            return None
        place = np.flatnonzero(order == self.chosen)
        at = int(place[0]) + by if place.size else (0 if by > 0 else len(order) - 1)
        return int(order[min(max(at, 0), len(order) - 1)])

    def but(self, **changes: object) -> Self:
        """A copy of these contents with some changes."""
        return replace(self, **changes)  # type: ignore[arg-type]
