"""The JSON of `viscorig identify`, read back: law and plate as it found them, and how well it knows them."""

import json
from dataclasses import replace
from math import log
from pathlib import Path
from typing import Annotated

import numpy as np
from pydantic import BaseModel, Field, ValidationError, field_validator, model_validator

from fitting.arrays import Array
from fitting.errors import OutsideModel
from fitting.identification.adjusted import is_relative, stated_number
from fitting.laws import CoreLaw
from fitting.laws.bent_law import BentLaw
from fitting.nuisances.nuisance import Nuisance
from fitting.nuisances.nuisances import Nuisances
from fitting.specimen import PlateSpecimen, StatedSpecimen
from fitting.stated.number_names import kind_of, number_name
from fitting.stated.tolerances import OF_NARROW
from instrument.errors import BadInput
from instrument.facts.identification import IdentificationResult
from instrument.files.file_kind import no_json
from instrument.files.text import read_text
from instrument.models.fitted_plate import FittedPlate

_FREQUENCY_OFF = 1e-3
"""Frequencies are written with few digits."""
Finite = Annotated[float, Field(allow_inf_nan=False)]


def is_of_first(name: str) -> bool:
    """Whether a number found is that of the first file, at its first spot: `gain` and `gain [1]`."""
    whose = name.partition(" [")[2].removesuffix("]").split(", ")
    files = [part for part in whose if part.isdecimal()]
    return (not files or "1" in files) and not any(
        part.startswith("pickup ") and part != "pickup 0" for part in whose
    )


def plain_name(name: str) -> str:
    """As a specimen calls a number found, without whose it is: `gain` of `gain [1]`."""
    return name.partition(" [")[0]


class _Adjusted(BaseModel):
    """A stated number as the fit has it, in the units of the file."""

    name: str
    stated: Finite
    tolerance: Annotated[float, Field(gt=0, allow_inf_nan=False)]
    found: Finite

    @field_validator("name")
    @classmethod
    def _known(cls, name: str) -> str:
        kind_of(name)
        return name

    def moved(self, specimen: StatedSpecimen) -> tuple[Nuisance, float]:
        """The number as an unknown of a fit, and where it is; the specimen's own may be another one.

        Raises `BadInput` for one that the specimen does not state.
        """
        nuisance = Nuisance(self.name, kind_of(self.name), 1.0)
        try:
            stated, factor, unit = stated_number(specimen, nuisance)
        except (LookupError, AttributeError, TypeError, ValueError):
            # A mass, layer or place that is not there: specimens have no error of their own for it.
            raise BadInput(f"adjusted: {self.name}, expected a number that the specimen states") from None
        if not is_relative(nuisance):
            sigma, by = self.tolerance / factor, self.found / factor - stated
        else:
            said = ("found =", self.found), ("stated =", self.stated), ("the specimen has", factor * stated)
            for whose, value in said:
                self._refuse_unless_above_zero(whose, value, unit)
            sigma, by = self.tolerance / self.stated, log(self.found / factor / stated)
        return replace(nuisance, sigma=sigma), by / sigma

    def _refuse_unless_above_zero(self, whose: str, value: float, unit: str) -> None:
        """Raises `BadInput`: the logarithm is what is moved."""
        if value <= 0:
            size = f"{value:g}" + ("" if unit == "1" else f" {unit}")
            raise BadInput(f"adjusted: {self.name}: {whose} {size}, expected more than 0")


class _Bend(BaseModel):
    """Of the law, by its whitened values at knots: storage, then loss."""

    knots_hz: list[Annotated[float, Field(gt=0, allow_inf_nan=False)]] = Field(min_length=2)
    whitened: list[Finite]


class _Posterior(BaseModel):
    """Covariance of all that was fitted: logarithms of the law's parameters, the rest in its own sizes."""

    names: list[str]
    rows: list[list[Finite]]
    """Of the lower triangle, the diagonal last in each."""

    @model_validator(mode="after")
    def _whole(self) -> "_Posterior":
        if [len(row) for row in self.rows] != list(range(1, len(self.names) + 1)):
            raise ValueError("expected the rows of a lower triangle")
        return self

    def covariance(self, names: list[str]) -> Array:
        """Of some of them, as the specimen calls them, of several files the first one's.

        Zero for one that was not fitted. Shape (names, names).
        """
        C = np.zeros((len(names), len(names)))
        place = {plain_name(name): k for k, name in enumerate(self.names) if is_of_first(name)}
        for i, a in enumerate(names):
            for j, b in enumerate(names):
                if a in place and b in place:
                    low, high = sorted((place[a], place[b]))
                    C[i, j] = self.rows[high][low]
        return C


class _Row(BaseModel):
    """Of the law's list over the measured band."""

    frequency_hz: Annotated[float, Field(gt=0, allow_inf_nan=False)]


class _Hammer(BaseModel):
    modal_ratios: list[float]


class FoundLaw(BaseModel):
    """Parameters in SI units; null where the data do not fix one."""

    law_kind: str
    parameters: dict[str, float]
    standard_errors: dict[str, float | None]
    correlations: dict[str, dict[str, float | None]]
    bend: _Bend | None = None
    adjusted: list[_Adjusted] = []
    hammer: _Hammer | None = None
    posterior: _Posterior | None = None
    rows: list[_Row] = Field(default=[], alias="law")

    def outside(self, frequency_hz: Array) -> str:
        """What is to be said of frequencies beyond the measured band; empty within. Shape (points,)."""
        f = [row.frequency_hz for row in self.rows]
        if not f or (
            min(f) * (1 - _FREQUENCY_OFF) <= frequency_hz.min()
            and frequency_hz.max() <= max(f) * (1 + _FREQUENCY_OFF)
        ):
            return ""
        return (
            f"the law was found from {min(f):g} to {max(f):g} Hz: outside it is an extrapolation of its "
            "formula, which no error covers"
        )

    def law(self, start: CoreLaw) -> CoreLaw:
        """The law found, of the kind the specimen has, bent as it was. Raises `BadInput`, `OutsideModel`."""
        # A table is no law that is found: what a fit begins with there has the kind.
        start = start.to_fit(np.ones(1))
        if self.law_kind != start.kind or set(self.parameters) != set(start.names):
            raise BadInput(f"the law found is {self.law_kind}, expected the specimen's own, {start.kind}")
        law = start.with_values(np.array([self.parameters[name] for name in start.names]))
        if self.bend is None:
            return law
        knots, whitened = self.bend.knots_hz, self.bend.whitened
        if len(whitened) != 2 * len(knots):
            raise BadInput(f"bend: {len(whitened)} values at {len(knots)} knots, expected two at each")
        return BentLaw(law, tuple(knots), tuple(float(b) for b in np.exp(whitened)))

    @property
    def of_specimen(self) -> list[_Adjusted]:
        """Stated numbers as the specimen calls them, of several files the first one's.

        Where narrow resonances lie is the data's.
        """
        return [
            one.model_copy(update={"name": plain_name(one.name)})
            for one in self.adjusted
            if kind_of(one.name) not in OF_NARROW and is_of_first(one.name)
        ]

    def plate(self, specimen: PlateSpecimen) -> FittedPlate:
        """The specimen's plate as it was found. Raises `BadInput` where that cannot be."""
        ratios = list(self.hammer.modal_ratios if self.hammer is not None else specimen.modal_ratios)
        for one in self.of_specimen:
            if kind_of(one.name) == "damping":
                mode = number_name(one.name).item
                ratios += [0.0] * (mode + 1 - len(ratios))
                ratios[mode] = one.stated / 100
        specimen = replace(specimen, modal_ratios=tuple(ratios))
        both = [one.moved(specimen) for one in self.of_specimen]
        return FittedPlate(
            specimen,
            Nuisances(specimen, tuple(n for n, _ in both)),
            np.array([z for _, z in both], dtype=float),
        )

    def covariance(self, names: list[str]) -> Array:
        """Of the log parameters; a parameter without error, at its limit, does not move.

        NaN where none has an error. Shape (parameters, parameters).
        """
        errors = np.array([_number(self.standard_errors.get(name)) for name in names])
        if np.isnan(errors).all():
            return np.full((len(names), len(names)), np.nan)
        size = errors / np.array([self.parameters[name] for name in names])
        like = np.array([[_number(self.correlations.get(a, {}).get(b)) for b in names] for a in names])
        return np.asarray(np.nan_to_num(like * np.outer(size, size)))


def read_fit(path: Path) -> FoundLaw:
    """The JSON of `viscorig identify`. Raises `BadInput`."""
    try:
        facts = json.loads(read_text(path))
        if isinstance(facts, dict) and "shift" in facts:
            raise BadInput(
                f"{path}: a law over several temperatures, expected the JSON of 'viscorig identify' at one: "
                'write a card (viscorig card FILE --to csv), and state that as the law (kind = "table")'
            )
        return FoundLaw.model_validate(facts)
    except json.JSONDecodeError as error:
        raise BadInput(f"{path}: {no_json(path, error)}, expected the JSON of 'viscorig identify'") from None
    except (ValidationError, RecursionError, OutsideModel):
        raise BadInput(f"{path}: expected the JSON of 'viscorig identify'") from None


def found_law(found: IdentificationResult) -> FoundLaw:
    """The law that a fit has found, from its result. Raises `ValidationError`."""
    return FoundLaw.model_validate(found.as_json())


def _number(value: float | None) -> float:
    return np.nan if value is None else value
