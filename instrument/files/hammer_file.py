"""The JSON of `viscorig damping`, read back as natural frequencies and ratios."""

import json
from pathlib import Path
from typing import NamedTuple

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, ValidationError

from fitting.arrays import Array
from fitting.dynamics.bare_modes import CarriedSensor
from fitting.errors import TooFewPoints
from instrument.errors import BadInput
from instrument.facts.damping import DampingResult
from instrument.files.file_kind import ANY_JSON, no_json, refuse_another
from instrument.files.text import read_text

_HIGHEST_HZ = 1e6
"""No hammer reaches it."""


class _Mode(BaseModel):
    model_config = ConfigDict(strict=True)

    frequency_hz: float = Field(gt=0, le=_HIGHEST_HZ, allow_inf_nan=False)
    damping_ratio: float | None = Field(default=None, ge=0, lt=0.2, allow_inf_nan=False)
    accepted: bool = True


class _Sensor(BaseModel):
    mass_kg: float = Field(ge=0, le=1, allow_inf_nan=False)
    x_m: float = Field(ge=0, allow_inf_nan=False)
    y_m: float = Field(ge=0, allow_inf_nan=False)


class _Document(BaseModel):
    modes: list[_Mode]
    sensor: _Sensor | None = None


class HammerModes(NamedTuple):
    """The accepted modes of a bare plate's hammer test: arguments of `fit_bare_plate`."""

    frequency_hz: Array
    ratios: Array
    """NaN where there is none."""
    sensor: CarriedSensor | None
    """What sat on the plate."""


def read_hammer(path: Path) -> HammerModes:
    """The JSON of `viscorig damping`. Raises `BadInput`."""
    refuse_another(path, ANY_JSON, "the JSON of 'viscorig damping', or a session")
    try:
        document = _Document.model_validate(json.loads(read_text(path)))
        if not any("damping_ratio" in m.model_fields_set for m in document.modes):
            raise BadInput(f"{path}: no damping_ratio, expected the JSON of 'viscorig damping'")
        _refuse_undamped(path, document)
        return _modes(document)
    except json.JSONDecodeError as error:
        raise BadInput(
            f"{path}: {no_json(path, error)}, expected the JSON of 'viscorig damping', or a session"
        ) from None
    except (ValidationError, RecursionError) as error:
        first = error.errors()[0] if isinstance(error, ValidationError) else None
        place = ".".join(str(p) for p in first["loc"]) or "the whole" if first else "nesting"
        said = f": {_words(first['type'], first['msg'])}" if first else ""
        if first and first["loc"][-1:] == ("damping_ratio",):
            said += " (a fraction of critical, not percent)"
        raise BadInput(f"{path}: {place}{said}, expected the JSON of 'viscorig damping'") from None
    except TooFewPoints as error:
        raise BadInput(f"{path}: {error}") from None


def _refuse_undamped(path: Path, document: _Document) -> None:
    """Raise `BadInput` for an accepted mode of no damping: it would silently stand for one not read."""
    for k, mode in enumerate(document.modes):
        if mode.accepted and mode.damping_ratio == 0:
            raise BadInput(
                f"{path}: modes.{k}.damping_ratio: 0 at {mode.frequency_hz:g} Hz, no plate rings for ever: "
                "expected a fraction of critical, or null where none was read"
            )


def _words(kind: str, message: str) -> str:
    return "no object" if kind == "model_type" else message.lower()


def hammer_modes(found: DampingResult) -> HammerModes:
    """Modes that a hammer test has accepted, from its result. Raises `ValidationError`, `TooFewPoints`."""
    return _modes(_Document.model_validate(found.as_json()))


def _modes(document: _Document) -> HammerModes:
    modes = [m for m in document.modes if m.accepted]
    if not modes:
        raise TooFewPoints("no accepted mode")
    ratios = [np.nan if m.damping_ratio is None else m.damping_ratio for m in modes]
    s = document.sensor
    sensor = CarriedSensor(s.mass_kg, s.x_m, s.y_m) if s is not None and s.mass_kg > 0 else None
    return HammerModes(np.array([m.frequency_hz for m in modes]), np.array(ratios), sensor)


def accepted_modes(found: DampingResult) -> HammerModes | None:
    """Modes as `hammer_modes` has them, of a test that may have none. Raises `ValidationError`."""
    return hammer_modes(found) if found.accepted else None
