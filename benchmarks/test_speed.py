"""How long the heart of the program takes, with a history: `make benchmark` compares with the runs before.

Seconds of one machine. What must hold on every machine is a ratio: that stands in `viscorig bench`.
"""

import numpy as np
import pytest
from threadpoolctl import threadpool_limits

from fitting.dynamics.direct import displacement_direct
from instrument.bench.sweeps import GRID_HZ, synthetic_sweep
from instrument.files.specimen_file import read_specimen
from instrument.finding.diagnosis import diagnose
from instrument.finding.identification import identify
from instrument.models.files import File
from instrument.models.specimen_models import Models
from instrument.paper_case import TABLE_4, case_file
from instrument.stream.event import from_line, to_line
from instrument.stream.raw import ShakerCommanded

OMEGA = 2 * np.pi * GRID_HZ
EVENT = ShakerCommanded(sequence=7, frequency_hz=20.3, drive_v=0.4, ramp_s=0.5, sample=81920)


@pytest.fixture(scope="module", autouse=True)
def one_thread():
    with threadpool_limits(1, "blas"):
        yield


@pytest.fixture(scope="module")
def specimen():
    return read_specimen(case_file("zn1.toml"))


@pytest.fixture(scope="module")
def models(specimen):
    return Models.of(specimen, GRID_HZ)


@pytest.fixture(scope="module")
def sweep(specimen):
    return synthetic_sweep(specimen)


def test_one_law_at_353_points(benchmark, models):
    rational, G = models.rational(OMEGA), TABLE_4.modulus(OMEGA)
    benchmark(rational.displacement, G)


def test_one_point_in_full(benchmark, models):
    G = TABLE_4.modulus(OMEGA[:1])
    benchmark(displacement_direct, models.plate, models.damping, OMEGA[:1], G)


def test_an_identification_set_up(benchmark, sweep, specimen):
    identify([File(sweep, specimen)])
    benchmark(identify, sweep, specimen)


def test_a_clean_sweep_diagnosed(benchmark, sweep, specimen):
    diagnose([File(sweep, specimen)])
    benchmark.pedantic(diagnose, (sweep, specimen), rounds=3)


def test_an_event_written_and_read(benchmark):
    assert benchmark(lambda: from_line(to_line(EVENT))) == EVENT
