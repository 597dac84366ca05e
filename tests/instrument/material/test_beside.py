"""Somebody's DMA beside a law."""

import json

import numpy as np
import pytest
from batch_cases import write_specimen, write_sweeps
from paper_law import TABLE_4

from instrument.cli.main import run
from instrument.errors import BadInput
from instrument.files.dma_file import read_dma
from instrument.material.beside import beside
from instrument.material.found_law import MaterialLaw

F = np.geomspace(14.0, 300.0, 41)
NOISE = 0.01


def law(error=0.02):
    G, eta = TABLE_4.storage_and_loss(2 * np.pi * F)
    return MaterialLaw("a", "b", "none", TABLE_4.kind, {}, {}, F, G, eta, error * G, error * eta)


def write_dma(path, *, stiffer=1.0, tension=None, loss="loss_factor", seed=1, rows=12, temperatures=(20.0,)):
    rng = np.random.default_rng(seed)
    f = np.geomspace(5.0, 250.0, rows)
    G, eta = TABLE_4.storage_and_loss(2 * np.pi * f)
    lines = [] if tension is None else ["# kind: tension", f"# poisson: {tension}"]
    lines.append(f"frequency_hz,temperature_c,storage_modulus_pa,{loss}")
    for t in temperatures:
        factor = stiffer if tension is None else stiffer * 2 * (1 + tension)
        a = G * factor * np.exp(NOISE * rng.standard_normal(rows))
        b = eta * np.exp(NOISE * rng.standard_normal(rows))
        third = b if loss == "loss_factor" else a * b
        lines += [f"{x},{t},{y},{z}" for x, y, z in zip(f, a, third, strict=True)]
    path.write_text("\n".join([*lines, ""]), encoding="utf-8")
    return path


def test_tension_and_shear_are_one_material(tmp_path):
    shear = read_dma(write_dma(tmp_path / "a.csv"), 0.49)
    tension = read_dma(write_dma(tmp_path / "b.csv", tension=0.45, loss="loss_modulus_pa"), 0.49)
    np.testing.assert_allclose(tension.storage_modulus_pa, shear.storage_modulus_pa)
    np.testing.assert_allclose(tension.loss_factor, shear.loss_factor)
    assert (shear.poisson, tension.poisson) == (None, 0.45)


def test_the_same_material_agrees_and_a_stiffer_one_does_not(tmp_path):
    (same,) = beside(law(), read_dma(write_dma(tmp_path / "a.csv"), 0.49))
    assert same.noise == "scatter"
    assert same.differs is False
    (other,) = beside(law(), read_dma(write_dma(tmp_path / "b.csv", stiffer=1.2), 0.49))
    assert other.differs is True
    assert np.mean(other.storage_difference) == pytest.approx(0.2, abs=0.01)


def test_one_in_twenty_tables_differs_by_chance(tmp_path):
    p = [beside(law(), read_dma(write_dma(tmp_path / "a.csv", seed=k), 0.49))[0].p_value for k in range(200)]
    assert np.mean(np.array(p) < 0.05) <= 0.12


def test_only_rows_inside_the_band_count(tmp_path):
    (found,) = beside(law(), read_dma(write_dma(tmp_path / "a.csv"), 0.49))
    assert found.frequency_hz.min() >= F[0]
    assert len(found.frequency_hz) < 12


def test_each_temperature_stands_by_itself(tmp_path):
    table = read_dma(write_dma(tmp_path / "a.csv", temperatures=(30.0, 20.0)), 0.49)
    assert [one.temperature_c for one in beside(law(), table)] == [20.0, 30.0]


def test_few_rows_without_a_stated_error_cannot_be_told(tmp_path):
    (found,) = beside(law(), read_dma(write_dma(tmp_path / "a.csv", rows=5), 0.49))
    assert (found.noise, found.differs) == ("unknown", None)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("frequency_hz,loss_factor\n1,1\n", "storage_modulus_pa missing"),
        ("frequency_hz,storage_modulus_pa\n1,1\n", "no loss"),
        ("frequency_hz,storage_modulus_pa,loss_factor\n1,-1,1\n", "line 2: storage_modulus_pa"),
        ("# kind: torsion\nfrequency_hz,storage_modulus_pa,loss_factor\n1,1,1\n", "kind: 'torsion'"),
        ("# poisson: 0.7\nfrequency_hz,storage_modulus_pa,loss_factor\n1,1,1\n", "poisson: 0.7"),
    ],
)
def test_what_is_no_table_is_refused_in_one_line(tmp_path, text, said):
    (tmp_path / "dma.csv").write_text(text, encoding="utf-8")
    with pytest.raises(BadInput, match=said):
        read_dma(tmp_path / "dma.csv", 0.49)


def test_identify_compares_and_draws(tmp_path, capsys):
    plate = write_specimen(tmp_path)
    (sweep,) = write_sweeps(tmp_path, plate, 1, points=(25,))
    dma = write_dma(tmp_path / "dma.csv")
    command = ["identify", str(sweep), "--specimen", str(plate), "--with", str(dma)]
    assert run([*command, "--figures", str(tmp_path / "figures"), "--json", str(tmp_path / "i.json")]) == 0
    said = json.loads((tmp_path / "i.json").read_text())["with"]
    assert said["rows"] == 12
    assert said["temperatures"][0]["p_value"] is not None
    assert (tmp_path / "figures" / "with-dma.png").stat().st_size > 1000
    assert "With dma.csv" in capsys.readouterr().out
