"""Results of several files, or of a structure other than the plate, read off what was found."""

from collections.abc import Sequence

import numpy as np

from instrument.facts.diagnosis import DiagnosisResult, PointLeft
from instrument.facts.identification import IdentificationResult, PointFitted
from instrument.facts.rows import StretchSetAside
from instrument.models.files import File, name_of, numbers_of
from instrument.models.files_at_work import SetAside
from instrument.models.together import DiagnosedTogether, Together
from instrument.results.diagnosis_from import diagnosis_from
from instrument.results.identification_from import identification_from


def identified_together_from(found: Together, files: Sequence[File]) -> IdentificationResult:
    """The result of `identify`, each point with its file (from 1), and what was set aside."""
    result = identification_from(found.found)
    owned = zip(result.points, _owners(files, result.points), strict=True)
    return result.but(
        points=tuple(point.but(file=number, pickup=f.pickup) for point, (number, f) in owned),
        files=_names(files),
        set_aside=_set_aside(found.aside, files),
    )


def diagnosed_together_from(found: DiagnosedTogether, files: Sequence[File]) -> DiagnosisResult:
    """The result of `diagnose`, each point with its file (from 1), and what was set aside."""
    result = diagnosis_from(found.found, found.sweep)
    owned = zip(result.points, _owners(files, result.points), strict=True)
    return result.but(
        points=tuple(point.but(file=number, pickup=f.pickup) for point, (number, f) in owned),
        files=_names(files),
        set_aside=_set_aside(found.aside, files),
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
            points=int(one.points),
        )
        for one in aside
    )


def _owners(files: Sequence[File], points: Sequence[PointFitted | PointLeft]) -> list[tuple[int, File]]:
    """By segments: every file's, and every spot's, are numbered on from the last one's."""
    counts = np.cumsum([len(np.unique(f.sweep.segment)) for f in files])
    owners = list(zip(numbers_of(files), files, strict=True))
    return [owners[int(np.searchsorted(counts, point.segment))] for point in points]
