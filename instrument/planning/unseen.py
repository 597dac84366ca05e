"""What a sweep or tables that were diagnosed could not have seen, as their result has it."""

from fitting.planning.unseen import Unseen, unseen
from fitting.planning.unseen_in_tables import unseen_in_tables
from instrument.facts.diagnosis import DiagnosisResult, UnseenEffect
from instrument.finding.diagnosis import Diagnosed
from instrument.finding.modal import TablesDiagnosed


def with_unseen(result: DiagnosisResult, diagnosed: Diagnosed) -> DiagnosisResult:
    """The result of a diagnosis with it; as it is where nothing was looked for or no noise is known.

    Nor where nothing explains the data: what else would not be seen there is no news.
    """
    rivals = diagnosed.result.rivals
    if (
        result.verdict == "unknown"
        or rivals is None
        or not diagnosed.effects
        or not rivals.evidence.scale_known
    ):
        return result
    return result.but(unseen=tuple(_fact(one) for one in unseen(rivals, diagnosed.effects)))


def with_unseen_in_tables(result: DiagnosisResult, diagnosed: TablesDiagnosed) -> DiagnosisResult:
    """As `with_unseen`, of tables of modes."""
    unseen_there = unseen_in_tables(diagnosed.found, diagnosed.effects)
    return result.but(unseen=tuple(_fact(one) for one in unseen_there))


def _fact(one: Unseen) -> UnseenEffect:
    return UnseenEffect(
        name=one.name,
        chance=one.chance,
        parameter=one.key,
        size=one.size,
        unit=one.unit,
        storage_modulus_percent=100 * one.storage_modulus,
        loss_factor_percent=100 * one.loss_factor,
        standard_errors=one.errors,
    )
