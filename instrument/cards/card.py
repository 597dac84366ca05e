"""What every card is made of: the law, its series, Poisson's ratio, and the lines it begins with."""

from collections.abc import Iterable
from dataclasses import dataclass
from importlib.metadata import version
from textwrap import wrap

import numpy as np

from fitting.arrays import Array
from fitting.errors import FittingError
from fitting.laws.prony import Prony, fit_prony
from instrument.material.formula import formula
from instrument.material.found_law import MaterialLaw

USUAL_POISSON = 0.49
"""Of a viscoelastic core where nobody states it: nearly incompressible; cards say that it is assumed."""
_FORMULA_SERVES = 1e-3
"""Relative error of G* up to which a formula is the law: its parameters are written with six digits."""
_AT_ONE = (
    "frequencies below hold at that temperature alone: at another one, divide them by its a_T (and multiply "
    "moduli by its b_T, where there is one)"
)
"""Of a law over reduced frequency, in formats that know of no shift."""
_LONGEST = 240
"""Letters of a comment's line: Abaqus takes 256."""
_NOTHING = 1e-6
"""Of the instantaneous modulus: less is none."""


def commented(sign: str, lines: Iterable[str]) -> list[str]:
    """Lines behind a format's comment sign; long ones go on in a comment of their own."""
    parts = (part for line in lines for part in wrap(line, _LONGEST, break_on_hyphens=False))
    return [f"{sign} {part}" for part in parts]


@dataclass(frozen=True)
class Card:
    """A law, ready to be written in any format. SI throughout: Pa, s, Hz."""

    law: MaterialLaw
    prony: Prony
    poisson: float
    poisson_is_assumed: bool
    wanted: float = 0.01
    """Relative error that its series was to have."""

    @classmethod
    def of(cls, law: MaterialLaw, poisson: float | None = None, wanted: float = 0.01) -> "Card":
        """`poisson` where the law's file does not state it; `wanted`: relative error of the series."""
        given = poisson if poisson is not None else law.poisson
        at_rest = law.parameters.get("g0_pa", law.parameters.get("g_inf_pa"))
        prony = fit_prony(law.modulus, *law.band_hz, wanted, at_rest)
        return cls(law, prony, USUAL_POISSON if given is None else given, given is None, wanted)

    def header(self) -> list[str]:
        """Lines without the format's comment sign."""
        law, (low, high) = self.law, self.law.band_hz
        warm = "not known" if law.temperature_c is None else f"{law.temperature_c:.1f} degrees C"
        band, shift = "band", []
        if law.shift is not None:
            band, shift = "band in reduced frequency f a_T", [f"shift: {law.shift.words}", _AT_ONE]
        lines = [
            f"viscorig {version('viscorig')}: complex shear modulus of a viscoelastic core",
            f"source: {law.source}; specimen: {law.specimen}",
            f"{band}: {low:g} to {high:g} Hz, not to be used outside; temperature: {warm}",
            *shift,
            f"verdict: {law.verdict}",
            *([f"with: {law.found}"] if law.found else []),
        ]
        if law.verdict == "unknown":
            why = "the data show structure that nothing in the catalogue explains"
            if law.shift is not None:
                why = "it is not told whether one shifted law serves at all these temperatures"
            lines.append(f"WARNING: verdict unknown: {why}; this law may be biased beyond its band")
        if law.shift is not None and law.shift.common_cause is not None:
            lines.append(
                "WARNING: this law rests on an effect that all temperatures seem to have in common, "
                f"{law.found}: it is the law beside that effect, and another one if the effect is not there"
            )
        if law.doubts:
            lines.append(
                "WARNING: the fit says that this law may be biased beyond its band: " + "; ".join(law.doubts)
            )
        if not law.converged:
            lines.append("WARNING: the fit has not come to its end: values and their errors are provisional")
        if law.hardly_known:
            lines.append(f"WARNING: {law.hardly_known}")
        assumed = (
            " (assumed: no file states one; --specimen of a plate or a beam does)"
            if self.poisson_is_assumed
            else " (as stated)"
        )
        lines += [
            "units: SI: Pa, s, Hz",
            f"Poisson's ratio: {self.poisson:g}{assumed}, real and constant: bulk and shear relax alike",
            f"law: {law.kind}: "
            + ", ".join(f"{k} = {v:.6g}" for k, v in law.parameters.items())
            + self._about_formula(),
        ]
        # Names come from files: none of them may begin a line of its own.
        return [" ".join(line.split()) for line in lines]

    def _about_formula(self) -> str:
        """What is not in the law's parameters: its bend."""
        law = self.law
        try:
            G = formula(law.kind, law.parameters).modulus(2 * np.pi * law.frequency_hz)
        except (KeyError, FittingError, TypeError, ValueError):
            return ""
        off = float(np.max(np.abs(G / (self.storage + 1j * self.loss) - 1)))
        if off < _FORMULA_SERVES:
            return ""
        return f"; the law found is bent about this formula, which is up to {100 * off:.2g} % off it"

    def about_series(self) -> str:
        """How well the series stands for the law."""
        p = self.prony
        rest = f"at rest {p.g_inf_pa:.3g} Pa, an extrapolation"
        if p.g_inf_pa < _NOTHING * p.g_0_pa:
            rest = "at rest nothing is left: not for static loads"
        missed = (
            f"; {100 * self.wanted:.2g} % is not reached: no sum of relaxations is this law, as far as its "
            "own uncertainty lets it bend"
        )
        return (
            f"Prony series of {len(p.g_pa)} terms: at most {100 * p.max_error:.2g} % off the law's G* in the "
            f"band, rms {100 * p.rms_error:.2g} %{missed if p.max_error > self.wanted else ''}; {rest}"
        )

    def about_table(self) -> str:
        """How well straight lines between the listed points stand for the law."""
        return f"table read with straight lines: at most {100 * self.table_error:.2g} % off the law's G*"

    @property
    def table_error(self) -> float:
        """Largest relative error of G* by linear interpolation of G' and G''."""
        law = self.law
        f = np.geomspace(*law.band_hz, 40 * len(law.frequency_hz))
        G = law.modulus(2 * np.pi * f)
        straight = np.interp(f, law.frequency_hz, self.storage) + 1j * np.interp(
            f, law.frequency_hz, self.loss
        )
        return float(np.max(np.abs(straight / G - 1)))

    @property
    def storage(self) -> Array:
        """G' in Pa at the law's frequencies. Shape (frequencies,)."""
        return self.law.storage_modulus_pa

    @property
    def loss(self) -> Array:
        """G'' in Pa. Shape (frequencies,)."""
        return self.law.storage_modulus_pa * self.law.loss_factor

    def young_pa(self, shear_pa: float) -> float:
        """E of a shear modulus."""
        return 2 * (1 + self.poisson) * shear_pa

    def bulk_over_shear(self) -> float:
        """K / G of the stated Poisson's ratio."""
        return 2 * (1 + self.poisson) / (3 * (1 - 2 * self.poisson))
