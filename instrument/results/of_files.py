"""What a result of several files, or of a structure other than the plate, says of its files."""

from collections.abc import Sequence
from typing import TypeVar

import numpy as np

from fitting.arrays import Mask
from instrument.facts.diagnosis import DiagnosisResult, PointLeft
from instrument.facts.identification import IdentificationResult, PointFitted
from instrument.facts.rows import PointSetAside, StretchSetAside
from instrument.finding.files_at_work import SetAside
from instrument.models.files import File, lone_plate, name_of, numbers_of

P = TypeVar("P", PointFitted, PointLeft, PointSetAside)
R = TypeVar("R", IdentificationResult, DiagnosisResult)


def with_files(result: R, files: Sequence[File], used: Mask, aside: Sequence[SetAside]) -> R:
    """The result with the file of each point (from 1), and what was set aside; of one plate as it is.

    `used` are the readings that took part, among those of all files, shape (readings,).
    """
    if lone_plate(files) is not None:
        return result
    return result.but(
        points=_owned(result.points, files, used),
        points_set_aside=_owned(result.points_set_aside, files, ~used),
        files=_names(files),
        set_aside=_set_aside(aside, files),
    )


def _names(files: Sequence[File]) -> tuple[str, ...]:
    """Of the files in order, whatever spots each has."""
    return tuple(name_of(files, number) for number in sorted(set(numbers_of(files))))


def _set_aside(aside: Sequence[SetAside], files: Sequence[File]) -> tuple[StretchSetAside, ...]:
    """Stretches of each file that take no part."""
    return tuple(
        StretchSetAside(
            file=one.file,
            name=name_of(files, one.file),
            from_hz=one.glitch.low_hz,
            to_hz=one.glitch.high_hz,
            largest_percent=100 * one.glitch.largest,
            points=one.glitch.points,
        )
        for one in aside
    )


def _owned(points: Sequence[P], files: Sequence[File], mine: Mask) -> tuple[P, ...]:
    """Each with its file and spot; `mine` are its readings among those of all files, shape (readings,)."""
    owner = np.repeat(np.arange(len(files)), [len(f.sweep) for f in files])[mine]
    numbers = numbers_of(files)
    owned = zip(points, owner.tolist(), strict=True)
    return tuple(point.but(file=numbers[k], pickup=files[k].pickup) for point, k in owned)
