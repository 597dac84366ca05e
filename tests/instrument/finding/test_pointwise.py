"""The law band by band beside the one that was fitted, on the same plate."""

import json
from dataclasses import replace

import numpy as np
import pytest
from data_folder import DATA

from fitting.errors import OutsideModel, TooFewPoints
from instrument.cli.main import run
from instrument.files.specimen_file import read_specimen
from instrument.files.sweep_file import read_sweep
from instrument.finding.identification import identify
from instrument.finding.pointwise import pointwise_of
from instrument.models.files import File
from instrument.paper_case import case_file

ZN1 = str(case_file("zn1.toml"))


@pytest.fixture(scope="module", params=[True, False], ids=["exact", "tolerances"])
def found(request):
    """A clean sweep of a solid plate: identified, and band by band."""
    specimen = replace(read_specimen(case_file("zn1.toml")), exact=request.param)
    sweep = read_sweep(DATA / "practice-002.csv").sweep(9.81)
    identified = identify([File(sweep, specimen)])
    return identified, pointwise_of(identified)


def test_it_agrees_with_the_law(found):
    identified, bands = found
    known = bands.law.known(0.1)
    G = identified.joint.begun.none.law.modulus(2 * np.pi * known.frequency_hz)
    assert len(known) > 30
    off = (known.storage_modulus_pa - G.real) / known.storage_modulus_standard_error_pa
    eta = (known.loss_factor - G.imag / G.real) / known.loss_factor_standard_error
    assert np.sqrt(np.mean(np.square([off, eta]))) < 1.3
    assert np.abs([off, eta]).max() < 4
    near = (known.frequency_hz > 90) & (known.frequency_hz < 110)
    np.testing.assert_allclose(known.storage_modulus_pa[near], G.real[near], rtol=0.01)


def test_one_causal_core_explains_it(found):
    _, bands = found
    assert bands.causal.consistent
    assert bands.causal.p_value > 0.01
    assert "one causal, relaxing core" in bands.words


def test_what_tolerances_leave_open_is_common_to_all_bands(found):
    identified, bands = found
    count = len(bands.law.common)
    # One cause of all; two segments with one resonance; the third has two, and what lies beyond them.
    by_model = 1 + 6 + 6 + (3 * 3 + 5)
    assert count == by_model + identified.joint.begun.none.stated


def test_amplitudes_are_refused(zn1):
    sweep = read_sweep(case_file("table5.csv")).sweep(9.81)
    with pytest.raises(TooFewPoints, match="9 amplitudes without phase, expected phasors"):
        pointwise_of(identify([File(sweep, zn1)]))


def test_the_paper_s_method_has_none(found, zn1):
    identified, _ = found
    with pytest.raises(OutsideModel, match="expected the direct one"):
        pointwise_of(replace(identified, joint=None))


def test_the_command_adds_it(capsys, tmp_path):
    data, out = str(DATA / "practice-002.csv"), tmp_path / "found.json"
    asked = [
        "identify",
        data,
        "--specimen",
        ZN1,
        "--pointwise",
        "--figures",
        str(tmp_path),
        "--json",
        str(out),
    ]
    assert run(asked) == 0
    facts = json.loads(out.read_text())
    assert facts["kramers_kronig"]["consistent"]
    assert sum(band["determined"] for band in facts["pointwise"]) > 30
    assert (tmp_path / "pointwise-law.png").stat().st_size > 10_000
    assert "band by band, without a law" in capsys.readouterr().out


def test_the_command_refuses_amplitudes_before_the_work(capsys):
    status = run(["identify", str(case_file("table5.csv")), "--specimen", ZN1, "--pointwise"])
    said = capsys.readouterr()
    assert status == 2
    assert said.err.count("\n") == 1
    assert "amplitudes without phase" in said.err


@pytest.mark.parametrize("more", [["--pointwise", "--method", "paper"], ["--figures", "here"]])
def test_options_that_exclude_each_other(capsys, more):
    assert run(["identify", str(DATA / "practice-002.csv"), "--specimen", ZN1, *more]) == 2
    assert "expected" in capsys.readouterr().err
