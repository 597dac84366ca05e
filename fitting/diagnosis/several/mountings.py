"""Which files of a plate are of one mounting: a hammer does not mount it anew, a shaker may."""

from collections.abc import Sequence

from fitting.diagnosis.problem.base import DiagnosisProblem
from fitting.diagnosis.several.one_plate import Plates
from fitting.specimen import PlateSpecimen, StatedSpecimen


def mountings(members: Sequence[DiagnosisProblem], plates: Plates) -> tuple[int, ...]:
    """Of every member the first one of its mounting.

    What a base drives is a mounting of its own. What a force drives is as the plate stood when its base drove
    it last, or first where that came afterwards; where none did, as it was struck before (`plates`).
    """
    stated = [m.nuisances.specimen for m in members]
    return tuple(of_mounting(stated, k, plates[k]) for k in range(len(members)))


def of_mounting(stated: Sequence[StatedSpecimen], k: int, otherwise: int) -> int:
    """Of the k-th of some specimens the place of the one that it stands like; `otherwise` of none."""
    own = stated[k]
    if not isinstance(own, PlateSpecimen) or own.drive == "base":
        return k
    standing = own.as_it_stands
    alike = [
        j
        for j, other in enumerate(stated)
        if isinstance(other, PlateSpecimen) and other.drive == "base" and other.as_it_stands == standing
    ]
    before = [j for j in alike if j < k]
    return before[-1] if before else (alike or [otherwise])[0]
