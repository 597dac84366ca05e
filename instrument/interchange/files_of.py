"""A session's points and blows as files under one law: one a clamping, known mass, spot and mobility."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from fitting.specimen import PlateSpecimen
from fitting.structures import AnySpecimen
from fitting.sweep import Sweep
from instrument.impact.mobility import DELAY_S, GAIN
from instrument.models.files import File, spots_of
from instrument.session.points import by_mounting, place_of, with_spots
from instrument.stream.derived import PointMeasured, StruckFound


def files_of(
    sweep: Sweep, points: Sequence[PointMeasured], specimen: AnySpecimen, struck: Sequence[StruckFound] = ()
) -> list[File]:
    """`sweep` is of these points. One file where the plate was as the specimen says throughout.

    What was `struck` follows what was driven in the same mounting; hung free it comes last.
    """
    if not isinstance(specimen, PlateSpecimen):
        return [File(sweep, specimen)]
    plate = with_spots(specimen, points)
    groups = by_mounting(points, plate)
    # One file alone needs no name.
    names = [_name(points[places[0]]) if len(groups) + len(struck) > 1 else "" for places, _ in groups]
    driven = [
        (points[places[0]].mounting, spots_of(sweep.take(np.array(places)), with_mass, name, number))
        for number, ((places, with_mass), name) in enumerate(zip(groups, names, strict=True), start=1)
    ]
    found, last = [], len(driven)
    clamped = [one for one in struck if one.held == "clamped"]
    free = [one for one in struck if one.held == "free"]
    for k, (mounting, files) in enumerate(driven):
        found += files
        if all(other > mounting for other, _ in driven[k + 1 :]):
            for one in clamped:
                if one.mounting == mounting:
                    last += 1
                    found.append(_struck_file(one, specimen, last))
    return [*found, *(_struck_file(one, specimen, last + k) for k, one in enumerate(free, start=1))]


def _name(first: PointMeasured) -> str:
    """What was done to the plate; where it was read is another thing, of one file's spots."""
    return ", ".join(filter(None, ("sweep", place_of(replace(first, spot_mm=None)))))


def _struck_file(struck: StruckFound, specimen: PlateSpecimen, number: int) -> File:
    """A spectrum as a sweep: every line the velocity for 1 N."""
    lines = len(struck.frequency_hz)
    sweep = Sweep(
        frequency_hz=np.array(struck.frequency_hz),
        velocity_m_s=np.array(struck.mobility_re_m_s_n) + 1j * np.array(struck.mobility_im_m_s_n),
        commanded_m_s2=np.ones(lines),
        segment=np.array(struck.segment, dtype=np.intp),
        sweep=np.ones(lines, dtype=np.intp),
        std_m_s=np.array(struck.mobility_std_m_s_n),
    )
    spot = specimen.pickup_m if struck.spot_mm is None else _m(struck.spot_mm)
    tolerances = {**specimen.tolerances, "gain": GAIN, "delay": DELAY_S}
    plate = replace(
        specimen, force_m=_m(struck.struck_mm), pickup_m=spot, further_pickups_m=(), tolerances=tolerances
    )
    if struck.held == "free":
        length_m = 1e-3 * struck.size_mm[0]
        gripped = length_m - specimen.length_m
        masses = tuple(replace(m, x_m=m.x_m + gripped) for m in specimen.masses)
        plate = replace(plate, boundary="free", modal_ratios=(), length_m=length_m, masses=masses)
    return File(sweep, plate, "struck, hung free" if struck.held == "free" else "struck in its clamp", number)


def _m(place_mm: tuple[float, float]) -> tuple[float, float]:
    return 1e-3 * place_mm[0], 1e-3 * place_mm[1]
