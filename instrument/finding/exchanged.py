"""Files whose specimens may have been exchanged: the light mass's data with the heavy one's file."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np

from fitting.diagnosis.inference.begin import Begun, begin
from fitting.digits import two_digits
from fitting.errors import OutsideModel
from fitting.structures import Beam, ShearPair
from instrument.finding.files_at_work import FilesAtWork
from instrument.models.files import File
from instrument.progress import quiet

_WORTH_A_LOOK = 0.05
"""Of a reading, rms: files that are off by less have their own specimens. A choice."""
_ENOUGH = 100
"""Points of each file: more say the same of specimens exchanged, and two files of many take minutes."""
_SO_MUCH_BETTER = 5.0
"""Times less must be left with two specimens exchanged. A choice."""


@dataclass(frozen=True)
class Exchanged:
    """Two files that one law fits far better with each other's specimens."""

    names: tuple[str, str]
    as_given: float
    """What one law leaves of all readings, rms of their size."""
    exchanged: float

    @property
    def words(self) -> str:
        """What is wrong, and what to do."""
        return (
            f"{' and '.join(self.names)} seem to have each other's specimens: as given one law leaves "
            f"{two_digits(100 * self.as_given)} % of the readings, with the two specimens exchanged "
            f"{two_digits(100 * self.exchanged)} %: exchange them"
        )


def exchanged(files: Sequence[File]) -> Exchanged | None:
    """The two files of shear pairs or beams that seem to be exchanged, if any. Raises `FittingError`."""
    if len(files) < 2 or not all(isinstance(f.specimen, Beam | ShearPair) for f in files):
        return None
    files = [replace(file, sweep=file.sweep.thinned(_ENOUGH)) for file in files]
    given = _left(files)
    if given < _WORTH_A_LOOK:
        return None
    found: list[tuple[float, str, str]] = []
    for a, b in combinations(range(len(files)), 2):
        if files[a].specimen == files[b].specimen:
            continue
        other = list(files)
        other[a] = replace(files[a], specimen=files[b].specimen)
        other[b] = replace(files[b], specimen=files[a].specimen)
        try:
            left = _left(other)
        except OutsideModel:
            continue
        first, second = (files[k].name or f"file {k + 1}" for k in (a, b))
        found.append((left, first, second))
    best = min(found, default=None)
    if best is None or best[0] * _SO_MUCH_BETTER > given:
        return None
    return Exchanged((best[1], best[2]), given, best[0])


def leaves_much(begun: Begun) -> bool:
    """Whether a fit leaves so much of its readings that specimens may have been exchanged."""
    return _left_by(begun) > _WORTH_A_LOOK


def _left(files: Sequence[File]) -> float:
    """What one law leaves of all readings, rms of their size."""
    work = FilesAtWork(files, quiet, with_effects=False)
    problem, noise = work.problem()
    return _left_by(begin(problem, None, noise, None, work.start, to_its_end=False))


def _left_by(begun: Begun) -> float:
    sweep, v = begun.problem.sweep, begun.none.velocity_m_s
    read, has_phase = sweep.response_m_s, sweep.has_phase
    off = (read if has_phase else np.abs(read)) / (v if has_phase else np.abs(v)) - 1
    return float(np.sqrt(np.mean(np.abs(off) ** 2)))
