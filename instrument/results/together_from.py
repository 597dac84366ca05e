"""Results of several files, or of a structure other than the plate, read off what was found."""

from collections.abc import Sequence

import numpy as np

from instrument.facts.diagnosis import DiagnosisResult
from instrument.facts.identification import IdentificationResult, PointFitted
from instrument.facts.rows import StretchSetAside
from instrument.models.together import DiagnosedTogether, File, SetAside, Together
from instrument.results.diagnosis_from import diagnosis_from
from instrument.results.identification_from import identification_from


def identified_together_from(found: Together, files: Sequence[File]) -> IdentificationResult:
    """The result of `identify`, each point with its file (from 1), and what was set aside."""
    result = identification_from(found.found, found.sweep)
    owned = zip(result.points, _owners(files, result.points), strict=True)
    return result.but(
        points=tuple(point.but(file=file) for point, file in owned),
        files=tuple(f.name for f in files),
        set_aside=_set_aside(found.aside, files),
    )


def diagnosed_together_from(found: DiagnosedTogether, files: Sequence[File]) -> DiagnosisResult:
    """The result of `diagnose`, with the files' names and what was set aside of which."""
    result = diagnosis_from(found.found, found.sweep)
    return result.but(files=tuple(f.name for f in files), set_aside=_set_aside(found.aside, files))


def _set_aside(aside: Sequence[SetAside], files: Sequence[File]) -> tuple[StretchSetAside, ...]:
    """Stretches of each file that take no part."""
    return tuple(
        StretchSetAside(
            file=one.file,
            name=files[one.file - 1].name,
            from_hz=one.glitch.low_hz,
            to_hz=one.glitch.high_hz,
            largest_percent=100 * one.glitch.largest,
            points=int(one.points),
        )
        for one in aside
    )


def _owners(files: Sequence[File], points: Sequence[PointFitted]) -> list[int]:
    """By segments: every file's are numbered on from the last one's."""
    counts = np.cumsum([len(np.unique(f.sweep.segment)) for f in files])
    return [int(np.searchsorted(counts, point.segment)) + 1 for point in points]
