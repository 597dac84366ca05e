"""The performance table: what the reduced model buys, measured as ratios in one run.

Everything is timed on the published plate at the default mesh, with the cache in a folder of its own.
"""

import os
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from itertools import cycle
from statistics import median
from time import perf_counter
from typing import Any

import numpy as np
from threadpoolctl import threadpool_limits

from fitting.data.noise import noise_of
from fitting.dynamics.direct import displacement_direct
from fitting.dynamics.real_modes import real_modes
from fitting.identification.direct import fit_direct
from fitting.identification.model import SweepModel
from fitting.identification.residuals import Residuals
from fitting.specimen import PlateSpecimen
from fitting.sweep import Sweep
from instrument.bench.elastic_root import elastic_root_sweep
from instrument.bench.sweeps import GRID_HZ, synthetic_sweep
from instrument.files.specimen_file import read_specimen
from instrument.files.sweep_file import read_sweep
from instrument.finding.diagnosis import Diagnosed, diagnose
from instrument.models.files import File
from instrument.models.specimen_models import Models
from instrument.paper_case import TABLE_4, case_file
from instrument.progress import Progress, quiet

TIMED_EIGENPROBLEMS = 10
PAPER_STEPS = 5
"""The paper reports five iterations, each with its response and four differences."""
RANDOM_POINTS = 30
_REPEATS = 7


@dataclass(frozen=True)
class BenchLine:
    """One line: a time, and how many times faster that is than what `to` names."""

    name: str
    seconds: float
    ratio: float | None = None
    to: str | None = None
    max_relative_error: float | None = None


def run_bench(progress: Progress = quiet) -> list[BenchLine]:
    """Time everything; two minutes or so."""
    specimen = read_specimen(case_file("zn1.toml"))
    with tempfile.TemporaryDirectory() as folder, _cache_in(folder):
        paper_sweep = _paper_sweep_seconds(specimen, progress)
        paper_fit = paper_sweep * PAPER_STEPS * (1 + len(TABLE_4.names))
        setup, models = _timed(lambda: _set_up(specimen, progress))
        # Every part of the cached set-up anew, as a second command would find it.
        cached = median(_timed(lambda: _set_up(specimen, quiet))[0] for _ in range(3))
        rational = models.rational(2 * np.pi * GRID_HZ)
        G = TABLE_4.modulus(rational.omega)
        evaluation = _median_seconds(lambda: rational.displacement(TABLE_4.modulus(rational.omega)))
        # The latest modulus is known again: another one every time.
        another = cycle((G, 1.001 * G))
        gradient = _median_seconds(lambda: rational.with_derivative(next(another)))
        direct_seconds, error, size = _against_direct(models, progress)
        sweep = synthetic_sweep(specimen)
        nine = read_sweep(case_file("table5.csv")).sweep(specimen.base_acceleration_m_s2)
        fit_nine, fit_many = (_fit_seconds(s, specimen, models) for s in (nine, sweep))
        diagnosed = _diagnoses(specimen, progress)
    whole_sweep = "the paper's sweep"
    return [
        BenchLine(
            "the paper's sweep: an eigenproblem at each of 353 frequencies (10 timed, scaled)", paper_sweep
        ),
        BenchLine(f"the paper's fit: {PAPER_STEPS} steps of 5 such sweeps", paper_fit),
        BenchLine(f"direct sparse solve, one frequency (median of {RANDOM_POINTS})", direct_seconds),
        BenchLine("set-up, cold", setup),
        BenchLine("set-up, cached", cached, setup / cached, "set-up, cold"),
        BenchLine(
            f"reduced model ({size} vectors) against direct at {RANDOM_POINTS} random points, one frequency",
            evaluation / len(GRID_HZ),
            direct_seconds * len(GRID_HZ) / evaluation,
            "direct sparse solve",
            error,
        ),
        BenchLine("one law over 353 frequencies", evaluation, paper_sweep / evaluation, whole_sweep),
        BenchLine("the same with derivatives", gradient, paper_sweep / gradient, whole_sweep),
        BenchLine("identification of 9 points", fit_nine, paper_fit / fit_nine, "the paper's fit"),
        BenchLine("identification of 353 complex points", fit_many, paper_fit / fit_many, "the paper's fit"),
        BenchLine(
            "set-up, cold, and identification together",
            setup + fit_many,
            paper_fit / (setup + fit_many),
            "the paper's fit",
        ),
        *_diagnosis_rows(diagnosed),
    ]


def _diagnoses(specimen: PlateSpecimen, progress: Progress) -> list[tuple[Sweep, Diagnosed]]:
    """An elastic root diagnosed cold, then cached at one level and at three."""
    levels = [(1.0,), (1.0,), (0.25, 0.5, 1.0)]
    sweeps = [elastic_root_sweep(specimen.base_acceleration_m_s2, level) for level in levels]
    return [(s, diagnose([File(s, specimen)], progress=progress)) for s in sweeps]


def _diagnosis_rows(diagnosed: list[tuple[Sweep, Diagnosed]]) -> list[BenchLine]:
    cold = diagnosed[0][1].setup_seconds
    rows = [BenchLine("set-up of a diagnosis, cold", cold)]
    for sweep, found in diagnosed[1:]:
        levels = len(np.unique(sweep.commanded_m_s2))
        name = f"diagnosis, the whole catalogue, {len(sweep)} points at {levels} level" + "s" * (levels > 1)
        rows.append(BenchLine(name, found.seconds))
    return rows


def _set_up(specimen: PlateSpecimen, progress: Progress) -> Models:
    models = Models.of(specimen, GRID_HZ, progress)
    models.rational(2 * np.pi * GRID_HZ)
    return models


def _paper_sweep_seconds(specimen: PlateSpecimen, progress: Progress) -> float:
    plate = Models.of(specimen, GRID_HZ).plate
    chosen = GRID_HZ[np.linspace(0, len(GRID_HZ) - 1, TIMED_EIGENPROBLEMS).astype(int)]
    seconds = []
    with progress("the paper's procedure") as report:
        for f in chosen:
            G = TABLE_4.modulus(np.array([2 * np.pi * f]))[0].real
            seconds.append(_timed(partial(real_modes, plate, float(G), 8))[0])
            report(len(seconds) / len(chosen))
    return float(np.mean(seconds)) * len(GRID_HZ)


def _against_direct(models: Models, progress: Progress) -> tuple[float, float, int]:
    """Median seconds of a direct solve, the reduced model's largest error, its size."""
    rng = np.random.default_rng(1)
    omega = 2 * np.pi * rng.uniform(5, 600, RANDOM_POINTS)
    size = np.exp(rng.uniform(np.log(1e4), np.log(2e7), RANDOM_POINTS))
    G = size * np.exp(1j * np.arctan(rng.uniform(0, 2, RANDOM_POINTS)))
    plate, damping, x, seconds = models.plate, models.damping, [], []
    with progress("direct solves") as report:
        for k in range(RANDOM_POINTS):
            one = slice(k, k + 1)
            t, found = _timed(partial(displacement_direct, plate, damping, omega[one], G[one]))
            seconds.append(t)
            x.append(found[0])
            report((k + 1) / RANDOM_POINTS)
    # The rational sum itself, not only the reduced matrices behind it.
    found = np.array([models.rational(omega).displacement(G)]).ravel()
    error = float(np.max(np.abs(found / np.array(x) - 1)))
    return median(seconds), error, len(models.reduced.M)


def _fit_seconds(sweep: Sweep, specimen: PlateSpecimen, models: Models) -> float:
    model = SweepModel.of(sweep, models.rational(np.unique(sweep.omega)), specimen.reads)
    residuals = Residuals.of(sweep, noise_of(sweep), model)
    start = specimen.core.law if specimen.core is not None else TABLE_4
    with threadpool_limits(1, "blas"):
        return _median_seconds(lambda: fit_direct(residuals, start))


def _timed(work: Callable[[], Any]) -> tuple[float, Any]:
    began = perf_counter()
    found = work()
    return perf_counter() - began, found


def _median_seconds(work: Callable[[], Any]) -> float:
    work()
    return median(_timed(work)[0] for _ in range(_REPEATS))


@contextmanager
def _cache_in(folder: str) -> Iterator[None]:
    before = os.environ.get("VISCORIG_CACHE")
    os.environ["VISCORIG_CACHE"] = folder
    try:
        yield
    finally:
        if before is None:
            del os.environ["VISCORIG_CACHE"]
        else:
            os.environ["VISCORIG_CACHE"] = before
