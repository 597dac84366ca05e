"""Whether data held out say anything of an effect that is in them alone."""

from fitting.diagnosis.several.parts_with import PartWith, part_with
from instrument.facts.diagnosis import DiagnosisResult, EffectFound

NOT_FORETOLD = (
    "-: the effect shows there alone, or with a size of its own, which no other segment can foretell"
)
"""Why a segment held out has no error after a diagnosis."""


def is_foretold(found: DiagnosisResult, segment: int) -> bool:
    """Whether the other segments show what is accepted too.

    Where they do not, a segment predicted from them lacks it: its error is no measure of the fit.
    """
    inside = [p for p in found.points if p.segment == segment]
    parts = [_part(e) for e in found.effects if e.name in found.equivalent]
    alone = [part for part in parts if not part.is_all]
    return not any(part.has(p.frequency_hz, p.file, p.pickup) for part in alone for p in inside)


def _part(effect: EffectFound) -> PartWith:
    return part_with(effect.name, {key: p.value for key, p in effect.parameters.items()})
