"""A law as it was found, whoever found it: G' and eta over a band, how well they are known, what was said."""

import json
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated, Any

import numpy as np
from pydantic import AfterValidator, BaseModel, Field, ValidationError
from scipy.interpolate import PchipInterpolator

from fitting.arrays import Array, Complex
from fitting.errors import FittingError
from fitting.identification.known_curve import KnownCurve
from fitting.structures import AnySpecimen
from fitting.structures.shear_pair import ShearPair
from instrument.errors import BadInput
from instrument.facts.doubts import doubts_in
from instrument.facts.identification import IdentificationResult
from instrument.files.file_kind import LAWS, kind_of_facts, no_json
from instrument.files.table import LARGEST
from instrument.files.text import read_text
from instrument.interchange.given import is_session
from instrument.interchange.identified import identify_session
from instrument.material.contradictions import refuse_contradictions
from instrument.material.found_effect import NamedEffect
from instrument.material.found_shift import FoundShift
from instrument.material.knowledge import known_curve_of
from instrument.material.stated_part import Stated, digest_of, stated_numbers
from instrument.progress import Progress, quiet
from instrument.results.diagnosis_words import NOT_NAMED
from instrument.results.identification_from import identification_from
from instrument.results.session_result import recorded_result
from instrument.results.standing import none_leads
from instrument.session.contents import Contents, contents_of
from instrument.session.storage import SessionFile

NOT_DIAGNOSED = "not diagnosed"
NOT_STATED = "not stated"

Positive = Annotated[float, Field(ge=1 / LARGEST, le=LARGEST, allow_inf_nan=False)]
"""Less than that is divided by as badly as nothing."""
Finite = Annotated[float, Field(ge=-LARGEST, le=LARGEST, allow_inf_nan=False)]


Warmth = Annotated[float, Field(gt=-273.15, le=LARGEST, allow_inf_nan=False)]
"""Degrees Celsius."""


_EXPECTED = "expected the JSON of 'viscorig identify' or 'viscorig diagnose', or a session"


def _an_error(value: float) -> float:
    """NaN says that nothing is known."""
    if value < 0 or value > LARGEST:
        raise ValueError(f"{value:g}, expected a standard error")
    return value


Error = Annotated[float, AfterValidator(_an_error)]


class _Row(BaseModel):
    frequency_hz: Positive
    storage_modulus_pa: Positive
    loss_factor: Finite
    storage_modulus_standard_error_pa: Error | None = None
    loss_factor_standard_error: Error | None = None


class _LawFound(BaseModel):
    """What `identify` says, or `after` of `diagnose`."""

    law_kind: str
    parameters: dict[str, float]
    standard_errors: dict[str, float | None] = {}
    law: list[_Row] = Field(min_length=2)
    temperature_c: Warmth | None = None
    converged: bool = True


class _Warm(BaseModel):
    """What a session's result says of its temperature."""

    temperature_range_c: tuple[Finite, Finite]


class _Weighed(BaseModel):
    name: str
    probability: float | None = None


class _Diagnosed(BaseModel):
    verdict: str
    after: _LawFound
    effects: list[NamedEffect] = []
    equivalent: dict[str, list[str]] = {}
    candidates: list[_Weighed] = []
    by_hand: bool = False

    @property
    def words(self) -> str:
        """What the verdict names, and what the data cannot tell from it."""
        said = " and ".join(e.words for e in self.effects)
        if not self.by_hand and none_leads(
            self.equivalent, {c.name: c.probability or 0.0 for c in self.candidates}
        ):
            shown = [e.words for e in self.effects if e.name not in self.equivalent]
            return f"{' and '.join(['no effect', *shown])}, not told from {' and '.join(self.equivalent)}"
        others = [n for name, group in self.equivalent.items() for n in group if n != name]
        if others:
            said += f", not told from {', '.join(NOT_NAMED.get(n, n) for n in others)}"
        return said


@dataclass(frozen=True)
class MaterialLaw:
    """A core's law over the band that was measured. Arrays have shape (frequencies,), ascending."""

    source: str
    """The file's name."""
    specimen: str
    verdict: str
    kind: str
    parameters: dict[str, float]
    standard_errors: dict[str, float | None]
    frequency_hz: Array
    storage_modulus_pa: Array
    loss_factor: Array
    storage_modulus_standard_error_pa: Array
    """NaN where the data say nothing of it."""
    loss_factor_standard_error: Array
    temperature_c: float | None = None
    poisson: float | None = None
    """Of the core, as stated."""
    shift: FoundShift | None = None
    """Of a law over several temperatures: its frequencies are reduced ones."""
    found: str = ""
    """The effects that it reckons with, named by a diagnosis or common to all temperatures, in words."""
    remount: int | None = None
    """Which mount of its specimen it was, where a session says so."""
    known: KnownCurve | None = None
    """Of the whole curve, where the source says so."""
    stated: tuple[Stated, ...] = ()
    """The numbers with a tolerance that it rests on."""
    doubts: tuple[str, ...] = ()
    """What is said of it by which it may be wrong by more than is known of it."""
    converged: bool = True
    """Whether its fit came to its end."""

    @property
    def is_doubted(self) -> bool:
        """Whether its fit, not diagnosed, says of itself that it may be biased."""
        return self.verdict == NOT_DIAGNOSED and bool(self.doubts)

    @property
    def same(self) -> str | None:
        """Which stated numbers it rests on: laws of one digest share what is wrong with them."""
        return digest_of(self.stated)

    @property
    def band_hz(self) -> tuple[float, float]:
        """The first and the last frequency."""
        return float(self.frequency_hz[0]), float(self.frequency_hz[-1])

    @property
    def hardly_known(self) -> str:
        """Words where the standard error of G' is typically above G'; empty elsewhere."""
        times = float(np.median(self.storage_modulus_standard_error_pa / self.storage_modulus_pa))
        if not times > 1.0:
            return ""
        return f"the standard error of G' is {times:.2g} times G' (median): this law is hardly known"

    def modulus(self, omega: Array) -> Complex:
        """G* in Pa inside the band: what is listed, smoothly in the logarithm of the frequency."""
        x, at = np.log(self.frequency_hz), np.log(np.asarray(omega) / (2 * np.pi))
        # A band's own edge may round to just outside it.
        at = np.clip(at, x[0], x[-1])
        storage = np.exp(PchipInterpolator(x, np.log(self.storage_modulus_pa))(at))
        return np.asarray(storage * (1 + 1j * PchipInterpolator(x, self.loss_factor)(at)))


def read_law(path: Path, progress: Progress = quiet) -> MaterialLaw:
    """From a session (after its diagnosis, where it has one) or the JSON of `identify` or `diagnose`.

    Raises `BadInput`, `FittingError`.
    """
    if is_session(path):
        return _of_session(path, progress)
    try:
        facts = json.loads(read_text(path))
    except json.JSONDecodeError as error:
        raise BadInput(f"{path}: {no_json(path, error)}, {_EXPECTED}") from None
    except RecursionError:
        raise BadInput(f"{path}: not JSON that can be read (too deep), {_EXPECTED}") from None
    found = _of_facts(path, facts)
    if found is None:
        kind = kind_of_facts(facts)
        raise BadInput(f"{path}: {kind}, {_EXPECTED}" if kind not in ("", *LAWS) else f"{path}: {_EXPECTED}")
    errors = found.storage_modulus_standard_error_pa
    rows = (found.frequency_hz, found.storage_modulus_pa, found.loss_factor, errors)
    refuse_contradictions(path, found.kind, found.parameters, rows)
    return found


def _of_facts(path: Path, facts: Any) -> MaterialLaw | None:
    """Of a diagnosis where there is one, else of an identification; None where either is damaged."""
    if not isinstance(facts, dict):
        return None
    if "shift" in facts:
        return _shifted(path, facts)
    for inside in (facts, facts.get("diagnose")):
        # The law before a diagnosis does not stand for one that cannot be read.
        if (
            isinstance(inside, dict)
            and {"verdict", "after"} <= set(inside)
            and _diagnosed(path, inside) is None
        ):
            return None
    for read in (_diagnosed, _identified):
        for inside in (facts, facts.get("diagnose"), facts.get("identify")):
            if isinstance(inside, dict) and (found := read(path, inside)) is not None:
                warm = found.temperature_c
                return replace(found, temperature_c=_of_session_c(facts) if warm is None else warm)
    return None


def _of_session_c(facts: dict[str, Any]) -> float | None:
    """The middle of what the session's own result says, in the JSON of `run` or of `identify`."""
    for key in ("result", "session_result"):
        try:
            low, high = _Warm.model_validate(facts.get(key)).temperature_range_c
        except ValidationError:
            continue
        return (low + high) / 2
    return None


def _diagnosed(path: Path, facts: dict[str, Any]) -> MaterialLaw | None:
    try:
        found = _Diagnosed.model_validate(facts)
    except ValidationError:
        return None
    law = _law(path, found.after, found.verdict)
    if law is None:
        return None
    return replace(_as_known(law, facts["after"]), found=found.words, doubts=doubts_in(facts))


def _shifted(path: Path, facts: dict[str, Any]) -> MaterialLaw | None:
    """Of the JSON of `identify --shift`. Raises `BadInput` where that refused the law."""
    try:
        shift = FoundShift.model_validate(facts)
        found = _law(path, _LawFound.model_validate(facts), shift.verdict)
    except ValidationError:
        return None
    if found is None:
        return None
    if shift.simple is False:
        raise BadInput(
            f"{path}: one law for all its temperatures was refused, expected one that 'viscorig identify "
            "--shift' has not refused"
        )
    cause = shift.common_cause.words if shift.common_cause is not None else ""
    return replace(found, shift=shift, temperature_c=shift.reference_c, found=cause, doubts=doubts_in(facts))


def law_of_result(path: Path, result: IdentificationResult) -> MaterialLaw | None:
    """Of an identification of the data at `path`; None where it has no band."""
    return _identified(path, result.as_json())


def _identified(path: Path, facts: dict[str, Any]) -> MaterialLaw | None:
    """Of the JSON of `identify`; None where it is none."""
    try:
        found = _law(path, _LawFound.model_validate(facts), NOT_DIAGNOSED)
    except ValidationError:
        return None
    if found is None:
        return None
    return replace(_as_known(found, facts), doubts=doubts_in(facts))


def _as_known(law: MaterialLaw, facts: dict[str, Any]) -> MaterialLaw:
    return replace(law, known=known_curve_of(facts), stated=stated_numbers(facts))


def _of_session(path: Path, progress: Progress) -> MaterialLaw:
    with SessionFile(path) as session:
        contents = contents_of(session, with_hits=False)
    found, result = None, recorded_result(contents)
    event = contents.diagnosis if result.verdict is not None else contents.fit
    if result.is_complete and event is not None and event.result is not None:
        found = _of_facts(path, event.result.as_json())
    found = found or _identified_now(path, contents, progress)
    specimen = contents.specimen
    temperatures = [p.temperature_c for p in contents.measured if p.temperature_c is not None]
    return replace(
        found,
        specimen=contents.configuration.experiment.specimen,
        temperature_c=float(np.mean(temperatures)) if temperatures else None,
        remount=contents.configuration.experiment.mounting.remount,
        poisson=stated_poisson(specimen),
    )


def stated_poisson(specimen: AnySpecimen) -> float | None:
    """Of its core; None where there is none, or where nothing depends on it and no file states it."""
    pad = isinstance(specimen, ShearPair)
    return None if specimen.core is None or pad else specimen.core.poisson


def _identified_now(path: Path, contents: Contents, progress: Progress) -> MaterialLaw:
    """Of a session that was recorded without a fit."""
    try:
        identified = identify_session(contents, progress)
    except FittingError as error:
        raise BadInput(f"{path}: no law in this session, and none to be found: {error}") from None
    found = law_of_result(path, identification_from(identified))
    if found is None:
        raise BadInput(f"{path}: the law of this session has no band, expected a sweep over a range")
    return found


def _law(path: Path, found: _LawFound, verdict: str) -> MaterialLaw | None:
    rows = {row.frequency_hz: row for row in found.law}
    f = np.array(sorted(rows))
    if len(f) < 2 or any(rows[row.frequency_hz] != row for row in found.law):
        return None

    def column(name: str) -> Array:
        values = [getattr(rows[at], name) for at in f.tolist()]
        return np.array([np.nan if v is None else v for v in values], dtype=float)

    storage, loss, storage_error, loss_error = (column(name) for name in list(_Row.model_fields)[1:])
    return MaterialLaw(
        path.name,
        NOT_STATED,
        verdict,
        found.law_kind,
        found.parameters,
        found.standard_errors,
        f,
        storage,
        loss,
        storage_error,
        loss_error,
        found.temperature_c,
        converged=found.converged,
    )
