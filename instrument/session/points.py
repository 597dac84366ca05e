"""From measured points to a sweep that can be identified."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from fitting.specimen import PlacedMass, PlateSpecimen
from fitting.sweep import Sweep
from instrument.files.column import reading_std_m_s
from instrument.stepped_sine.point_of_reading import NOT_CALIBRATED
from instrument.stream.derived import PointMeasured


def uncalibrated(points: Sequence[PointMeasured]) -> list[str]:
    """A warning where points were read in a range that was not calibrated; nothing otherwise."""
    raw = sum(any(NOT_CALIBRATED in r for r in p.remarks) for p in points)
    if not raw:
        return []
    return [
        f"{raw} of {len(points)} points in a range not calibrated: the vibrometer's gain and delay "
        "are not taken off"
    ]


def with_spots(specimen: PlateSpecimen, points: Sequence[PointMeasured]) -> PlateSpecimen:
    """The specimen with every spot that points were read at."""
    further = {p.pickup: p.spot_mm for p in points if p.spot_mm is not None}
    if not further:
        return specimen
    spots = tuple((1e-3 * x, 1e-3 * y) for _, (x, y) in sorted(further.items()))
    return replace(specimen, further_pickups_m=(*specimen.further_pickups_m, *spots))


def by_mounting(
    points: Sequence[PointMeasured], specimen: PlateSpecimen
) -> list[tuple[list[int], PlateSpecimen]]:
    """Points of one clamping with one known mass on the plate, by their places; and the plate with it."""
    groups: dict[tuple[int, tuple[PlacedMass, ...]], list[int]] = {}
    for k, p in enumerate(points):
        at = p.mass_at_mm
        on = () if at is None else (PlacedMass(p.mass_kg, 1e-3 * at[0], 1e-3 * at[1]),)
        groups.setdefault((p.mounting, on), []).append(k)
    return [(places, replace(specimen, masses=(*specimen.masses, *on))) for (_, on), places in groups.items()]


def elsewhere(point: PointMeasured) -> str:
    """Another spot or a known mass, in words; empty where the plate was read as the specimen file says."""
    said = [f"spot {_millimetres(point.spot_mm)}"] if point.spot_mm is not None else []
    if point.mass_at_mm is not None:
        said.append(f"{1e3 * point.mass_kg:g} g at {_millimetres(point.mass_at_mm)}")
    return ", ".join(said)


def place_of(point: PointMeasured) -> str:
    """What `elsewhere` says and whether it was clamped anew; empty where all is as stated, and as first."""
    said = [where] if (where := elsewhere(point)) else []
    if point.mounting:
        said.append("clamped anew" + ("" if point.mounting == 1 else f" {point.mounting} times"))
    return ", ".join(said)


def _millimetres(at: tuple[float, float]) -> str:
    return f"{round(at[0], 1):g}, {round(at[1], 1):g} mm"


def is_one_mounting(points: Sequence[PointMeasured]) -> bool:
    """Whether all were read of the plate as it was mounted first, nothing put on it."""
    return not any(p.mounting or p.mass_at_mm is not None for p in points)


def sweep_of(points: Sequence[PointMeasured], times_s: Sequence[float] | None = None) -> Sweep:
    """The points as a `Sweep`, each at its own level; `times_s` on any clock, where there is one.

    The reading's standard deviation holds the reference channel's too: both blur the response over the base.
    """
    return Sweep(
        frequency_hz=np.array([p.frequency_hz for p in points]),
        velocity_m_s=np.array([p.velocity_m_s for p in points]),
        commanded_m_s2=np.array([p.level_m_s2 for p in points]),
        segment=np.array([p.segment for p in points], dtype=np.intp),
        sweep=np.array([p.sweep for p in points], dtype=np.intp),
        base_m_s2=np.array([p.base_m_s2 for p in points]),
        std_m_s=reading_std_m_s(points),
        time_s=None if times_s is None else np.array(times_s) - min(times_s),
        pickup=np.array([p.pickup for p in points], dtype=np.intp) if any(p.pickup for p in points) else None,
        drive_limited=np.array([p.drive_limited for p in points])
        if any(p.drive_limited for p in points)
        else None,
        std_of_dwells=True,
    )
