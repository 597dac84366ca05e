"""The fit's numbers in rows and words. No Qt."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import isnan

import numpy as np

from fitting.digits import two_digits
from fitting.identification.uncertainty import limits_reached
from fitting.laws import CoreLaw
from gui.actions.together import Fitted
from gui.pages.law.curve import At, LawCurve, places_hz
from instrument.facts.diagnosis import StageFitted
from instrument.results.numbers import format_number, with_error
from instrument.stream.derived import FitUpdated
from instrument.stream.raw import FitFailed

_NOT_FIXED = 1.0
"""Relative standard error beyond which a parameter is not fixed."""
STRONG = 0.99
"""Correlation from which the data fix a combination of two, not each: alone, one is known 7 times worse."""
_UNITS = (("_pa", "MPa", 1e-6), ("_rad_s", "rad/s", 1.0), ("_s", "s", 1.0))


@dataclass(frozen=True)
class Place:
    """The law at one frequency, and what it was before the diagnosis."""

    frequency_hz: float
    where: str
    law: At | None
    before: At | None


@dataclass(frozen=True)
class Parameter:
    """One of the law's."""

    key: str
    label: str
    value: str
    percent: str
    remark: str
    before: str


def places(law: LawCurve, resonances: dict[int, float], before: LawCurve | None = None) -> list[Place]:
    """The reference frequencies and the resonances, as far as they were measured."""
    return [
        Place(f, where, law.at(f), before.at(f) if before is not None else None)
        for f, where in places_hz(resonances, law)
    ]


def parameters(
    fit: Fitted | StageFitted,
    start: CoreLaw | None,
    correlations: Mapping[str, Mapping[str, float]],
    before: StageFitted | None = None,
) -> list[Parameter]:
    """Of the law that stands, with errors and remarks; `start` is the specimen's law."""
    reached = _limits_reached(fit.parameters, start)
    rows = []
    for key, value in fit.parameters.items():
        error = fit.standard_errors[key]
        label, scale = labelled(key)
        relative = error / abs(value) if not isnan(error) and value else None
        was = "–"
        if before is not None and key in before.parameters:
            was = with_error(before.parameters[key], before.standard_errors[key], scale)
        rows.append(
            Parameter(
                key,
                label,
                with_error(value, error, scale),
                two_digits(100 * relative) if relative is not None else "–",
                _remark(key, relative, reached, correlations.get(key, {})),
                was,
            )
        )
    return rows


def labelled(key: str) -> tuple[str, float]:
    """`g0_pa` as `g0 / MPa`, and the factor to it."""
    for ending, unit, scale in _UNITS:
        if key.endswith(ending):
            return f"{key.removesuffix(ending)} / {unit}", scale
    return key, 1.0


def _remark(
    key: str, relative: float | None, reached: dict[str, str], correlations: Mapping[str, float]
) -> str:
    """Whether the data fix it."""
    if key in reached:
        return f"at its {reached[key]} limit"
    if relative is None:
        return "no error: too few data"
    if relative > _NOT_FIXED:
        return "not fixed by these data"
    partners = [
        labelled(other)[0].split(" / ")[0]
        for other, c in correlations.items()
        if other != key and abs(c) > STRONG
    ]
    return f"fixed only together with {', '.join(partners)}" if partners else ""


def _limits_reached(values: Mapping[str, float], start: CoreLaw | None) -> dict[str, str]:
    if start is None or start.names != list(values):
        return {}
    return limits_reached(start.with_values(np.array(list(values.values()))))


def correlation_rows(fit: Fitted) -> tuple[list[str], list[list[float]]]:
    """Names, and the matrix; NaN for a parameter at a limit."""
    names = list(fit.correlations)
    return names, [[fit.correlations[a][b] for b in names] for a in names]


def _short(value: float) -> str:
    return f"{value:.0f}" if value >= 100 else format_number(value, 3)


def failure_words(failed: FitFailed, *, sweeping: bool) -> str:
    """Of a fit that broke off: why, and what goes on."""
    return f"{failed.words}; the sweep goes on, the next segment is fitted anew" if sweeping else failed.words


def headline(fits: Sequence[FitUpdated], running: int | None) -> str:
    """The latest fit in a line, and whether one is being computed."""
    latest = fits[-1] if fits else None
    goes_on = f"fit {running} is being computed" if running is not None else ""
    if latest is None:
        return goes_on
    f = latest.result
    if f is None:
        return "; ".join(filter(None, [f"fit {latest.number}: not yet: {latest.message}", goes_on]))
    said = [
        f"{f.law_kind} law, fit {latest.number} of {len(f.points)} points",
        f"rms {format_number(f.rms_percent, 3)} %",
    ]
    if f.chi2_per_dof is not None:
        said.append(f"chi² per degree {_short(f.chi2_per_dof)}")
    if f.held_out_rms_percent is not None:
        said.append(f"held out {format_number(f.held_out_rms_percent, 3)} %")
    if f.temperature_c is not None:
        said.append(f"at {f.temperature_c:.1f} °C")
    return ", ".join(said) + (f"; {goes_on}" if goes_on else "")
