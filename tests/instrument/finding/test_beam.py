"""Beams through the same identification, diagnosis and commands."""

import numpy as np
import pytest
from beam_cases import BEAM
from rivals import among

from fitting.structures.small_modes import small_modes, small_velocity
from fitting.sweep import Sweep, segments_by_gap
from instrument.cli.main import run
from instrument.errors import BadInput
from instrument.files.structure_file import read_structure
from instrument.finding.diagnosis import diagnose
from instrument.finding.identification import identify
from instrument.models.files import File


@pytest.fixture
def beam(tmp_path):
    (tmp_path / "beam.toml").write_text(BEAM)
    return read_structure(tmp_path / "beam.toml")


def sweep_of(beam, seed=0, factor=1.0, noise=2e-3):
    """Around three resonances."""
    modes = small_modes(beam, beam.core.law, 3)
    f = np.concatenate([np.linspace(0.8, 1.2, 40) * m.frequency_hz for m in modes])
    rng = np.random.default_rng(seed)
    scatter = 1 + noise * (rng.normal(size=len(f)) + 1j * rng.normal(size=len(f)))
    one = np.ones(len(f), dtype=np.intp)
    v = factor * small_velocity(beam, f) * scatter
    return Sweep(f, v, np.full(len(f), beam.base_acceleration_m_s2), segments_by_gap(f), one)


def test_a_sandwich_beam_gives_its_law(beam):
    found = identify([File(sweep_of(beam), beam)])
    f = found.result.band.frequency_hz
    G, eta = beam.core.law.storage_and_loss(2 * np.pi * f)
    off = (found.result.band.storage_modulus_pa - G) / found.result.band.storage_modulus_standard_error_pa
    assert np.sqrt(np.mean(off**2)) < 2
    assert np.abs(found.result.band.loss_factor / eta - 1).max() < 0.05
    assert {"substrate_young", "core_thickness", "length"} <= {one.name for one in found.result.fit.adjusted}


@among("gain_error", "added_mass", "phase_scale")
def test_a_gain_is_named_on_a_beam(beam, without):
    found = diagnose([File(sweep_of(beam, factor=1.05), beam)], without=without).result
    assert found.verdict in ("effect", "ambiguous")
    assert found.effects[0].name == "gain_error"
    assert found.effects[0].parameters["factor"].value == pytest.approx(1.05, abs=0.01)


def test_commands_take_beams(tmp_path, beam, capsys):
    path = str(tmp_path / "beam.toml")
    assert run(["modes", path, "--json", str(tmp_path / "m.json")]) == 0
    assert run(["predict", path, "--frequencies", "20:40:10"]) == 0
    free = tmp_path / "free.toml"
    free.write_text(BEAM.replace("clamped-free", "free-free"))
    assert run(["modes", str(free)]) == 0
    assert run(["predict", str(free), "--frequencies", "20"]) == 2
    assert "no base" in capsys.readouterr().err


FAULTS = {
    "boundary": (BEAM.replace("clamped-free", "hinged"), "boundary"),
    "off": (BEAM.replace("150.0", "250.0"), "pickup.x_mm = 250"),
    "no core": (BEAM.split("[core]")[0], "[core] is missing"),
}


@pytest.mark.parametrize(("text", "said"), FAULTS.values(), ids=FAULTS)
def test_a_bad_beam_is_refused_in_one_line(tmp_path, text, said):
    (tmp_path / "beam.toml").write_text(text)
    with pytest.raises(BadInput) as error:
        read_structure(tmp_path / "beam.toml")
    assert said in str(error.value)
    assert "\n" not in str(error.value)
