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
from fitting.temperature.joint import ShiftedFit, fit_shifted
from fitting.temperature.shifts import Kind, Shift
from fitting.temperature.simple import Verdict, judge
from instrument.errors import BadInput
from instrument.models.set_up import set_up
from instrument.models.theory import theory_over
from instrument.progress import Progress, quiet

_BAND_POINTS = 61


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
    seconds: float

    @property
    def warnings(self) -> tuple[str, ...]:
        """What the numbers do not say."""
        said = [] if self.fit.converged else ["not converged: take the values as provisional"]
        f = [(b.problem.sweep.frequency_hz.min(), b.problem.sweep.frequency_hz.max()) for b in self.begun]
        a = np.exp(self.fit.log_shift)
        reduced = sorted((low * k, high * k) for (low, high), k in zip(f, a, strict=True))
        gaps = [one[1] < two[0] for one, two in pairwise(reduced)]
        if any(gaps):
            said.append("sweeps do not overlap in reduced frequency: there the shift rests on the law's form")
        return tuple(said)


def identify_shifted(
    sweeps: Sequence[AtTemperature],
    specimen: Specimen,
    kind: Kind,
    reference_c: float | None = None,
    progress: Progress = quiet,
    *,
    vertical: bool = False,
) -> Shifted:
    """One law and its shifts. Raises `BadInput`, `FittingError`; the verdict is left to the caller."""
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
    begun = []
    with threadpool_limits(1, "blas"), progress("each temperature by itself") as report:
        for k, one in enumerate(sweeps):
            ready = set_up(one.sweep, specimen, with_effects=False)
            found = begin(ready.problem, ready.reduced, noise_of(one.sweep), None, specimen.core.law)
            theory_over(specimen, found.none.law, one.sweep.frequency_hz)
            begun.append(found)
            report((k + 1) / len(sweeps))
    with threadpool_limits(1, "blas"), progress("one law for all"):
        fit = fit_shifted(begun, Shift(kind, T, reference), vertical=vertical)
    return Shifted(fit, judge(fit, begun), _band(fit, begun), tuple(begun), perf_counter() - began)


def _band(fit: ShiftedFit, begun: Sequence[Begun]) -> LawBand:
    a = np.exp(fit.log_shift)
    low = min(float(b.problem.sweep.frequency_hz.min() * k) for b, k in zip(begun, a, strict=True))
    high = max(float(b.problem.sweep.frequency_hz.max() * k) for b, k in zip(begun, a, strict=True))
    f: Array = np.geomspace(low, high, _BAND_POINTS)
    storage, eta = fit.law.storage_and_loss(2 * np.pi * f)
    errors = Uncertainty(fit.law_covariance, {}, 1.0).law_band(fit.law, 2 * np.pi * f)
    return LawBand(f, storage, eta, *errors)
