"""What a plan's steps wait for, and what its [sweep] then asks for."""

import numpy as np
import pytest

from fitting.specimen import PlateSpecimen
from instrument.facts.plan import PlannedStep
from instrument.files.specimen_file import read_specimen
from instrument.paper_case import case_file
from instrument.planning.costs import as_run, settle_seconds, step_seconds
from instrument.planning.result import sweep_toml
from instrument.planning.waits import settling_forecast
from instrument.planning.wish import patient
from instrument.stepped_sine.settings import SweepSettings

F = np.array([20.0, 22.0, 100.0])


def poles(loss):
    return np.array([22.0, 100.0]) * (1 + 0.5j * loss)


def test_a_damped_plate_needs_no_more_than_the_usual_patience():
    assert settling_forecast(F, poles(0.3), patient()) is None


def test_a_plan_reckons_with_all_the_time_that_settling_takes_and_asks_for_it():
    found = settling_forecast(F, poles(0.006), patient())
    assert found is not None
    assert (found.steps, found.usual_s, found.never) == (3, 8.0, 0)
    assert found.longest_s == pytest.approx(settle_seconds(F, poles(0.006), patient()).max())
    assert 8.0 < found.longest_s < found.most_s
    assert found.left_percent > 0.1
    assert np.all(step_seconds(F, poles(0.006), patient()) > step_seconds(F, poles(0.006), SweepSettings()))
    step = PlannedStep(frequency_hz=20.5, segment=1, seconds=1.0, teaches="law")
    assert sweep_toml((step,), 0.5, found).endswith(f"\n[sweep.settle]\nmost_s = {found.most_s:g}\n")


def test_what_no_file_may_wait_for_is_counted():
    found = settling_forecast(F, poles(1e-5), patient())
    assert found is not None
    assert (found.most_s, found.never) == (300.0, 3)


def test_a_plate_of_which_no_damping_is_stated_rings_as_the_run_takes_it():
    stated = read_specimen(case_file("zn1.toml"))
    assert isinstance(stated, PlateSpecimen)
    assert as_run(poles(0.01), stated) == pytest.approx(poles(0.01))
    unknown = stated.__class__(**{**vars(stated), "modal_ratios": ()})
    assert as_run(poles(0.01), unknown).imag == pytest.approx(poles(0.012).imag)
