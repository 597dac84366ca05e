"""What a table of modes could not have seen (`fitting.planning.unseen`)."""

from collections.abc import Sequence

from fitting.effects.base import Effect
from fitting.mode_tables.diagnose import DiagnosedModes, visible
from fitting.planning.signatures import signatures_in
from fitting.planning.unseen import Unseen, others, worst_first


def unseen_in_tables(found: DiagnosedModes, effects: Sequence[Effect]) -> list[Unseen]:
    """Of effects that change modes, beside the likeliest explanation, in all tables alike.

    None where nothing explains the tables, or their errors are not known.
    """
    begun, judgement = found.begun, found.judgement
    if judgement.verdict == "unknown" or not judgement.group or not begun.evidence.scale_known:
        return []
    (likeliest, _), *_ = judgement.group
    fitted, problem = likeliest.fitted, begun.problem
    able = [e for e in others(fitted, effects) if visible(problem, e)]
    signatures = signatures_in(
        problem.response, problem.points, fitted.law, fitted.u, able, beside=fitted.effects
    )
    return worst_first(signatures, begun.evidence, fitted, problem.frequency_hz)
