"""A core law from a table: in every specimen file, in predictions, fits and sessions."""

import json
import re

import beam_cases
import numpy as np
import pytest
from paper_law import TABLE_4

import viscorig
from fitting.structures.small_modes import small_modes
from instrument.cli.main import run
from instrument.errors import BadInput
from instrument.files.specimen_file import SpecimenDocument, read_specimen_document, specimen_of
from instrument.files.structure_file import read_structure

BY_TABLE = 'kind = "table"\npath = "tables/law.csv"\n'
BEAM = re.sub(r'kind = "fractional-zener"\n(.*\n){4}', BY_TABLE, beam_cases.BEAM)
BY_FORMULA = """kind = "fractional-zener"
g0_mpa = {g0}
ginf_mpa = {ginf}
tau_s = {tau}
alpha = {alpha}
"""
FREQUENCY_HZ = np.geomspace(5, 2000, 40)


def csv_of(law, unit="storage_modulus_pa", head=""):
    G, eta = law.storage_and_loss(2 * np.pi * FREQUENCY_HZ)
    rows = zip(FREQUENCY_HZ.tolist(), G.tolist(), eta.tolist(), strict=True)
    return f"{head}frequency_hz,{unit},loss_factor\n" + "".join(f"{f!r},{g!r},{e!r}\n" for f, g, e in rows)


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "tables").mkdir()
    (tmp_path / "tables/law.csv").write_text(csv_of(TABLE_4))
    (tmp_path / "beam.toml").write_text(BEAM)
    g0, ginf, tau, alpha = TABLE_4.values
    said = BY_FORMULA.format(g0=g0 / 1e6, ginf=ginf / 1e6, tau=tau, alpha=alpha)
    (tmp_path / "formula.toml").write_text(BEAM.replace(BY_TABLE, said))
    return tmp_path


def json_of(words, tmp_path):
    out = tmp_path / f"{words[0]}.json"
    assert run([*map(str, words), "--json", str(out)]) == 0
    return json.loads(out.read_text())


def test_a_table_predicts_as_its_law_does(folder):
    by_table, by_formula = (read_structure(folder / n) for n in ("beam.toml", "formula.toml"))
    for a, b in zip(
        small_modes(by_table, by_table.core.law, 4),
        small_modes(by_formula, by_formula.core.law, 4),
        strict=True,
    ):
        assert a.frequency_hz == pytest.approx(b.frequency_hz, rel=1e-4)
        assert a.loss_factor == pytest.approx(b.loss_factor, rel=2e-3)


def test_a_prediction_outside_the_table_says_so(folder):
    beam = folder / "beam.toml"
    within = json_of(["predict", beam, "--frequencies", "20,100"], folder)
    assert within["notes"] == []
    beyond = json_of(["predict", beam, "--frequencies", "20,3000"], folder)
    assert "1 of 2 frequencies (3000 Hz) lie outside the core law's table" in beyond["notes"][0]
    assert "outside the core law's table" in json_of(["modes", beam, "--count", 8], folder)["notes"][0]


def test_a_fit_begins_at_the_table_and_says_what_it_fits(folder):
    beam = read_structure(folder / "beam.toml")
    modes = small_modes(beam, beam.core.law, 4)
    rows = "".join(f"{k + 1},{m.frequency_hz!r},{m.loss_factor!r}\n" for k, m in enumerate(modes))
    (folder / "modes.csv").write_text("mode,frequency_hz,loss_factor\n" + rows)
    found = json_of(["identify", folder / "modes.csv", "--specimen", folder / "beam.toml"], folder)
    assert found["law_kind"] == "fractional-zener"
    assert any("[core.law] is a table: fitted is a fractional-zener" in w for w in found["warnings"])


def test_a_table_of_young_s_modulus_is_converted_by_poisson_s_ratio(folder):
    class Tension:
        def storage_and_loss(self, omega):
            G, eta = TABLE_4.storage_and_loss(omega)
            return 2 * 1.49 * G, eta

    (folder / "tables/law.csv").write_text(csv_of(Tension(), head="# kind: tension\n"))
    law = read_structure(folder / "beam.toml").core.law
    omega = 2 * np.pi * FREQUENCY_HZ
    np.testing.assert_allclose(law.modulus(omega), TABLE_4.modulus(omega), rtol=1e-9)


def test_a_material_card_is_a_table(folder):
    G, eta = TABLE_4.storage_and_loss(2 * np.pi * FREQUENCY_HZ)
    rows = [
        {"frequency_hz": f, "storage_modulus_pa": g, "loss_factor": e}
        for f, g, e in zip(FREQUENCY_HZ.tolist(), G.tolist(), eta.tolist(), strict=True)
    ]
    (folder / "card.json").write_text(json.dumps({"header": ["viscorig"], "law": rows}))
    (folder / "carded.toml").write_text(BEAM.replace("tables/law.csv", "card.json"))
    assert read_structure(folder / "carded.toml").core.law == read_structure(folder / "beam.toml").core.law


def test_a_card_of_a_law_over_temperatures_is_a_table_at_its_reference(folder):
    text = (folder / "tables" / "law.csv").read_text()
    (folder / "card.csv").write_text(text.replace("frequency_hz", "reduced_frequency_hz", 1))
    (folder / "carded.toml").write_text(BEAM.replace("tables/law.csv", "card.csv"))
    assert read_structure(folder / "carded.toml").core.law == read_structure(folder / "beam.toml").core.law


PLATE = (
    BEAM.replace("[beam]", "[plate]").replace("clamped-free", "cantilever").replace("20.0\n", "100.0\n", 1)
)
PLATE = PLATE.replace("x_mm = 150.0", "x_mm = 50.0\ny_mm = 50.0")


def test_a_session_s_specimen_holds_the_rows(folder):
    (folder / "plate.toml").write_text(PLATE)
    document = read_specimen_document(folder / "plate.toml")
    kept = SpecimenDocument.model_validate_json(document.model_dump_json())
    (folder / "tables/law.csv").unlink()
    law = specimen_of(kept).core.law
    np.testing.assert_allclose(law.frequency_hz, FREQUENCY_HZ)
    assert specimen_of(kept) == specimen_of(document)


def test_a_notebook_s_specimen_holds_the_rows_too(folder):
    (folder / "plate.toml").write_text(PLATE)
    read = viscorig.load_specimen(folder / "plate.toml")
    (folder / "tables/law.csv").unlink()
    thicker = read.but(core={"thickness_mm": 0.6})
    assert thicker.model.core.law == read.model.core.law
    assert viscorig.Specimen(**read.as_dict()).model == read.model


FAULTS = {
    "missing": ("", "No such file"),
    "no column": ("frequency_hz,loss_factor\n1,0.1\n2,0.1\n", "storage_modulus_pa missing"),
    "negative": (
        "frequency_hz,storage_modulus_pa,loss_factor\n1,-5,0.1\n",
        "line 2: storage_modulus_pa = -5",
    ),
    "twice": ("frequency_hz,storage_modulus_pa,loss_factor\n1,1e6,0.1\n1,1e6,0.1\n", "1 twice"),
    "one row": ("frequency_hz,storage_modulus_pa,loss_factor\n1,1e6,0.1\n", "two or more"),
    "temperatures": (
        "frequency_hz,temperature_c,storage_modulus_pa,loss_factor\n1,20,1e6,0.1\n2,30,1e6,0.1\n",
        "2 temperatures",
    ),
    "negative loss": ("frequency_hz,storage_modulus_pa,loss_factor\n1,1e6,-1\n2,1e6,0\n", "loss_factor = -1"),
}


@pytest.mark.parametrize(("text", "said"), FAULTS.values(), ids=FAULTS)
def test_a_bad_table_is_refused_in_one_line(folder, text, said):
    path = folder / "tables/law.csv"
    path.write_text(text) if text else path.unlink()
    with pytest.raises(BadInput) as error:
        read_structure(folder / "beam.toml")
    assert "\n" not in str(error.value)
    if text:
        assert said in str(error.value)
    else:
        assert "law.csv" in str(error.value)


def test_a_table_without_a_path_is_refused(folder):
    (folder / "beam.toml").write_text(BEAM.replace('path = "tables/law.csv"\n', ""))
    with pytest.raises(BadInput, match=r"core\.law\.path"):
        read_structure(folder / "beam.toml")
