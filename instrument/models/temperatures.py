"""Sweeps of one plate at several temperatures under one law in reduced frequency."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from time import perf_counter

import numpy as np
from threadpoolctl import threadpool_limits

from fitting.arrays import Array
from fitting.diagnosis.begin import Begun, begin
from fitting.errors import OutsideModel
from fitting.identification.result import LawBand
from fitting.identification.uncertainty import Uncertainty
from fitting.noise import noise_of
from fitting.specimen import Specimen
from fitting.sweep import Sweep
from fitting.temperature.causes import Alone, Cause, causes_of, common
from fitting.temperature.joint import ShiftedFit, TemperatureProblem, fit_shifted
from fitting.temperature.shifts import Kind, Shift
from fitting.temperature.simple import Verdict, in_doubt, judge, serving
from fitting.temperature.thermometers import each_its_own, rising
from instrument.errors import BadInput
from instrument.models.diagnosis import effects_on
from instrument.models.second_process import executor
from instrument.models.set_up import Hammer, set_up
from instrument.models.theory import theory_over
from instrument.progress import Progress, quiet

_BAND_POINTS = 61
_SCATTERED = 0.01
"""Tail probability below which temperatures lie farther off than is said of them."""
_FORMS = {"wlf": "WLF", "arrhenius": "Arrhenius' line"}
THERMOMETER_K = 0.3
"""Typical standard deviation of a stated temperature: a good thermocouple may be 0.5 K off, a plate lags."""


@dataclass(frozen=True)
class AtTemperature:
    """A sweep and the core's temperature."""

    sweep: Sweep
    temperature_c: float
    name: str = ""


@dataclass(frozen=True)
class Shifted:
    """What all temperatures gave together."""

    fit: ShiftedFit
    verdict: Verdict
    band: LawBand
    """Over reduced frequency, at the reference temperature."""
    begun: tuple[Begun, ...]
    """Each temperature by itself."""
    cause: Cause | None
    """Counted in, because all sweeps seem to have it in common."""
    seconds: float

    @property
    def warnings(self) -> tuple[str, ...]:
        """What the numbers do not say."""
        said = [] if self.fit.converged else ["not converged: take the values as provisional"]
        f = [(b.problem.sweep.frequency_hz.min(), b.problem.sweep.frequency_hz.max()) for b in self.begun]
        a = np.exp(self.fit.sweeps_log_shift)
        reduced = sorted((low * k, high * k) for (low, high), k in zip(f, a, strict=True))
        gaps = [one[1] < two[0] for one, two in pairwise(reduced)]
        if any(gaps):
            said.append("sweeps do not overlap in reduced frequency: there the shift rests on the law's form")
        return (*said, *self._of_temperatures)

    @property
    def _of_temperatures(self) -> tuple[str, ...]:
        """What is to be thought of the stated temperatures."""
        said, fit, T = list[str](), self.fit, self.fit.shift.temperature_c
        if fit.shift.kind != "free" and len(np.unique(T)) == len(fit.shift.names) + 1:
            said.append(
                f"{len(np.unique(T))} temperatures fix {_FORMS[fit.shift.kind]} without one to spare: "
                "nothing checks a temperature, and a wrong one makes another form; measure at one more"
            )
        if fit.temperature_chance < _SCATTERED:
            k = int(np.argmax(np.abs(fit.joint.off)))
            said.append(
                f"temperatures lie farther from the form than {fit.shift.error_k:g} K allows, {T[k]:g} degC "
                f"by {-fit.joint.off[k] * fit.shift.error_k:+.2g} K: check it, or say with "
                "--temperature-k how well they are known; errors of the shift are too small"
            )
        upwards = rising(fit.shift, fit.log_shift)
        if upwards is not None:
            said.append(
                f"the factor of {upwards[1]:g} degC is above that of {upwards[0]:g} degC: no polymer "
                "stiffens as it warms, one of these temperatures is wrong or another batch's"
            )
        return tuple(said)


def identify_shifted(
    sweeps: Sequence[AtTemperature],
    specimen: Specimen,
    kind: Kind,
    reference_c: float | None = None,
    progress: Progress = quiet,
    *,
    vertical: bool = False,
    hammer: Hammer | None = None,
    temperature_k: float | None = None,
) -> Shifted:
    """One law and its shifts. Raises `BadInput`, `FittingError`; the verdict is left to the caller.

    `hammer` is the bare plate's test, one for all sweeps. `temperature_k` is the standard deviation of each
    stated temperature; without it a typical one, none where everything that is stated is exact.
    """
    if specimen.core is None:
        raise OutsideModel("a bare plate has no core to identify, expected [core] and [constraining]")
    T = np.array([one.temperature_c for one in sweeps])
    needed = {"wlf": 3, "arrhenius": 2, "free": 2}[kind]
    count = len(np.unique(T))
    if count < needed:
        raise BadInput(f"--shift {kind}: {count} temperatures, expected {needed} or more")
    if len({one.sweep.has_phase for one in sweeps}) > 1:
        raise BadInput("some sweeps hold phasors, others amplitudes, expected one of them")
    reference = float(np.sort(T)[(len(T) - 1) // 2]) if reference_c is None else reference_c
    began = perf_counter()
    if temperature_k is None:
        temperature_k = 0.0 if specimen.exact else THERMOMETER_K
    shift = Shift(kind, T, reference, temperature_k)
    asked = _Asked(sweeps, specimen, hammer, shift, vertical, progress)
    with threadpool_limits(1, "blas"):
        alone, task, fit = asked.fitted(with_effects=False)
        apart = asked.each_apart(alone) if in_doubt(fit) else None
        told = apart is not None and not in_doubt(apart)
        causes = asked.common_causes(alone, task, fit) if in_doubt(fit) and not told else []
    begun = tuple(a.begun for a in alone)
    verdict = judge(fit, causes, apart, [one.name for one in sweeps])
    cause = next(iter(serving(causes)), None)
    fit = cause.fit if cause is not None else fit
    for k, one in enumerate(sweeps):
        theory_over(specimen, fit.own_law(k), one.sweep.frequency_hz)
    return Shifted(fit, verdict, _band(fit, begun), begun, cause, perf_counter() - began)


@dataclass(frozen=True)
class _Asked:
    """What is to be fitted."""

    sweeps: Sequence[AtTemperature]
    specimen: Specimen
    hammer: Hammer | None
    shift: Shift
    vertical: bool
    progress: Progress

    def fitted(self, *, with_effects: bool) -> tuple[list[Alone], TemperatureProblem, ShiftedFit]:
        """Each temperature by itself, then all of them; with models that effects can change, or without."""
        assert self.specimen.core is not None
        alone = []
        with self.progress("each temperature by itself") as report:
            for k, one in enumerate(self.sweeps):
                ready = set_up(one.sweep, self.specimen, self.hammer, with_effects=with_effects)
                noise = noise_of(one.sweep)
                found = begin(ready.problem, ready.reduced, noise, ready.bare, self.specimen.core.law)
                alone.append(Alone(found, ready.reduced, noise))
                report((k + 1) / len(self.sweeps))
        with self.progress("one law for all"):
            begun = [a.begun for a in alone]
            task = TemperatureProblem.of(begun, self.shift, vertical=self.vertical)
            fit = fit_shifted(task, [b.none.law for b in begun], task.stated([b.none.z for b in begun]))
        return alone, task, fit

    def each_apart(self, alone: Sequence[Alone]) -> ShiftedFit | None:
        """One law with a factor for every sweep, whatever its temperature; None where it is no other."""
        if self.shift.kind == "free" and len(np.unique(self.shift.temperature_c)) == len(self.sweeps):
            return None
        begun = [a.begun for a in alone]
        with self.progress("a factor for each sweep"):
            task = TemperatureProblem.of(begun, each_its_own(self.shift), vertical=self.vertical)
            return fit_shifted(task, [b.none.law for b in begun], task.stated([b.none.z for b in begun]))

    def common_causes(self, alone: Sequence[Alone], task: TemperatureProblem, fit: ShiftedFit) -> list[Cause]:
        """What all sweeps may have in common: channels first, which ask for no other model of the plate."""
        effects = common(effects_on(self.specimen))
        with executor() as workers:
            with self.progress("a common cause in the channels") as report:
                found = causes_of(alone, task, fit, [e for e in effects if not e.spans], workers, report)
            if any(c.serves for c in found):
                return found
            spanned, task, fit = self.fitted(with_effects=True)
            with self.progress("a common cause in plate and rig") as report:
                return causes_of(spanned, task, fit, effects, workers, report)


def _band(fit: ShiftedFit, begun: Sequence[Begun]) -> LawBand:
    a = np.exp(fit.sweeps_log_shift)
    low = min(float(b.problem.sweep.frequency_hz.min() * k) for b, k in zip(begun, a, strict=True))
    high = max(float(b.problem.sweep.frequency_hz.max() * k) for b, k in zip(begun, a, strict=True))
    f: Array = np.geomspace(low, high, _BAND_POINTS)
    storage, eta = fit.law.storage_and_loss(2 * np.pi * f)
    errors = Uncertainty(fit.law_covariance, {}, 1.0).law_band(fit.law, 2 * np.pi * f)
    return LawBand(f, storage, eta, *errors)
