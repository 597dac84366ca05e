"""Intervals hold the truth as often as they say, where everything unknown is drawn from its prior."""

from dataclasses import replace

import numpy as np
import pytest
from paper_law import TABLE_4
from threadpoolctl import threadpool_limits

from fitting.data.noise import noise_of
from fitting.depth.bootstrap import bootstrap
from fitting.depth.intervals import LEVELS
from fitting.depth.many import ManyResiduals
from fitting.depth.posterior import sample
from fitting.depth.profile import profile
from fitting.depth.quantities import Quantities
from fitting.depth.sweep_task import SweepTask
from fitting.diagnosis.inference.begin import begin
from fitting.diagnosis.inference.whitening import SHARE
from fitting.diagnosis.problem.model_error import model_error
from fitting.diagnosis.response.sweep_response import SweepResponse
from fitting.laws.bent_law import BentLaw
from instrument.bench.sweeps import GRID_HZ, synthetic_sweep
from instrument.models.set_up import set_up

NOISE = 0.005
AT = np.array([20.0, 100.0, 280.0])
METHODS = ("linear", "profile", "posterior", "bootstrap of points", "bootstrap of segments")


@pytest.fixture(scope="module")
def ready(coarse, mesh_is_right):
    """The published plate on a coarse mesh, with a careful laboratory's tolerances; few points."""
    sweep = synthetic_sweep(coarse).take(np.arange(0, len(GRID_HZ), 12))
    return set_up(sweep, replace(coarse, exact=False), with_effects=False)


def drawn(ready, seed):
    """A law, a bend, stated numbers, model error and noise; the fit of that sweep, and the true values."""
    rng, problem = np.random.default_rng(seed), ready.problem
    plain = TABLE_4.with_logs(np.log(TABLE_4.values) + [0.1, 0.1, 0.1, 0.03] * rng.normal(size=4))
    straight = BentLaw.over(plain, problem.sweep.frequency_hz)
    law = straight.with_values(np.concatenate([plain.values, np.exp(rng.normal(size=straight.bend_count))]))
    z = rng.normal(size=len(problem.nuisances))
    v = SweepResponse(problem.around(law), ()).velocity(law, z)
    off = model_error(problem, ready.reduced, law, v)
    white = rng.normal(size=(2, len(v))) + 1j * rng.normal(size=(2, len(v)))
    read = v + rng.normal(size=len(off)) @ off + np.array([SHARE, NOISE]) @ white * np.abs(v)
    sweep = replace(problem.sweep, velocity_m_s=read, std_m_s=NOISE * np.abs(v))
    begun = begin(replace(problem, sweep=sweep), ready.reduced, noise_of(sweep), None, TABLE_4)
    return begun, np.column_stack(law.storage_and_loss(2 * np.pi * AT)).ravel()


def inside(ready, seed, samples):
    """Whether each interval of G' and eta holds the truth. Shape (methods, levels, quantities)."""
    begun, truth = drawn(ready, seed)
    quantities = Quantities.of(SweepTask.begun_with(begun), AT)
    many = ManyResiduals(quantities.task, ready.reduced)
    looked = [
        profile(quantities, only=(-6, -3)),
        sample(quantities, many, samples, seed).intervals,
        bootstrap(quantities, many, draws=200, seed=seed),
        bootstrap(quantities, many, "segments", draws=200, seed=seed),
    ]
    every = [looked[0].linear, *(one.bounds for one in looked)]
    n = len(truth)
    found = np.array(
        [[(b[level][-n:, 0] < truth) & (truth < b[level][-n:, 1]) for level in LEVELS] for b in every], float
    )
    # What was not profiled is not outside.
    found[1][:, [1, 2, 4, 5]] = np.nan
    return found


def shares(ready, seeds, samples):
    with threadpool_limits(1, "blas"):
        return np.nanmean([inside(ready, seed, samples) for seed in range(seeds)], axis=(0, 3))


@pytest.mark.long
def test_a_few_specimens_lie_inside_about_as_often_as_said(ready):
    found = shares(ready, 16, 2_000)
    # Quantities of one specimen go together: about 40 independent looks.
    assert np.all(np.abs(found[:, 0] - 0.68) < 0.22), found
    assert np.all(found[:, 1] > 0.8), found


@pytest.mark.long
def test_200_specimens_lie_inside_as_often_as_said(ready):
    found = shares(ready, 200, 4_000)
    for name, row in zip(METHODS, found, strict=True):
        assert np.all(np.abs(row - [0.68, 0.95]) < 0.05), (name, row)
