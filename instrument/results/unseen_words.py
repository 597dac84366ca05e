"""What a sweep could not have seen, as people read it."""

from fitting.digits import two_digits
from instrument.facts.diagnosis import DiagnosisResult, UnseenEffect
from instrument.results.standing import none_is_likelier
from instrument.results.units_shown import size_shown

UNSEEN_COLUMNS = ("effect", "up to", "chance/%", "G' by/%", "loss factor by/%", "in standard errors")


def unseen_title(found: DiagnosisResult) -> str:
    """What the table is of: what may be there beside the likeliest explanation, not in its place."""
    effects = "" if none_is_likelier(found) else " and ".join(found.equivalent)
    beside = f" beside {effects}" if effects else ""
    return f"not found, but would not be seen if it were there{beside}: how far off the law would be"


def unseen_row(one: UnseenEffect) -> tuple[str, ...]:
    """One row under `UNSEEN_COLUMNS`."""
    shifts = one.storage_modulus_percent, one.loss_factor_percent
    chance = two_digits(100 * one.chance)
    return one.name, _size(one), chance, *(f"{s:.1f}" for s in shifts), f"{one.standard_errors:.1f}"


def _size(one: UnseenEffect) -> str:
    if one.parameter is None or one.size is None:
        return "-"
    return " ".join([one.parameter, *filter(None, size_shown(one.size, one.unit or "1"))])
