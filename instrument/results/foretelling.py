"""Whether data held out say anything of a fit: where they do not, why."""

from math import isnan

from fitting.diagnosis.several.parts_with import PartWith, part_with
from fitting.identification.validation import MOST_POINTS_ONE_BY_ONE
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


def why_not_foretold(found: DiagnosisResult) -> tuple[str, ...]:
    """A sentence for each error on data held out that a diagnosis lacks; none where it has all."""
    before, after = found.stages
    said = [NOT_FORETOLD] if any(not is_foretold(found, s.segment) for s in after.held_out) else []
    if before.leave_one_out_rms_percent is None and before.held_out_rms_percent is None:
        said.append(f"no error on data held out: {why_nothing_is_held_out(len(found.points))}")
    if any(s.noise_percent is None or isnan(s.noise_percent) for s in before.held_out):
        said.append("- for noise alone: the noise of these readings is not known")
    return tuple(said)


def why_nothing_is_held_out(points: int) -> str:
    """Of a fit of so many readings; none is one of tables of modes."""
    if not points:
        return "modes are few, none is left out"
    if points <= MOST_POINTS_ONE_BY_ONE:
        return f"{points} points are too few to leave one out"
    return "one segment alone, no other foretells it"


def _part(effect: EffectFound) -> PartWith:
    return part_with(effect.name, {key: p.value for key, p in effect.parameters.items()})
