"""What was measured of each file beside what one law has there. No Qt."""

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from fitting.arrays import Array, Mask
from gui.actions.together import Fitted
from instrument.facts.diagnosis import DiagnosisResult, PointLeft, StageName
from instrument.facts.identification import IdentificationResult, PointFitted
from instrument.facts.modal import ModalResult
from instrument.facts.rows import PointSetAside

FAR_STD = 3.0
"""Standard deviations of noise and model error beyond which a point counts as not explained: of 1000 points
that are explained three are so far off."""


@dataclass(frozen=True)
class FittedFile:
    """One file. Shape (points,) each, ascending in frequency in each segment, NaN between segments."""

    number: int
    """From 1."""
    name: str
    frequency_hz: Array
    measured: Array
    predicted_hz: Array
    """Where the fit has it: of modes another frequency than the measured one."""
    predicted: Array
    far: Mask
    """Points further than `FAR_STD` off."""
    aside_hz: Array = field(default_factory=lambda: np.zeros(0))
    """Of readings that are not fitted. Shape (readings,)."""
    aside: Array = field(default_factory=lambda: np.zeros(0))

    @property
    def title(self) -> str:
        """Number and name."""
        return f"{self.number} {self.name}"

    @property
    def difference_percent(self) -> Array:
        """Fitted over measured, less one."""
        return np.asarray(100 * (self.predicted / self.measured - 1))


def fitted_files(
    fit: Fitted,
    diagnosed: DiagnosisResult | None = None,
    stage: StageName = "before",
    *,
    names: Sequence[str] = (),
) -> list[FittedFile]:
    """Each file of a fit; with a diagnosis the fit of one of its stages, at the points it has.

    `names` are those of the files, for a result that says none: one of a single file.
    """
    if isinstance(fit, ModalResult):
        return _of_modes(fit)
    left = _by_place(diagnosed.points) if diagnosed is not None else None
    names = fit.files or names or ("",)
    numbers = sorted({_number(p) for p in fit.points})
    return [_of_points(fit, n, names[n - 1], left, stage) for n in numbers]


def has_stages(fit: Fitted) -> bool:
    """Whether a diagnosis says what each of its fits leaves of every point: of tables it does not."""
    return isinstance(fit, IdentificationResult)


_Place = tuple[int, int | None, int, float]


def _number(point: PointFitted | PointLeft | PointSetAside) -> int:
    return point.file or 1


def _place(point: PointFitted | PointLeft) -> _Place:
    return _number(point), point.pickup, point.segment, point.frequency_hz


def _by_place(points: Sequence[PointLeft]) -> dict[_Place, list[PointLeft]]:
    """Several passes have points at one place, in the same order in both results."""
    found: dict[_Place, list[PointLeft]] = defaultdict(list)
    for point in points:
        found[_place(point)].append(point)
    return found


def _of_points(
    fit: IdentificationResult,
    number: int,
    name: str,
    left: dict[_Place, list[PointLeft]] | None,
    stage: StageName,
) -> FittedFile:
    rows: list[tuple[float, float, float, bool]] = []
    own = [p for p in fit.points if _number(p) == number]
    taken: dict[_Place, int] = defaultdict(int)
    for segment, pickup in sorted({(p.segment, p.pickup or 0) for p in own}):
        if rows:
            rows.append((np.nan, np.nan, np.nan, False))
        inside = [p for p in own if (p.segment, p.pickup or 0) == (segment, pickup)]
        for p in sorted(inside, key=lambda p: p.frequency_hz):
            predicted, far = p.predicted_m_s, False
            if left is not None:
                place = _place(p)
                its, k = left.get(place, []), taken[place]
                taken[place] += 1
                predicted = np.nan
                if k < len(its):
                    residual = its[k].stage(stage)
                    predicted = p.measured_m_s * (1 + residual.amplitude_percent / 100)
                    far = bool(max(map(abs, residual.whitened), default=0.0) > FAR_STD)
            rows.append((p.frequency_hz, p.measured_m_s, predicted, far))
    f, measured, fitted, far_off = (np.array(column) for column in zip(*rows, strict=True))
    out = [p for p in fit.points_set_aside if _number(p) == number]
    aside_hz, aside = (np.array([getattr(p, key) for p in out]) for key in ("frequency_hz", "measured_m_s"))
    return FittedFile(number, name, f, measured, f, fitted, far_off.astype(bool), aside_hz, aside)


def _of_modes(fit: ModalResult) -> list[FittedFile]:
    found = []
    for number, name in enumerate(fit.files, start=1):
        own = [m for m in fit.modes if m.file == number]
        measured_hz, measured, predicted_hz, predicted = (
            np.array([getattr(m, key) for m in own])
            for key in ("frequency_hz", "loss_factor", "predicted_hz", "predicted_loss_factor")
        )
        none = np.zeros(len(own), dtype=bool)
        found.append(FittedFile(number, name, measured_hz, measured, predicted_hz, predicted, none))
    return found
