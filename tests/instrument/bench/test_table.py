"""The performance table on a plate that takes milliseconds: its ratios are those of its own times."""

import os
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from instrument.bench import elastic_root, sweeps, table
from instrument.bench.elastic_root import elastic_root_sweep
from instrument.bench.sweeps import synthetic_sweep
from instrument.bench.table import run_bench
from instrument.models.specimen_models import Models
from instrument.paper_case import TABLE_4

FEW_HZ = np.array([14.0, 20.0, 26.0, 80.0, 125.0])


class Swept:
    """Four points a level."""

    def __init__(self, levels):
        self.commanded_m_s2 = np.repeat(levels, 4)

    def __len__(self):
        return len(self.commanded_m_s2)


@pytest.fixture(scope="module")
def plate(zn1):
    return replace(zn1, elements=(5, 4))


@pytest.fixture
def quick(monkeypatch, plate):
    """Few points, few repetitions."""
    for name, value in (
        ("RANDOM_POINTS", 3),
        ("TIMED_EIGENPROBLEMS", 2),
        ("_REPEATS", 1),
    ):
        monkeypatch.setattr(table, name, value)
    for module in (elastic_root, sweeps, table):
        monkeypatch.setattr(module, "GRID_HZ", FEW_HZ)
    monkeypatch.setattr(table, "read_specimen", lambda path: plate)


def test_ratios_are_of_the_times_in_the_same_table(quick, monkeypatch, plate):
    def diagnose(files, *, progress):
        return SimpleNamespace(seconds=float(len(files[0].sweep)), setup_seconds=7.0)

    monkeypatch.setattr(table, "diagnose", diagnose)
    monkeypatch.setattr(table, "elastic_root_sweep", lambda g, levels: Swept(levels))
    before = os.environ["VISCORIG_CACHE"]
    lines = run_bench()
    assert os.environ["VISCORIG_CACHE"] == before
    seconds = {
        "direct sparse solve": lines[2].seconds,
        "set-up, cold": lines[3].seconds,
        "the paper's sweep": lines[0].seconds,
        "the paper's fit": lines[1].seconds,
    }
    assert lines[1].seconds == pytest.approx(table.PAPER_STEPS * 5 * lines[0].seconds)
    compared = [line for line in lines if line.to is not None]
    assert len(compared) == 7
    for line in compared:
        assert line.ratio == pytest.approx(seconds[line.to] / line.seconds), line.name
    (reduced,) = (line for line in lines if line.max_relative_error is not None)
    assert 0 < reduced.max_relative_error < 1e-4
    setup, one, three = lines[-3:]
    assert (setup.seconds, one.seconds, three.seconds) == (7.0, 4.0, 12.0)
    assert one.name.endswith("4 points at 1 level")
    assert three.name.endswith("12 points at 3 levels")


def test_a_synthetic_sweep_is_the_model_with_the_noise_it_states(quick, plate):
    clean, noisy = (synthetic_sweep(plate, seed, 1e-9 if seed == 0 else 0.05) for seed in (0, 1))
    models = Models.of(plate, FEW_HZ)
    np.testing.assert_allclose(clean.velocity_m_s, models.predict(TABLE_4, FEW_HZ), rtol=1e-7)
    np.testing.assert_allclose(noisy.std_m_s, 0.05 * np.abs(models.predict(TABLE_4, FEW_HZ)))
    off = np.abs(noisy.velocity_m_s / clean.velocity_m_s - 1)
    assert 0.02 < off.mean() < 0.2
    assert clean.segment.tolist() == [1, 1, 1, 2, 2]


def test_a_sweep_at_three_levels_has_every_point_at_each(quick):
    sweep = elastic_root_sweep(9.81, (0.25, 0.5, 1.0))
    levels_g = sweep.commanded_m_s2.reshape(3, len(FEW_HZ)) / 9.81
    np.testing.assert_allclose(levels_g, np.repeat([[0.25], [0.5], [1.0]], len(FEW_HZ), axis=1))
    assert sweep.sweep.tolist() == [1, 1, 1, 2, 2, 4, 4, 4, 5, 5, 7, 7, 7, 8, 8]


def test_a_cache_folder_is_put_back_as_it_was(monkeypatch):
    monkeypatch.delenv("VISCORIG_CACHE")
    with table._cache_in("/somewhere"):
        assert os.environ["VISCORIG_CACHE"] == "/somewhere"
    assert "VISCORIG_CACHE" not in os.environ
