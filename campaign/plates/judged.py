"""What `identify` and `diagnose` say of a case: functions of a module, for other processes."""

from collections.abc import Collection
from dataclasses import replace
from functools import lru_cache

import numpy as np

from campaign.plates.answers import Answer, Band, answer_from, band_from
from campaign.plates.cases import PlateCase
from campaign.plates.geometry import plate_named
from campaign.plates.stated import CAREFUL, draw_stated, specimen_from, toml
from fitting.effects import CATALOGUE
from fitting.specimen import PlateSpecimen
from instrument.finding.diagnosis import diagnose
from instrument.finding.identification import identify
from instrument.models.files import File
from instrument.results.diagnosis_from import diagnosis_from
from instrument.results.identification_from import identification_from

_SEED, _MIDDLE_HZ, _RATIO = 7, 100.0, 2e-3


def identified(case: PlateCase) -> Band:
    """The law with its errors."""
    found = identify([File(case.sweep, case.specimen, like=_like(case))], hammer=case.hammer)
    return band_from(identification_from(found).law)


def diagnosed(case: PlateCase) -> Answer:
    """With the whole catalogue."""
    return _diagnosed(case)


def diagnosed_without_the_truth(case: PlateCase) -> Answer:
    """With all of it but what is really there."""
    return _diagnosed(case, left_out(case.truth.names))


def left_out(there: Collection[str]) -> list[str]:
    """Of the catalogue what is there, and what contains it: two masses bring the one along."""
    return [e.name for e in CATALOGUE.values() if {e.name, e.extends} & set(there)]


def _diagnosed(case: PlateCase, without: Collection[str] = ()) -> Answer:
    found = diagnose([File(case.sweep, case.specimen, like=_like(case))], hammer=case.hammer, without=without)
    return answer_from(diagnosis_from(found))


def _like(case: PlateCase) -> PlateSpecimen | None:
    return None if case.exact else models_of(case.truth.plate.name)


@lru_cache
def models_of(plate: str) -> PlateSpecimen:
    """One statement of a plate, as far off the truth as any other: its models serve all of them."""
    rng = np.random.default_rng([_SEED, *plate.encode()])
    stated = specimen_from(toml(draw_stated(rng, plate_named(plate)), CAREFUL, _MIDDLE_HZ))
    return replace(stated, modal_ratios=(_RATIO,) * len(stated.modal_ratios))
