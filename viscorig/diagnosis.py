"""What the specimen's law cannot explain, traced to an effect."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from instrument.facts.diagnosis import DiagnosisResult, StageName
from instrument.facts.doubts import doubts_of
from viscorig.facts import Facts
from viscorig.shown import Columns, columns

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_RANKING = ("probability", "delta_bic", "chi2_per_dof")


@dataclass(frozen=True, repr=False)
class Diagnosis(Facts[DiagnosisResult]):
    """The verdict on a residual, the law before and after: the JSON of `viscorig diagnose`."""

    @property
    def verdict(self) -> str:
        """`none`, `effect`, `ambiguous` or `unknown`."""
        return self.result.verdict

    @property
    def effects(self) -> dict[str, dict[str, Any]]:
        """Parameters of the accepted effects by name: `value`, `standard_error` and `unit` of each key."""
        return {
            effect.name: {key: p.as_json() for key, p in effect.parameters.items()}
            for effect in self.result.effects
        }

    @property
    def doubts(self) -> tuple[str, ...]:
        """Those `warnings` by which the law may be wrong by more than is known of it; empty for none."""
        return doubts_of(self.result)

    @property
    def before(self) -> Columns:
        """The law without any effect, a row a frequency."""
        return columns(self.result.before.law)

    @property
    def after(self) -> Columns:
        """The law with the effects found, a row a frequency."""
        return columns(self.result.after.law)

    def to_numpy(self) -> Columns:
        """The candidates, best first: `probability`, `delta_bic`, chi-square per degree of freedom.

        `delta_bic` is -2 ln of prior times marginal likelihood, above the best one's; its name is an old one.
        """
        candidates = self.result.candidates
        found: Columns = {"name": np.array([c.name for c in candidates], dtype=str)}
        return found | {key: np.array([getattr(c, key) for c in candidates], dtype=float) for key in _RANKING}

    def lines(self) -> list[str]:
        """The verdict, what explains it, error before and after, warnings."""
        rms = [stage.rms_percent for stage in self.result.stages]
        named = ", ".join(self.effects) or "no effect"
        heading = f"{self.verdict}: {named} (rms {rms[0]:.3g} % before, {rms[1]:.3g} % after)"
        return [heading, *self.result.explanation, *self.warnings]

    def plot(self, ax: "Axes | None" = None) -> "Axes":
        """What is left of the amplitudes without and with the effects, beside the noise; the axes."""
        from viscorig.plots import plot_residual

        titles: dict[StageName, str] = {"before": "without effects", "after": "with effects"}
        return plot_residual(ax, self.result.points, titles, self.result.points_set_aside)

    def plot_law(self, ax: "Axes | None" = None) -> "Axes":
        """G' and the loss factor without and with the effects, with 95 % bands; the axes."""
        from viscorig.plots import plot_laws

        return plot_laws(ax, {"after": self.after, "before": self.before})
