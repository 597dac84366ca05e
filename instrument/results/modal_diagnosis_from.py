"""The result of a diagnosis of tables of modes, read off its fits."""

from collections.abc import Sequence

import numpy as np

from fitting.diagnosis.search.catalogue_search import ScoredFit
from fitting.diagnosis.verdict import text
from fitting.diagnosis.verdict.cautions import at_its_limit
from fitting.diagnosis.verdict.kin import UNLISTED, Unlisted
from fitting.diagnosis.verdict.result import Candidate, FoundEffect
from fitting.diagnosis.verdict.stage import FEW, each_of, found_effects, mixture_of
from fitting.digits import two_digits
from fitting.identification.doubt import doubts_among
from fitting.identification.result import LawBand
from fitting.identification.uncertainty import correlations_by_name
from fitting.mode_tables.diagnose import DiagnosedModes
from fitting.mode_tables.fit import ModalFit, law_with, modal_fit_of
from fitting.mode_tables.table import ModalTable
from instrument.facts.diagnosis import DiagnosisResult, EffectFound, ModeLeft, StageFitted
from instrument.finding.modal import TablesDiagnosed
from instrument.results.diagnosis_from import candidate_from, parameters_from
from instrument.results.diagnosis_words import NOT_NAMED
from instrument.results.modal_from import band_of, listed_hz, modal_band, percent_off
from instrument.results.rows_from import adjusted_from, law_known_from, law_rows_from

_READ_AGAIN = "That mode's peak once more, in the record that it was read from; or diagnose without its row."


def modal_diagnosis_from(
    diagnosed: TablesDiagnosed, tables: Sequence[ModalTable], names: Sequence[str]
) -> DiagnosisResult:
    """The result of `diagnose` on tables; `modes` stand in the place of `points`."""
    found, judgement = diagnosed.found, diagnosed.found.judgement
    before = modal_fit_of(found.begun)
    accepted = judgement.accepted
    after = modal_fit_of(found.begun, accepted.fitted, found.temper) if accepted is not None else before
    band = modal_band(after, tables)
    if judgement.unlisted is not None or (judgement.verdict != "unknown" and judgement.group):
        band = _band_over(found, judgement.weighing(found.none), tables)
    effects = _effects(found, accepted) if accepted is not None else ()
    catalogue = {e.name: e for e in diagnosed.effects}
    known = found.begun.evidence.scale_known
    first = _stage(before, tables, modal_band(before, tables), known=known)
    last = _stage(after, tables, band, known=known)
    remarks = (*diagnosed.remarks, *(at_its_limit(accepted) if accepted is not None else ()))
    return DiagnosisResult(
        verdict=judgement.verdict,
        effects=tuple(
            EffectFound(name=e.name, parameters=parameters_from(e), probability=judgement.of_effect(e.name))
            for e in effects
        ),
        equivalent=dict(judgement.equivalent),
        candidates=tuple(candidate_from(_candidate(found, scored, tables)) for scored in found.scored),
        before=first,
        after=last,
        adjusted=adjusted_from(after.adjusted),
        p_value=None,
        nested_held_out_rms_percent=None,
        next_measurement=_READ_AGAIN
        if diagnosed.misread or diagnosed.rival
        else text.next_measurement(
            judgement, catalogue, with_hammer=False, unknown=text.WHERE_NOTHING_EXPLAINS_MODES
        ),
        unseen=(),
        next_measurements=(),
        by_hand=False,
        explanation=_explanation(diagnosed, effects, first, last),
        warnings=remarks,
        doubts=(*([diagnosed.misread] if diagnosed.misread else []), *doubts_among(remarks)),
        points=(),
        modes=_modes(before, after, tables),
        files=tuple(names),
        seconds=diagnosed.seconds,
        setup_seconds=diagnosed.setup_seconds,
    )


def _band_over(
    found: DiagnosedModes, weighing: Sequence[tuple[ScoredFit, float]], tables: Sequence[ModalTable]
) -> LawBand:
    """The law over explanations and their kin, by their shares."""
    each = [
        (modal_band(modal_fit_of(found.begun, scored.fitted, found.temper, kin), tables), share)
        for scored, kin, share in each_of(weighing)
    ]
    shares = np.array([share for _, share in each])
    return mixture_of([band for band, _ in each], shares, all_wrong=found.judgement.weighs_wrong_laws)


def _few_of_law(
    found: DiagnosedModes, weighing: Sequence[tuple[ScoredFit, float]], tables: Sequence[ModalTable]
) -> LawBand:
    """The same at a few frequencies."""
    f = listed_hz(tables, FEW)
    each = [
        (band_of(*law_with(one.fitted, one.fitted.tempered_covariance(found.temper), kin), f), share)
        for one, kin, share in each_of(weighing)
    ]
    return mixture_of([band for band, _ in each], np.array([share for _, share in each]))


def _effects(found: DiagnosedModes, scored: ScoredFit) -> tuple[FoundEffect, ...]:
    plate = found.begun.problem.response(scored.fitted.effects).plate
    return found_effects(scored.fitted, plate, found.temper)


def _candidate(found: DiagnosedModes, scored: ScoredFit, tables: Sequence[ModalTable]) -> Candidate:
    known = found.begun.evidence.scale_known
    accepted = found.judgement.accepted
    # Its sizes are those of the verdict, which may have the last word on them.
    sized = accepted if accepted is not None and accepted.names == scored.names else scored
    akin = isinstance(scored, Unlisted)
    whose = scored.weighing(found.none) if isinstance(scored, Unlisted) else [(sized, 1.0)]
    chi2 = scored.chi2_per_dof if isinstance(scored, Unlisted) else scored.fitted.chi2_per_dof
    return Candidate(
        (FoundEffect(UNLISTED, {}),) if akin else _effects(found, sized),
        scored.cost - found.scored[0].cost,
        chi2 if known else float("nan"),
        found.judgement.probability.get(scored.names, 0.0),
        _few_of_law(found, whose, tables),
        dict(scored.checks),
    )


def _stage(fit: ModalFit, tables: Sequence[ModalTable], band: LawBand, *, known: bool) -> StageFitted:
    """`known`: whether the modes' errors are."""
    off = percent_off(fit, tables)
    plain = fit.law.plain
    own = fit.uncertainty.of_first(len(plain.names))
    errors = own.standard_errors * plain.values
    return StageFitted(
        rms_percent=float(np.sqrt(np.mean(off**2))),
        max_percent=float(np.abs(off).max()),
        chi2_per_dof=fit.uncertainty.chi2_per_dof if known else None,
        held_out=(),
        held_out_rms_percent=None,
        leave_one_out_rms_percent=None,
        law_kind=plain.kind,
        parameters=dict(zip(plain.names, plain.values.tolist(), strict=True)),
        standard_errors=dict(zip(plain.names, errors.tolist(), strict=True)),
        correlations=correlations_by_name(plain.names, own),
        law=law_rows_from(band),
        law_known=law_known_from(band),
        adjusted=adjusted_from(fit.adjusted),
    )


def _modes(before: ModalFit, after: ModalFit, tables: Sequence[ModalTable]) -> tuple[ModeLeft, ...]:
    return tuple(
        ModeLeft(
            file=k + 1,
            mode=int(t.mode[m]),
            frequency_hz=float(t.frequency_hz[m]),
            loss_factor=float(t.loss_factor[m]),
            before_hz=float(before.predicted_hz[k][m]),
            before_loss_factor=float(before.predicted_loss[k][m]),
            after_hz=float(after.predicted_hz[k][m]),
            after_loss_factor=float(after.predicted_loss[k][m]),
        )
        for k, t in enumerate(tables)
        for m in range(len(t.mode))
    )


def _explanation(
    diagnosed: TablesDiagnosed, effects: Sequence[FoundEffect], before: StageFitted, after: StageFitted
) -> tuple[str, ...]:
    said = _of_effects(diagnosed, effects, before, after)
    if not diagnosed.rival:
        return said
    return (*said, f"About as likely one row of the table is not as it should be: {diagnosed.rival}.")


def _of_effects(
    diagnosed: TablesDiagnosed, effects: Sequence[FoundEffect], before: StageFitted, after: StageFitted
) -> tuple[str, ...]:
    judgement = diagnosed.found.judgement
    said = [f"One law leaves {two_digits(before.rms_percent)} % rms in frequency."]
    if diagnosed.misread:
        return (*said, f"{diagnosed.misread[0].upper()}{diagnosed.misread[1:]}.")
    if judgement.verdict == "none":
        whose = "the modes'" if before.chi2_per_dof is not None else "the usual"
        return (*said, f"That is what {whose} errors leave: no effect is called for.")
    if judgement.accepted is None:
        nearest = f" What comes nearest, {' with '.join(judgement.refused)}, {judgement.why}." * bool(
            judgement.why
        )
        return (
            *said,
            f"There is more than the modes' errors, but nothing that was tried explains it.{nearest}",
        )
    if judgement.note:
        return (*said, judgement.note)
    stories = [text.story(e, f) for e, f in zip(judgement.accepted.fitted.effects, effects, strict=True)]
    said.append(f"Most likely {' and '.join(stories)}.")
    for name, group in judgement.equivalent.items():
        others = [NOT_NAMED.get(n, n) for n in group if n not in (name, UNLISTED)]
        if others:
            said.append(f"These data cannot tell {name} from {', '.join(others)}.")
    said += text.beside_kin(judgement)
    them = "it" if len(effects) == 1 else "them"
    said.append(f"With {them} {two_digits(after.rms_percent)} % is left.")
    if not judgement.confirmed:
        said.append("Modes that were left out are predicted no better by two effects than by none.")
    elif judgement.verdict == "ambiguous" and len(effects) > 1:
        said.append(
            "Two effects beside a law have so many numbers that a table's few come near to anything: look for"
            " both before either is believed."
        )
    return tuple(said)
