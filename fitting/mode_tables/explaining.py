"""Explanations of tables of modes, fitted and weighed one by one."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from fitting.arrays import Array
from fitting.diagnosis.checks.predictive import TOLERANCES, form_error, of_stated_numbers
from fitting.diagnosis.inference.evidence import Evidence
from fitting.diagnosis.inference.marginal import cost
from fitting.diagnosis.inference.refit import COMPARABLE, ROUGH, refit
from fitting.diagnosis.inference.refitted import Refitted, by_chi2
from fitting.diagnosis.search.catalogue_search import ScoredFit
from fitting.diagnosis.search.looks import Start, promising
from fitting.diagnosis.search.stand_in import too_large
from fitting.diagnosis.several.of_files import OfFiles
from fitting.diagnosis.thresholds import STOPPING, VERDICT
from fitting.effects.base import Effect
from fitting.errors import OutsideModel
from fitting.laws import CoreLaw
from fitting.mode_tables.fit import BegunModal
from fitting.numerics.chances import normal_above

_FOLLOWED, _FOLLOWED_PLACES = 1, 3
"""Starts of an effect that are fitted; of one with a place."""
_SPARE = 2
"""Numbers a candidate must leave over."""
_UNREAD = 1e6
"""Times its error a mode is worth nothing."""


@dataclass(frozen=True)
class Explaining:
    """Fits beside one fit without effects."""

    begun: BegunModal

    def forms(self, effect: Effect) -> list[Effect]:
        """What an effect may look like in these files."""
        files = len(self.begun.problem.members)
        whole = effect if effect.replaces_law or files == 1 else OfFiles(effect, files)
        return list(whole.variants())

    def starts(self, effect: Effect, before: Refitted) -> list[Start]:
        """Of one form beside what is fitted already, the most promising first."""
        problem = self.begun.problem
        with np.errstate(all="ignore"):
            return promising(
                problem.response([*before.effects, effect]),
                problem.response(before.effects),
                problem.points,
                self.begun.evidence,
                before,
            )

    def fits(self, effect: Effect, before: Refitted, starts: Sequence[Start] | None = None) -> list[Refitted]:
        """With one form of an effect more, from its most promising starts."""
        begun, problem = self.begun, self.begun.problem
        effects = [*before.effects, effect]
        if effect.replaces_law:
            laws = [law for law in effect.laws(before.law, problem.points) if self._carried(law)]
            return [f for law in laws if (f := self._tried(effects, law, before.u)) is not None]
        starts = self.starts(effect, before) if starts is None else starts
        has_place = any(q.neutral is None and not q.fixed for q in effect.parameters)
        lost = not before.effects and before.chi2_per_dof > STOPPING.wrong_law_chi2_per_dof
        begins = [(before.law, before.u), *([(begun.start, 0 * before.u)] if lost else [])]
        found = [
            f
            for _, u in starts[: _FOLLOWED_PLACES if has_place else _FOLLOWED]
            for law, known in begins
            if (f := self._tried(effects, law, np.concatenate([known, u]))) is not None
        ]
        if not found:
            return []
        best = min(found, key=by_chi2)
        ended = self.ended(effects, best.law, best.u)
        return [] if ended is None else [ended]

    def ended(self, effects: Sequence[Effect], law: CoreLaw, u: Array) -> Refitted | None:
        """Effects fitted to the end from somewhere; `u` of shape (unknowns,).

        None where the structure has not the table's modes there.
        """
        return self._tried(effects, law, u, COMPARABLE)

    def determined(self, fitted: Refitted) -> bool:
        """Whether the tables leave over what a fit needs."""
        return fitted.parameter_count <= self.begun.evidence.count - _SPARE

    def scored(self, fitted: Refitted, temper: float = 1.0) -> ScoredFit:
        """A fit with what it is worth where what was explained is `temper` times as far above the noise."""
        plate = self.begun.problem.response(fitted.effects).plate
        large = too_large(fitted, plate)
        return ScoredFit(fitted, cost(fitted, plate, temper), self._checks(fitted), too_large=large)

    def held_out(self, scored: ScoredFit) -> float:
        """Rms error of every mode predicted from all others, in its standard deviations.

        NaN of another law: a few modes do not tell laws apart by what lies beyond them.
        """
        begun, fitted = self.begun, scored.fitted
        if any(e.replaces_law for e in fitted.effects):
            return float("nan")
        response, evidence, off = begun.problem.response(fitted.effects), begun.evidence, []
        for k, sigma in enumerate(evidence.sigma_m_s):
            blunt = evidence.sigma_m_s.copy()
            blunt[k] *= _UNREAD
            without: Evidence = replace(evidence, sigma_m_s=blunt)
            try:
                again = refit(response, without, fitted.law, fitted.u, tolerance=ROUGH)
            except (OutsideModel, np.linalg.LinAlgError):
                return float("inf")
            off.append(abs(again.velocity_m_s[k] - evidence.measured_m_s[k]) / sigma)
        return float(np.sqrt(np.mean(np.square(off)) / 2))

    def _carried(self, law: CoreLaw) -> bool:
        return len(law.names) <= self.begun.evidence.count - _SPARE

    def _tried(
        self, effects: Sequence[Effect], law: CoreLaw, u: Array, tolerance: float = ROUGH
    ) -> Refitted | None:
        """A rough fit; None where the structure it begins with has not the table's modes."""
        response, evidence = self.begun.problem.response(effects), self.begun.evidence
        try:
            return refit(response, evidence, law, u, tolerance=tolerance)
        except (OutsideModel, np.linalg.LinAlgError):
            return None

    def _checks(self, fitted: Refitted) -> dict[str, float]:
        """Tail probabilities of what is left, and of what was asked of the stated numbers."""
        if not self.begun.evidence.scale_known:
            return {}
        dof = max(1, fitted.data - fitted.parameter_count)
        left = fitted.chi2_per_dof / (1 + form_error(self.begun.none, fitted) / dof)
        spread = np.hypot(2 * VERDICT.noise_known_to, np.sqrt(2 / dof))
        found = {"size": float(normal_above(np.log(max(left, 1e-12)) / spread))}
        if fitted.stated:
            found[TOLERANCES] = of_stated_numbers(fitted)
        return found
