"""What an experiment is going to look like, from the specimen as it is known: modes, response, decay, times.

On a coarse mesh: a range or a waiting time needs no third digit.
"""

from dataclasses import dataclass, replace
from functools import cached_property, lru_cache

import numpy as np

from drivers.vibrometer import Range
from fitting.arrays import Array
from fitting.dynamics.damping import LowRankDamping, viscous_damping
from fitting.dynamics.half_plate import HalfPlate
from fitting.gravity import PUBLISHED_G_M_S2
from fitting.identification.model import velocity
from fitting.plate.plate import Plate
from fitting.specimen import PlateSpecimen
from fitting.structures import AnySpecimen, Beam, ShearPair
from fitting.structures.small_modes import small_modes, small_velocity
from instrument.errors import BadInput
from instrument.files.experiment_file import SegmentSection, SweepTable
from instrument.models.specimen_modes import specimen_modes
from instrument.stepped_sine.expected_time import loop_checks_s, step_s
from instrument.stepped_sine.plan import PlannedSegment
from instrument.stepped_sine.settings import SweepSettings

_COARSE = (20, 14)
"""Elements along each side: a forecast of times and ranges needs no more. A choice."""
_MODES = 12
"""Of the treated plate, more than segments are usually laid around."""
_SMALL_MODES = 8
"""Of a beam or a pair: within what its polynomials resolve."""
_MOST_SOLVED = 25
"""Frequencies of a segment; a resonance of a damped plate is wider than their spacing."""
_MOST_STEPS = 5000
"""Of a segment."""
_REACH = 1.3
"""Modes up to this times the frequency count for the transient: higher ones decay faster."""
_ROOM = 2.0
"""A range holds so many times the predicted response."""
_CALIBRATION_SHARE = 0.5
"""Of a range's full scale, in calibration."""
OWN_RATIO = 1e-3
"""Viscous damping assumed where the specimen states none."""


@dataclass(frozen=True)
class Forecast:
    """What an experiment with one specimen is expected to do."""

    specimen: AnySpecimen
    mode_hz: Array
    mode_decay_1_s: Array
    """sigma of each mode's free decay."""

    @classmethod
    @lru_cache(maxsize=8)
    def of(cls, specimen: AnySpecimen) -> "Forecast":
        """Modes of the specimen with the law it starts from."""
        if not isinstance(specimen, PlateSpecimen):
            return cls._of_small(specimen)
        coarse = replace(specimen, elements=specimen.elements or _COARSE)
        modes = specimen_modes(coarse, _MODES)
        f = np.array([m.frequency_hz for m in modes])
        ratios = np.full(_MODES, specimen.modal_ratios[-1] if specimen.modal_ratios else OWN_RATIO)
        ratios[: len(specimen.modal_ratios)] = specimen.modal_ratios[:_MODES]
        loss = np.array([m.loss_factor for m in modes])
        return cls(coarse, f, 2 * np.pi * f * (loss / 2 + ratios))

    @classmethod
    def _of_small(cls, specimen: Beam | ShearPair) -> "Forecast":
        law = specimen.core.law if specimen.core is not None else None
        modes = small_modes(specimen, law, _SMALL_MODES)
        f = np.array([m.frequency_hz for m in modes])
        return cls(specimen, f, 2 * np.pi * f * (np.array([m.loss_factor for m in modes]) / 2 + OWN_RATIO))

    def decay_1_s(self, frequency_hz: float) -> float:
        """Of the slowest transient that a step near this frequency stirs."""
        near = self.mode_hz <= _REACH * frequency_hz
        return float(self.mode_decay_1_s[near].min() if near.any() else self.mode_decay_1_s[0])

    def velocity_m_s(self, frequency_hz: Array, level_m_s2: float) -> Array:
        """Amplitude the laser will see; between a few frequencies where there are many. Shape (points,)."""
        law = self.specimen.core.law if self.specimen.core is not None else None
        few = np.unique(frequency_hz)
        if len(few) > _MOST_SOLVED:
            few = np.linspace(few[0], few[-1], _MOST_SOLVED)
        if not isinstance(self.specimen, PlateSpecimen):
            seen = np.abs(small_velocity(self.specimen, few)) / self.specimen.drive_amplitude * level_m_s2
            return np.interp(frequency_hz, few, seen)
        omega = 2 * np.pi * few
        G = law.modulus(omega) if law is not None else np.zeros(len(few), dtype=complex)
        x = np.array([self._displacement(w, complex(g)) for w, g in zip(omega, G, strict=True)])
        seen = np.abs(velocity(omega, x, self.specimen.reads)) * level_m_s2
        return np.interp(frequency_hz, few, seen)

    def _displacement(self, omega: float, G: complex) -> complex:
        """At the pickup for a unit of what drives it, on the motions that it excites."""
        if (omega, G) not in self._solved:
            half, damping = self._half, self._damping
            load = half.down @ half.plate.load[:, None]
            x = half.solver(omega, G, damping)(load)[:, 0]
            self._solved[omega, G] = complex((half.down @ half.plate.pickup) @ x)
        return self._solved[omega, G]

    @cached_property
    def _solved(self) -> dict[tuple[float, complex], complex]:
        return {}

    @cached_property
    def _half(self) -> HalfPlate:
        assert isinstance(self.specimen, PlateSpecimen)
        return HalfPlate(Plate(self.specimen), "carried")

    @cached_property
    def _damping(self) -> LowRankDamping:
        whole = viscous_damping(self._half.plate)
        return replace(whole, U=self._half.down @ whole.U)

    def frequencies_hz(self, segment: SegmentSection) -> tuple[float, ...]:
        """Frequencies of a segment's steps. Raises `BadInput`."""
        if segment.frequencies_hz is not None:
            return tuple(segment.frequencies_hz)
        low, high = segment.low_hz, segment.high_hz
        if segment.mode is not None:
            if segment.mode > len(self.mode_hz):
                raise BadInput(f"mode {segment.mode}, expected at most {len(self.mode_hz)}")
            centre = self.mode_hz[segment.mode - 1]
            low, high = (centre * (1 + sign * segment.span_percent / 200) for sign in (-1, 1))
        assert low is not None
        assert high is not None
        count = segment.points or min(round((high - low) / (segment.step_hz or 1.0)), _MOST_STEPS) + 1
        return tuple(round(float(f), 4) for f in np.linspace(low, high, max(2, count)))


def planned_segment(
    forecast: Forecast, segment: SegmentSection, number: int, sweep: SweepTable, ranges: tuple[Range, ...]
) -> PlannedSegment:
    """One segment of the first sweep with its range. Raises `BadInput`."""
    f = forecast.frequencies_hz(segment)
    if len(f) > _MOST_STEPS:
        raise BadInput(f"{len(f)} steps, expected at most {_MOST_STEPS}: take a wider step_hz")
    if segment.range is not None and segment.range not in {r.name for r in ranges}:
        raise BadInput(f"range {segment.range!r}, expected one of {', '.join(r.name for r in ranges)}")
    level = sweep.level_g * PUBLISHED_G_M_S2
    name = segment.range or range_for(float(forecast.velocity_m_s(np.array(f), level).max()), ranges).name
    return PlannedSegment(number, 1, f, (level,) * len(f), name)


def sections_of(forecast: Forecast, sweep: SweepTable) -> list[SegmentSection]:
    """The file's segments; of a sweep that chooses its own steps, its band with the resonances in it."""
    if sweep.adaptive is None:
        return sweep.segments
    low, high = sweep.adaptive.band_hz
    inside = [round(float(f), 3) for f in forecast.mode_hz if low < f < high]
    return [SegmentSection(frequencies_hz=sorted({low, *inside, high}))]


def planned_segments(
    forecast: Forecast, sweep: SweepTable, ranges: tuple[Range, ...]
) -> tuple[list[PlannedSegment], tuple[float, str] | None]:
    """Every segment of every sweep with its range, and the sentinel. Raises `BadInput`."""
    sections = sections_of(forecast, sweep)
    once = [planned_segment(forecast, s, k, sweep, ranges) for k, s in enumerate(sections, start=1)]
    whole = [replace(s, sweep=turn) for turn in range(1, sweep.sweeps + 1) for s in once]
    if sweep.sentinel is None or sweep.plan == "adaptive":
        return whole, None
    first = whole[0]
    sentinel = sweep.sentinel.frequency_hz or first.frequencies_hz[len(first.frequencies_hz) // 2]
    level = sweep.level_g * PUBLISHED_G_M_S2
    name = range_for(float(forecast.velocity_m_s(np.array([sentinel]), level)[0]), ranges).name
    return whole, (sentinel, name)


def calibration_segments(
    sweep: SweepTable, names: list[str], ranges: tuple[Range, ...]
) -> list[PlannedSegment]:
    """The laser on the base, in every range the sweep is going to use."""
    if sweep.calibration is None:
        return []
    f = tuple(sweep.calibration.frequencies_hz)
    highest = sweep.calibration.level_g * PUBLISHED_G_M_S2
    segments = []
    for number, one in enumerate(ranges, start=1):
        # Numbered among all ranges: a run that is carried on has the same numbers.
        name, full = one.name, one.full_scale_m_s
        if name not in names:
            continue
        level = tuple(min(highest, _CALIBRATION_SHARE * full * 2 * np.pi * x) for x in f)
        segments.append(PlannedSegment(number, 0, f, level, name, "calibration"))
    return segments


def distinct(ranges: tuple[Range, ...]) -> tuple[Range, ...]:
    """One range a full scale: of those that differ in their low-pass alone, the first."""
    return tuple({r.full_scale_m_s: r for r in reversed(ranges)}[full] for full in _scales(ranges))


def _scales(ranges: tuple[Range, ...]) -> list[float]:
    return sorted({r.full_scale_m_s for r in ranges})


def with_next_coarser(names: list[str], ranges: tuple[Range, ...]) -> list[str]:
    """Ranges to calibrate: those planned and the next one up, where an overload would lead."""
    chosen = {k + up for k, r in enumerate(ranges) if r.name in names for up in (0, 1)}
    return [r.name for k, r in enumerate(ranges) if k in chosen]


def range_for(velocity_m_s: float, ranges: tuple[Range, ...]) -> Range:
    """The most sensitive range with room for a response; the coarsest where none has."""
    return next((r for r in ranges if r.full_scale_m_s >= _ROOM * velocity_m_s), ranges[-1])


def expected_seconds(forecast: Forecast, planned: list[PlannedSegment], settings: SweepSettings) -> float:
    """Rig time of segments one after the other, with the loop checks."""
    f = [f for segment in planned for f in segment.frequencies_hz]
    steps = sum(step_s(x, forecast.decay_1_s(x), settings) for x in f)
    return steps + sum(loop_checks_s(f, settings))
