"""Data of several temperatures under one law in reduced frequency, whatever they were measured on."""

from collections.abc import Sequence
from dataclasses import dataclass
from time import perf_counter

import numpy as np
from threadpoolctl import threadpool_limits

from fitting.arrays import Array
from fitting.digits import two_digits
from fitting.errors import OutsideModel
from fitting.identification.adjusted import Adjusted
from fitting.identification.doubt import BIASED, Doubt
from fitting.identification.result import LawBand, moved_too_far
from fitting.identification.uncertainty import Uncertainty
from fitting.structures import AnySpecimen
from fitting.sweep import Sweep
from fitting.temperature.causes import Cause, explains, without_any
from fitting.temperature.joint import TemperatureProblem
from fitting.temperature.members import Alone
from fitting.temperature.shifted_fit import ShiftedFit
from fitting.temperature.shifts import Kind, Shift
from fitting.temperature.simple import OddOne, Verdict, in_doubt, judge, serving, story
from fitting.temperature.spots import spots_apart_m
from fitting.temperature.thermometers import Misread, off_any_curve, rising
from instrument.errors import BadInput
from instrument.models.set_up import Hammer
from instrument.progress import Progress, quiet
from instrument.remarks.free_layers import remark_on_free_layers
from instrument.temperatures.members import AtTemperature, Members
from instrument.temperatures.temperature_fits import TemperatureFits

_BAND_POINTS = 61
_SCATTERED = 0.01
"""Tail probability below which temperatures lie farther off than is said of them."""
_FORMS = {"wlf": "WLF", "arrhenius": "Arrhenius' line"}
_PLAIN = 3.0
"""Standard errors of a shift factor, by which it lies above a colder one's. A choice."""
THERMOMETER_K = 0.3
"""Typical standard deviation of a stated temperature: a good thermocouple may be 0.5 K off, a plate lags."""


@dataclass(frozen=True)
class Shifted:
    """What all temperatures gave together."""

    fit: ShiftedFit
    verdict: Verdict
    band: LawBand
    """Over reduced frequency, at the reference temperature."""
    alone: tuple[Alone, ...]
    """Each member by itself."""
    cause: Cause | None
    """Counted in, because all sweeps seem to have it in common."""
    seconds: float
    remarks: tuple[str, ...] = ()
    """On data, specimens and theory."""
    adjusted: tuple[Adjusted, ...] = ()
    """The stated numbers as the fit has them."""
    predicted_modes: tuple[Array, Array] = (np.zeros(0), np.zeros(0))
    """Frequencies and loss factors of tables under the one law. Shape (all modes,) each."""
    otherwise: str = ""
    """What to ask of tables that fit far better in another unit; empty where none does."""

    @property
    def warnings(self) -> tuple[str, ...]:
        """What the numbers do not say."""
        said = [] if self.fit.converged else ["not converged: take the values as provisional"]
        a = np.exp(self.fit.sweeps_log_shift)
        reduced = sorted((low * k, high * k) for (low, high), k in zip(self.fit.bands_hz, a, strict=True))
        reach = np.maximum.accumulate([high for _, high in reduced])
        if any(low > before for (low, _), before in zip(reduced[1:], reach, strict=False)):
            said.append("data do not overlap in reduced frequency: there the shift rests on the law's form")
        known = self.fit.stated_covariance if self.adjusted else None
        if self.verdict.simple is False:
            said.insert(0, Doubt(f"one law for all temperatures is refused: it is not to be used, {BIASED}"))
        elif not self.verdict.law_stands:
            words = f"no law explains these readings as they are: this one is not to be used, {BIASED}"
            said.insert(0, Doubt(words))
        elif self.verdict.simple is None and self.cause is not None:
            words = (
                f"this law stands only where {story(self.cause)}: if the material is not simple it is no "
                "law of it, and its errors say nothing"
            )
            said.insert(0, Doubt(words))
        elif self.cause is not None and len(self.predicted_modes[0]):
            words = (
                f"this law stands only where {story(self.cause)}: modes are few numbers, and nothing else "
                "shows it; a table that a formula made, and no specimen, asks for such a cause too"
            )
            said.insert(0, Doubt(words))
        return (*said, *moved_too_far(self.adjusted, known), *self._of_temperatures, *self.remarks)

    @property
    def _of_temperatures(self) -> tuple[str, ...]:
        """What is to be thought of the stated temperatures."""
        said, fit, T = list[str](), self.fit, self.fit.shift.temperature_c
        if fit.shift.kind != "free" and len(np.unique(T)) == len(fit.shift.names) + 1:
            said.append(
                f"{len(np.unique(T))} temperatures fix {_FORMS[fit.shift.kind]} without one to spare: "
                "nothing checks a temperature, and a wrong one makes another form; measure at one more"
            )
        # Where one is known to be wrong, others are bent by it.
        if self.verdict.wrong is None and (fit.suspects or fit.temperature_chance < _SCATTERED):
            said.append(_doubt_of_temperatures(fit))
        if self.stiffens is not None:
            said.append(self.stiffens)
        elif (wrong := off_any_curve(fit)) is not None:
            said.append(_doubt_of_factors(wrong))
        return tuple(said)

    @property
    def stiffens(self) -> str | None:
        """For people, where the core would stiffen as it warms."""
        upwards = rising(self.fit.shift, self.fit.log_shift)
        return (
            None
            if upwards is None
            else (
                f"the factor of {upwards[1]:g} degC is above that of {upwards[0]:g} degC: no polymer "
                "stiffens as it warms, one of these temperatures is wrong or another batch's"
            )
        )

    @property
    def plainly_stiffens(self) -> bool:
        """Whether it would by more than the factors are uncertain."""
        fit = self.fit
        return rising(fit.shift, fit.log_shift, _PLAIN * fit.log_shift_errors) is not None


def _doubt_of_temperatures(fit: ShiftedFit) -> Doubt:
    """Which of the stated temperatures may be the wrong one, and what it is by the others."""
    words = f"temperatures lie farther from the form than {fit.shift.error_k:g} K allows"
    check = "check it, or say with --temperature-k how well they are known"
    if not fit.suspects:
        return Doubt(f"{words}, not one of them alone: {check}; errors of the shift are too small")
    which = " or ".join(f"{s.stated_c:.4g} degC ({s.by_others_c:.1f} by the others)" for s in fit.suspects)
    several = " (these data do not tell which)" if len(fit.suspects) > 1 else ""
    return Doubt(
        f"{words}, as if one were stated wrongly: {which}{several}: {check}; errors of law and shift are "
        f"widened by it, but {BIASED}"
    )


def _doubt_of_factors(wrong: Misread) -> Doubt:
    """Which of the free factors lies off the curve of the others, and where they have its temperature."""
    each = (wrong, *wrong.rivals)
    which = " or ".join(f"{m.stated_c:.4g} degC ({m.read_c:.1f} by the others)" for m in each)
    return Doubt(
        f"free factors lie on no WLF curve, as if one temperature were stated wrongly: {which}: check it, "
        f"the reference's own makes all of G' wrong, and {BIASED}; or a transition lies between them"
    )


def identify_shifted(
    every: Sequence[AtTemperature],
    specimens: AnySpecimen | Sequence[AnySpecimen],
    kind: Kind,
    reference_c: float | None = None,
    progress: Progress = quiet,
    *,
    vertical: bool = False,
    hammer: Hammer | None = None,
    temperature_k: float | None = None,
) -> Shifted:
    """One law and its shifts. Raises `BadInput`, `FittingError`; the verdict is left to the caller.

    `specimens` by their numbers from 1, or the one of all. `hammer` is the bare plate's test, one for all
    sweeps. `temperature_k` is the standard deviation of each stated temperature; without it a typical one,
    none where everything that is stated is exact.
    """
    stated = list(specimens) if isinstance(specimens, Sequence) else [specimens]
    T = np.array([one.temperature_c for one in every])
    _check(every, stated, kind, T)
    reference = _reference(T, kind, reference_c)
    began = perf_counter()
    if temperature_k is None:
        temperature_k = 0.0 if all(s.exact for s in stated) else THERMOMETER_K
    shift = Shift(kind, T, reference, temperature_k)
    members = Members(every, stated, hammer)
    asked = TemperatureFits(members, shift, vertical, progress)
    with threadpool_limits(1, "blas"):
        tried = _tried(asked)
    names = [one.name for one in every]
    verdict = judge(
        tried.fit, tried.causes, tried.apart, names, members.scale_known, tried.odd, tried.odd_ones
    )
    cause = next(iter(serving(tried.causes)), None)
    fit = cause.fit if cause is not None else tried.fit
    remarks = asked.remarks(tried.problem, fit)
    if tried.aimed_anew:
        apart_mm = 1e3 * spots_apart_m(tried.problem.joined, fit.one.z)
        remarks += (
            "the laser's spot was elsewhere from temperature to temperature (up to "
            f"{two_digits(apart_mm)} mm): each has its own",
        )
    band = _band(fit)
    reach_hz = float(band.frequency_hz[0]), float(band.frequency_hz[-1])
    remarks += remark_on_free_layers(stated, fit.law, fit.law_covariance, reach_hz, fit.quantities)
    if reference_c is not None and reference != reference_c:
        remarks += (
            f"one factor a temperature says nothing between them: the law is at {reference:g} degC, the "
            f"nearest to {reference_c:g}",
        )
    joined = tried.problem.joined
    return Shifted(
        fit,
        verdict,
        band,
        tuple(tried.alone),
        cause,
        perf_counter() - began,
        remarks,
        joined.adjusted(fit.one.z, fit.stated_errors),
        joined.modes(fit.one.velocity_m_s),
        tried.otherwise,
    )


@dataclass(frozen=True)
class _Tried:
    """One law for all, and what was looked at where it does not serve."""

    alone: Sequence[Alone]
    problem: TemperatureProblem
    fit: ShiftedFit
    aimed_anew: bool
    """Whether each temperature has a spot of its own."""
    otherwise: str
    """What to ask of tables that fit far better in another unit."""
    odd: Sequence[str]
    """Readings that are to be looked at first."""
    apart: ShiftedFit | None
    """One law with a factor for every temperature."""
    causes: list[Cause]
    odd_ones: Sequence[OddOne]


def _tried(asked: TemperatureFits) -> _Tried:
    """Every fit in its turn, as far as the ones before leave doubt."""
    alone, problem, fit = asked.fitted(with_effects=False)
    if in_doubt(fit) and explains(fit):
        fit = asked.freer(problem, fit)
    aimed_anew = asked.with_own_spots(alone) if in_doubt(fit) else None
    if aimed_anew is not None:
        problem, fit = aimed_anew
    # A column that is meant otherwise is no row's fault, a row that is wrong is no temperature's, nor a
    # cause that all have.
    otherwise = asked.read_otherwise(alone) if in_doubt(fit) else ""
    odd = [otherwise] if otherwise else asked.members.odd_rows(alone) if in_doubt(fit) else []
    apart = asked.each_apart(alone) if in_doubt(fit) and not odd else None
    told = bool(odd) or (apart is not None and not in_doubt(apart))
    causes = asked.common_causes(alone, problem, fit) if in_doubt(fit) and not told else []
    fit, causes = _off_the_causes(fit, causes)
    refused = in_doubt(fit) and not told and not serving(causes) and explains(fit)
    odd_ones = asked.odd_ones(alone) if refused else []
    return _Tried(alone, problem, fit, aimed_anew is not None, otherwise, odd, apart, causes, odd_ones)


def _off_the_causes(fit: ShiftedFit, causes: list[Cause]) -> tuple[ShiftedFit, list[Cause]]:
    """The fit that serves beside a cause and does without it: then none is needed. Else as they are."""
    bare = without_any(causes)
    return (fit, causes) if bare is None else (bare, [])


def _reference(T: Array, kind: Kind, wanted_c: float | None) -> float:
    """The temperature of the law: as wanted, or the middle one; with a factor each, one that was measured."""
    if wanted_c is None:
        return float(np.sort(T)[(len(T) - 1) // 2])
    return float(T[np.argmin(np.abs(T - wanted_c))]) if kind == "free" else wanted_c


def _check(every: Sequence[AtTemperature], stated: Sequence[AnySpecimen], kind: Kind, T: Array) -> None:
    if any(s.core is None for s in stated):
        raise OutsideModel("a bare specimen has no core to identify, expected a core in every one")
    if len({s.kind for s in stated}) > 1:
        raise BadInput(f"--shift: {' and '.join(sorted({s.kind for s in stated}))}, expected one of them")
    needed = Shift(kind, T, float(T[0])).fewest
    count = len(np.unique(T))
    if count < needed:
        raise BadInput(f"--shift {kind}: {count} temperature{'s' * (count > 1)}, expected {needed} or more")
    sweeps = [one.data for one in every if isinstance(one.data, Sweep)]
    if len({s.has_phase for s in sweeps}) > 1:
        raise BadInput("some sweeps hold phasors, others amplitudes, expected one of them")


def _band(fit: ShiftedFit) -> LawBand:
    a = np.exp(fit.sweeps_log_shift)
    low = min(b[0] * k for b, k in zip(fit.bands_hz, a, strict=True))
    high = max(b[1] * k for b, k in zip(fit.bands_hz, a, strict=True))
    f: Array = np.geomspace(low, high, _BAND_POINTS)
    storage, eta = fit.law.storage_and_loss(2 * np.pi * f)
    errors = Uncertainty(fit.law_covariance, {}, 1.0).law_band(fit.law, 2 * np.pi * f)
    return LawBand(f, storage, eta, *errors)
