"""Whether data held out say anything of an effect that is in them alone."""

from collections.abc import Sequence

from fitting.diagnosis.of_files import ALIKE, EACH, FILE, PICKUP
from instrument.facts.diagnosis import DiagnosisResult, EffectFound, PointLeft


def is_foretold(found: DiagnosisResult, segment: int) -> bool:
    """Whether the other segments show what is accepted too.

    Where they do not, a segment predicted from them lacks it: its error is no measure of the fit.
    """
    inside = [p for p in found.points if p.segment == segment]
    return not any(_is_alone(e, inside) for e in found.effects if e.name in found.equivalent)


def _is_alone(effect: EffectFound, points: Sequence[PointLeft]) -> bool:
    """Whether an effect is one of these points, or of some of them, only."""
    at = {key: p.value for key, p in effect.parameters.items()}
    file, spot = at.get(FILE, ALIKE), at.get(PICKUP, -1)
    if file != ALIKE:
        return any(file in (EACH, p.file) for p in points)
    if spot >= 0:
        return any(p.pickup == spot for p in points)
    if effect.name == "segment_gain":
        low, high = at["from"] * (1 - 1e-9), at["to"] * (1 + 1e-9)
        return any(low <= p.frequency_hz <= high for p in points)
    return False
