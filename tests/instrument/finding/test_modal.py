"""Tables of modes of plates that are 3D solids: neither matrices nor formulas of the fit's."""

import json
from dataclasses import replace

import numpy as np
import pytest
from beam_tables import BEAM, FACE, KNOWN_NEARLY, fit_modes, nearly_read, read, with_row
from mode_cases import TRUTH, read_off, solid_modes, stated
from plate_files import plate_text

from fitting.identification.doubt import doubts_among
from instrument.cli.main import run
from instrument.finding import modal
from instrument.finding.modal import identify_tables


@pytest.mark.long
@pytest.mark.parametrize("name", ["P8", "P5"])
def test_six_modes_of_a_solid_plate_give_its_law_within_the_band(name):
    # Of 15 cases (P1, P5, P8, five seeds each) 15 are within two standard errors, 12 within one.
    modes = solid_modes(name)
    for seed in (0, 3):
        rng = np.random.default_rng([seed, 7])
        found = fit_modes([read_off(modes, rng)], [stated(name, rng)])
        omega = 2 * np.pi * np.geomspace(modes[0][0], modes[0][-1], 9)
        G, eta = found.law.storage_and_loss(omega)
        G_error, eta_error = found.uncertainty.law_band(found.law, omega)
        true = TRUTH.modulus(omega)
        assert np.sqrt(np.mean(((G - true.real) / G_error) ** 2)) < 2
        assert np.sqrt(np.mean(((eta - true.imag / true.real) / eta_error) ** 2)) < 2
        # A band that covers by being useless would be no success.
        assert np.mean(G_error / G) < 0.08
        assert np.mean(eta_error / eta) < 0.06


PLATE = plate_text("cantilever", "ginf_mpa = 8.0\ntau_s = 1.0e-4\nalpha = 0.7", (12, 8))


@pytest.fixture
def table(tmp_path):
    """The plate's own modes, its file, and a table of them."""
    (tmp_path / "plate.toml").write_text(PLATE)
    assert (
        run(["modes", str(tmp_path / "plate.toml"), "--count", "6", "--json", str(tmp_path / "m.json")]) == 0
    )
    modes = json.loads((tmp_path / "m.json").read_text())["modes"]
    rows = [f"{k + 1},{m['frequency_hz']!r},{m['loss_factor']!r},23.5" for k, m in enumerate(modes)]
    (tmp_path / "modes.csv").write_text(
        "\n".join(["mode,frequency_hz,loss_factor,temperature_c", *rows]) + "\n"
    )
    return tmp_path


def test_identify_takes_a_plate_s_table_without_a_pickup(table):
    out = table / "out.json"
    words = ["identify", str(table / "modes.csv"), "--specimen", str(table / "plate.toml")]
    assert run([*words, "--json", str(out)]) == 0
    found = json.loads(out.read_text())
    assert all(m["predicted_hz"] == pytest.approx(m["frequency_hz"], rel=1e-3) for m in found["modes"])
    assert found["parameters"]["g0_pa"] == pytest.approx(0.4e6, rel=0.1)
    assert found["temperature_c"] == 23.5
    assert any("errors of the modes are not stated" in w for w in found["warnings"])
    assert {"length", "substrate_young"} <= {one["name"] for one in found["adjusted"]}


FAULTS = {
    "order": ("mode,frequency_hz,loss_factor\n1,50,0.1\n2,40,0.1\n", "mode 2 lies below an earlier one"),
    "twice": ("mode,frequency_hz,loss_factor\n1,50,0.1\n1,60,0.1\n", "mode 1 stands twice"),
}


@pytest.mark.parametrize(("text", "said"), FAULTS.values(), ids=FAULTS)
def test_a_table_out_of_order_is_refused(table, capsys, text, said):
    (table / "modes.csv").write_text(text)
    assert run(["identify", str(table / "modes.csv"), "--specimen", str(table / "plate.toml")]) == 2
    assert said in capsys.readouterr().err


def test_a_table_beside_a_sweep_is_refused(table, capsys):
    (table / "sweep.csv").write_text("frequency_hz,velocity_m_s\n10,1\n")
    files = [str(table / name) for name in ("modes.csv", "sweep.csv")]
    assert run(["identify", *files, "--specimen", str(table / "plate.toml")]) == 2
    assert "tables of modes beside other data" in capsys.readouterr().err
    assert run(["identify", files[0]]) == 2
    assert "--specimen" in capsys.readouterr().err


def test_stated_numbers_that_had_to_be_moved_too_far_are_named():
    tips = replace(BEAM, substrate=replace(FACE, thickness_m=0.8 * FACE.thickness_m))
    found = identify_tables([read(tips)], [replace(BEAM, exact=False)])
    (said,) = [one for one in found.remarks if "had to be moved" in one]
    assert "constraining_thickness by -" in said
    assert doubts_among([said])
    right = identify_tables([read(BEAM)], [replace(BEAM, exact=False)])
    assert not any("had to be moved" in one for one in right.remarks)


def test_a_row_that_the_law_bends_for_is_a_doubt_of_it():
    found = identify_tables([with_row(nearly_read(), 0, 0.94)], [KNOWN_NEARLY])
    assert found.fit.uncertainty.chi2_per_dof < 3
    (doubt, *_) = doubts_among(found.remarks)
    assert doubt.startswith("mode 1 does not go with the others")
    assert not any("does not go" in one for one in identify_tables([nearly_read()], [KNOWN_NEARLY]).remarks)


def test_where_no_row_is_the_one_it_is_a_doubt_all_the_same(monkeypatch):
    monkeypatch.setattr(modal, "misread", lambda begun: None)
    (doubt,) = doubts_among(identify_tables([with_row(nearly_read(), 0, 0.94)], [KNOWN_NEARLY]).remarks)
    assert "further together than chance has them" in doubt
