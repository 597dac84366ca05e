"""How a law found over several temperatures goes from one to another, as its file says it."""

from typing import Literal, Self

from pydantic import BaseModel, Field, FiniteFloat, model_validator

from fitting.temperature.shifts import GAS_J_MOL_K, ZERO_K
from instrument.material.found_effect import NamedEffect

_NEEDED = {"wlf": {"c1", "c2_k"}, "arrhenius": {"activation_energy_j_mol"}, "free": set[str]()}
"""Parameters by the kind of the shift."""


class _At(BaseModel):
    temperature_c: FiniteFloat
    log10_shift: FiniteFloat


class FoundShift(BaseModel):
    """Of the JSON of `identify --shift`: a law at the reference, its band in reduced frequency."""

    shift: Literal["wlf", "arrhenius", "free"]
    reference_c: FiniteFloat
    shift_parameters: dict[str, float]
    temperatures: list[_At] = Field(min_length=2)
    simple: bool | None
    common_cause: NamedEffect | None = None
    """The effect beside which the law was found; None where it stands on nothing but the readings."""

    @model_validator(mode="after")
    def _whole(self) -> Self:
        missing = _NEEDED[self.shift] - set(self.shift_parameters)
        if missing:
            raise ValueError(f"shift_parameters without {', '.join(sorted(missing))}")
        return self

    @property
    def verdict(self) -> str:
        """What results call it: a law that may not be one is not known to be what it looks like."""
        return "thermorheologically simple" if self.simple else "unknown"

    @property
    def words(self) -> str:
        """The shift as a line of text, log10 a_T by the temperature T."""
        p, T0 = self.shift_parameters, self.reference_c
        low, high = (f(at.temperature_c for at in self.temperatures) for f in (min, max))
        if self.shift == "wlf":
            form = f"log10 a_T = -{p['c1']:.6g} (T - {T0:g}) / ({p['c2_k']:.6g} + T - {T0:g}), T in degrees C"
        elif self.shift == "arrhenius":
            form = (
                f"ln a_T = {p['activation_energy_j_mol']:.6g} / {GAS_J_MOL_K:.7g} "
                f"(1/T - 1/{T0 + ZERO_K:g}), T in K"
            )
        else:
            form = "log10 a_T = " + ", ".join(
                f"{at.log10_shift:.4f} at {at.temperature_c:g} degrees C" for at in self.temperatures
            )
        return f"{form}; measured from {low:g} to {high:g} degrees C"
