"""Rivals of one sweep, for what would tell them apart."""

from dataclasses import replace

import numpy as np
import pytest
from data_folder import DATA
from rig_plate import plate_of_the_rig

from fitting.data.noise import noise_of
from fitting.diagnosis.inference.begin import begin
from fitting.diagnosis.inference.usual_law import polished
from fitting.diagnosis.response.sweep_response import SweepResponse
from fitting.diagnosis.verdict.result import Rivals
from fitting.effects import CATALOGUE
from fitting.planning.rival_forecasts import RivalForecasts
from instrument.files.sweep_file import read_sweep
from instrument.models.set_up import set_up
from instrument.planning.measurable import Template
from instrument.stepped_sine.settings import SweepSettings


@pytest.fixture(scope="module")
def rivals():
    """Of a plate known within tolerances whose channel reads 3 % too much: a gain, or a shifted spot."""
    steps = read_sweep(DATA / "practice-005.csv").sweep(9.81)
    specimen = replace(plate_of_the_rig(), exact=False)
    ready = set_up(steps, specimen)
    law, problem = specimen.core.law.lifted(), ready.problem
    v = 1.03 * SweepResponse(problem, ()).velocity(law, problem.as_stated)
    std = 3e-3 * np.abs(v)
    dice = np.random.default_rng(3).standard_normal((2, len(v)))
    measured = replace(steps, velocity_m_s=v + std * (dice[0] + 1j * dice[1]), base_m_s2=None, std_m_s=std)
    problem = replace(problem, sweep=measured)
    begun = begin(problem, ready.reduced, noise_of(measured), None, law)
    fits = []
    for name, u in (("gain_error", [1.0]), ("spot_offset", [0.0, 0.0])):
        start = np.concatenate([problem.as_stated, u])
        fits.append(polished(begun.problem, [CATALOGUE[name]], begun.evidence, begun.none.law, start))
    return Rivals(begun.problem, begun.evidence, tuple((f, 0.5) for f in fits), ready.reduced)


@pytest.fixture(scope="module")
def clamps(rivals):
    """The same readings, for which a clamp is at fault: its line, or its stiffness."""
    problem, evidence = rivals.problem, rivals.evidence
    law = rivals.each[0][0].law
    fits = []
    for name, u in (("clamp_line", [1e-3, 1.0]), ("clamp_compliance", [5e13])):
        start = np.concatenate([problem.as_stated, u])
        fits.append(polished(problem, [CATALOGUE[name]], evidence, law, start))
    # Weighed lightly: neither explains a gain.
    return replace(rivals, each=tuple((f, 0.5) for f in fits), temper=1e4)


@pytest.fixture(scope="module")
def expecting(rivals):
    """What each of the rivals expects of further readings."""
    return RivalForecasts(rivals, 6)


@pytest.fixture(scope="module")
def template(expecting):
    """The steps that could be measured."""
    return Template.of(expecting, SweepSettings())
