"""Cards, read back by readers of their own: what they say is the law within what they promise."""

import json
import math
import re

import card_readers as readers
import numpy as np
import pytest
from diagnosed_session import diagnosed_session
from paper_law import TABLE_4

from fitting.laws.fractional_zener import FractionalZener
from fitting.laws.prony import MOST_TERMS, fit_prony
from instrument.cards.card import Card
from instrument.cli.main import run
from instrument.errors import BadInput
from instrument.material.found_law import read_law
from instrument.paper_case import case_file

LOW, HIGH = 14.0, 300.0
F = np.geomspace(LOW, HIGH, 500)
FORMATS = ("abaqus", "ansys", "nastran", "comsol", "csv", "json")


def facts(law=TABLE_4, points=42, **more):
    f = np.geomspace(LOW, HIGH, points)
    G, eta = law.storage_and_loss(2 * np.pi * f)
    keys = ("frequency_hz", "storage_modulus_pa", "loss_factor")
    rows = [
        dict(zip(keys, row, strict=True)) for row in zip(f.tolist(), G.tolist(), eta.tolist(), strict=True)
    ]
    for row in rows:
        row["storage_modulus_standard_error_pa"] = 0.02 * row["storage_modulus_pa"]
        row["loss_factor_standard_error"] = None
    return {
        "law_kind": law.kind,
        "parameters": dict(zip(law.names, law.values.tolist(), strict=True)),
        "standard_errors": dict.fromkeys(law.names),
        "law": rows,
        **more,
    }


@pytest.fixture
def found(tmp_path):
    path = tmp_path / "identify.json"
    path.write_text(json.dumps(facts()), encoding="utf-8")
    return path


def card(found, to, *more):
    out = found.with_name(f"card.{to}")
    assert run(["card", str(found), "--to", to, "--out", str(out), *more]) == 0
    return out.read_text(encoding="utf-8")


def test_a_law_that_is_bent_says_how_far_its_formula_is_off(found):
    assert "bent" not in card(found, "csv")
    bent = facts()
    for row in bent["law"]:
        row["loss_factor"] *= 1.05
    found.write_text(json.dumps(bent), encoding="utf-8")
    eta = np.array([row["loss_factor"] for row in bent["law"]])
    off = np.max(np.abs((1 + 1j * eta / 1.05) / (1 + 1j * eta) - 1))
    assert f"bent about this formula, which is up to {100 * off:.2g} % off it" in card(found, "csv")


def promised(text, what):
    """The error that the card states, as a fraction."""
    return float(re.search(rf"{what}[^\n]*at most (\S+) %", text)[1]) / 100


def off(modulus):
    return np.max(np.abs(modulus(F) / TABLE_4.modulus(2 * np.pi * F) - 1))


def within(modulus, error):
    # Errors are printed with two digits, the law is listed at points.
    return off(modulus) <= 1.06 * error + 2e-4


def test_abaqus_reads_back(found):
    text = card(found, "abaqus")
    assert within(readers.abaqus(text), promised(text, "Prony series"))
    assert promised(text, "Prony series") <= 0.01


def test_ansys_reads_back_by_series_and_by_table(found):
    text = card(found, "ansys")
    by_series, by_table = readers.ansys(text)
    assert within(by_series, promised(text, "Prony series"))
    assert within(by_table, promised(text, "table"))


def test_nastran_reads_back(found):
    text = card(found, "nastran")
    assert within(readers.nastran(text), promised(text, "table"))


def test_comsol_reads_back_by_series_and_by_table(found):
    text = card(found, "comsol")
    by_series, by_table = readers.comsol(text)
    assert within(by_series, promised(text, "Prony series"))
    assert within(by_table, promised(text, "table"))


def test_tables_read_back(found):
    assert off(readers.plain_csv(card(found, "csv"))) < 2e-3
    text = card(found, "json")
    assert within(readers.plain_json(text), json.loads(text)["prony"]["max_error_percent"] / 100)


@pytest.mark.parametrize("to", FORMATS)
def test_every_header_says_band_temperature_specimen_verdict_and_units(found, to):
    text = card(found, to)
    for words in ("band: 14 to 300 Hz", "temperature: not known", "specimen: ", "verdict: not diagnosed"):
        assert words in text
    assert "SI: Pa, s, Hz" in text
    assert "WARNING" not in text


@pytest.mark.parametrize("to", FORMATS)
def test_a_law_after_a_diagnosis_says_what_it_reckons_with(tmp_path, to):
    path = tmp_path / "d.json"
    named = {"effects": [{"name": "gain_error"}], "equivalent": {"gain_error": ["gain_error", "none"]}}
    path.write_text(json.dumps({"verdict": "ambiguous", "after": facts(), **named}), encoding="utf-8")
    text = card(path, to)
    assert "verdict: ambiguous" in text
    assert "with: gain_error, not told from no effect" in text
    named["effects"][0]["parameters"] = {"factor": {"value": 1.03, "standard_error": 0.002, "unit": "1"}}
    doubt = {
        "warnings": ["it is nothing that the catalogue has"],
        "doubts": ["nothing that the catalogue has"],
    }
    path.write_text(json.dumps({"verdict": "ambiguous", "after": facts(), **named, **doubt}))
    text = card(path, to)
    assert "with: gain_error (factor 1.03" in text
    assert "WARNING: the fit says that this law may be biased beyond its band: nothing that" in text


@pytest.mark.parametrize("to", FORMATS)
def test_what_is_less_likely_than_no_effect_is_not_what_a_law_is_with(tmp_path, to):
    """A lone pair's mass and modulus are one: its added mass is never excluded, and of 2 %."""
    path = tmp_path / "d.json"
    named = {"effects": [{"name": "added_mass"}], "equivalent": {"added_mass": ["added_mass", "none"]}}
    weighed = [{"name": "none", "probability": 0.95}, {"name": "added_mass", "probability": 0.02}]
    of_pair = {"verdict": "ambiguous", "after": facts(), "candidates": weighed, **named}
    path.write_text(json.dumps(of_pair), encoding="utf-8")
    assert "with: no effect, not told from added_mass" in card(path, to)
    path.write_text(json.dumps({**of_pair, "by_hand": True}), encoding="utf-8")
    assert "with: added_mass, not told from no effect" in card(path, to)


@pytest.mark.parametrize("to", FORMATS)
def test_a_law_whose_verdict_is_unknown_says_so(tmp_path, to):
    path = tmp_path / "diagnose.json"
    path.write_text(json.dumps({"verdict": "unknown", "before": {}, "after": facts()}), encoding="utf-8")
    assert "WARNING: verdict unknown" in card(path, to)


def test_a_name_of_many_lines_stays_a_comment(tmp_path):
    path = tmp_path / "identify.json"
    path.write_text(json.dumps(facts() | {"law_kind": "a\n*STEP"}), encoding="utf-8")
    assert "\n*STEP" not in card(path, "abaqus")


def test_the_specimen_file_gives_poissons_ratio(found, tmp_path):
    plate = tmp_path / "plate.toml"
    plate.write_text(case_file("zn1.toml").read_text().replace("poisson = 0.49", "poisson = 0.45"))
    text = card(found, "abaqus", "--specimen", str(plate))
    assert "Poisson's ratio: 0.45 (as stated)" in text
    assert "specimen: plate.toml" in text
    assert "assumed" in card(found, "abaqus")


def test_a_pads_ratio_is_assumed_as_its_file_states_none(found, tmp_path):
    assert run(["new", "shear-pair", str(tmp_path / "pair.toml")]) == 0
    text = card(found, "abaqus", "--specimen", str(tmp_path / "pair.toml"))
    assert "Poisson's ratio: 0.49 (assumed" in text
    assert "specimen: pair.toml" in text


@pytest.mark.parametrize("key", ["result", "session_result"])
def test_a_sessions_temperature_stands_in_the_json_of_its_result(tmp_path, key):
    path = tmp_path / "run.json"
    path.write_text(json.dumps({"identify": facts(), key: {"temperature_range_c": [21.0, 23.0]}}))
    assert "temperature: 22.0 degrees C" in card(path, "csv")


def test_a_session_gives_the_law_after_its_diagnosis(tmp_path):
    path = diagnosed_session(tmp_path)
    law = read_law(path)
    assert law.verdict != "not diagnosed"
    assert law.poisson == pytest.approx(0.49)
    assert "zn1" in law.specimen


def test_a_session_whose_diagnosis_failed_gives_its_last_fit(tmp_path):
    assert read_law(diagnosed_session(tmp_path, message="too few")).verdict == "not diagnosed"


@pytest.mark.parametrize("text", ["[]", "{}", '{"law": 1}', "nonsense", "[" * 5000])
def test_what_is_no_law_is_refused_in_one_line(tmp_path, text):
    path = tmp_path / "x.json"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(BadInput, match=r"x\.json"):
        read_law(path)


@pytest.mark.parametrize("error", [-0.01, math.inf, "9" * 400])
def test_an_error_that_is_none_is_refused(tmp_path, error):
    wrong = facts()
    wrong["law"][0]["loss_factor_standard_error"] = error
    path = tmp_path / "x.json"
    path.write_text(json.dumps(wrong), encoding="utf-8")
    with pytest.raises(BadInput, match=r"x\.json"):
        read_law(path)


def test_fewer_terms_where_less_is_wanted():
    rough, fine = (fit_prony(TABLE_4.modulus, LOW, HIGH, wanted) for wanted in (0.05, 0.001))
    assert len(rough.g_pa) < len(fine.g_pa) <= MOST_TERMS
    assert rough.max_error <= 0.05
    assert fine.max_error <= 0.001
    assert np.all(fine.g_pa > 0)


def test_a_series_is_found_again():
    g, tau = np.array([2e6, 1e6]), np.array([1e-3, 1e-2])

    def modulus(omega):
        s = 1j * np.multiply.outer(omega, tau)
        return 3e5 + (s / (1 + s)) @ g

    found = fit_prony(modulus, 1.0, 1000.0, 1e-3)
    assert found.max_error < 1e-3
    assert found.g_inf_pa == pytest.approx(3e5, rel=0.05)
    assert found.g_0_pa == pytest.approx(3.3e6, rel=0.01)


SHIFT = {
    "shift": "wlf",
    "reference_c": 20.0,
    "shift_parameters": {"c1": 4.0, "c2_k": 60.0},
    "temperatures": [
        {"temperature_c": 5.0, "log10_shift": 1.3333},
        {"temperature_c": 20.0, "log10_shift": 0.0},
        {"temperature_c": 36.0, "log10_shift": -0.8421},
    ],
    "simple": True,
}


@pytest.mark.parametrize("to", FORMATS)
def test_a_law_over_temperatures_says_its_reference_its_reduced_band_and_its_shift(tmp_path, to):
    path = tmp_path / "shifted.json"
    path.write_text(json.dumps(facts(**SHIFT)), encoding="utf-8")
    text = card(path, to)
    assert "band in reduced frequency f a_T: 14 to 300 Hz" in text
    assert "temperature: 20.0 degrees C" in text
    assert "log10 a_T = -4 (T - 20) / (60 + T - 20)" in text
    assert "measured from 5 to 36 degrees C" in text
    assert "verdict: thermorheologically simple" in text
    if to == "csv":
        assert "\nreduced_frequency_hz,storage_modulus_pa," in text


@pytest.mark.parametrize("to", FORMATS)
def test_a_law_that_rests_on_a_common_cause_says_which_how_large_and_warns(tmp_path, to):
    grade = {"value": -1.4, "standard_error": 0.13, "unit": "1"}
    cause = {"common_cause": {"name": "graded_core", "parameters": {"grade_x": grade}}}
    doubted = {"warnings": ["the hours were many"], "doubts": ["the hours were many"]}
    path = tmp_path / "shifted.json"
    path.write_text(json.dumps(facts(**SHIFT, **cause, **doubted)), encoding="utf-8")
    text = card(path, to)
    assert "with: graded_core (grade_x -1.4" in text
    assert "WARNING: this law rests on an effect that all temperatures seem to have in common" in text
    assert "beyond its band: the hours were many" in text
    path.write_text(json.dumps(facts(**SHIFT, common_cause=None)), encoding="utf-8")
    assert "WARNING" not in card(path, to)


@pytest.mark.parametrize("to", ["abaqus", "ansys", "nastran", "comsol"])
def test_a_long_warning_goes_on_in_comments_of_their_own(tmp_path, to):
    words = [f"reason{k:03d}" for k in range(60)]
    path = tmp_path / "doubted.json"
    path.write_text(json.dumps(facts(warnings=[" ".join(words)], doubts=[" ".join(words)])))
    lines = card(path, to).splitlines()
    assert max(map(len, lines)) < 256
    sign = lines[0].split()[0]
    told = [line for line in lines if "reason" in line]
    assert len(told) > 2
    assert all(line.startswith(f"{sign} ") for line in told)
    assert re.findall(r"reason\d+", " ".join(told)) == words


def test_a_series_that_leaves_nothing_at_rest_says_so_in_json_too(tmp_path):
    path = tmp_path / "found.json"
    path.write_text(json.dumps(facts(law=FractionalZener(g0_pa=200.0, ginf_pa=4e9, tau_s=1e-3, alpha=0.9))))
    series = json.loads(card(path, "json"))["prony"]
    assert sum(term["share"] for term in series["terms"]) == pytest.approx(1.0, abs=1e-6)
    assert "at rest nothing is left: not for static loads" in series["words"]


def test_abaqus_shifts_by_wlf_itself_as_the_law_does(tmp_path):
    path = tmp_path / "shifted.json"
    path.write_text(json.dumps(facts(**SHIFT)), encoding="utf-8")
    lines = card(path, "abaqus").splitlines()
    reference, c1, c2 = map(float, lines[lines.index("*TRS, DEFINITION=WLF") + 1].split(","))
    for at in SHIFT["temperatures"]:
        off = at["temperature_c"] - reference
        assert -c1 * off / (c2 + off) == pytest.approx(at["log10_shift"], abs=1e-4)
    readers.abaqus("\n".join(lines))


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        ({"shift": "arrhenius", "shift_parameters": {"activation_energy_j_mol": 1.2e5}}, "ln a_T = 120000"),
        ({"shift": "free", "shift_parameters": {}}, "log10 a_T = 1.3333 at 5 degrees C, 0.0000 at 20"),
        ({"simple": None}, "WARNING: verdict unknown: it is not told whether one shifted law serves"),
    ],
)
def test_other_shifts_and_doubts_are_said_in_the_header(tmp_path, changed, said):
    path = tmp_path / "shifted.json"
    path.write_text(json.dumps(facts(**{**SHIFT, **changed})), encoding="utf-8")
    assert said in card(path, "abaqus")


def test_the_long_time_modulus_is_the_law_s_where_the_band_allows_it():
    at_rest = TABLE_4.g0_pa
    free, held = (fit_prony(TABLE_4.modulus, LOW, HIGH, 0.01, given) for given in (None, at_rest))
    assert held.g_inf_pa == at_rest
    assert max(held.max_error, free.max_error) <= 0.01
    assert np.abs(held.modulus(np.array([1e-6]))[0]) == pytest.approx(at_rest, rel=1e-6)
    # One that the band rules out is not taken.
    assert fit_prony(TABLE_4.modulus, LOW, HIGH, 0.01, 1e9).g_inf_pa == free.g_inf_pa


def test_a_fit_that_doubts_itself_says_so_in_its_card(tmp_path):
    said = "numbers moved too far: the law may be biased beyond its band; see 'viscorig diagnose'"
    (tmp_path / "a.json").write_text(json.dumps(facts(warnings=[said])), encoding="utf-8")
    law = read_law(tmp_path / "a.json")
    assert law.is_doubted
    assert any("WARNING: the fit says" in line for line in Card.of(law).header())
    (tmp_path / "b.json").write_text(json.dumps(facts(warnings=["tolerances not named"])), encoding="utf-8")
    assert not read_law(tmp_path / "b.json").is_doubted


def test_a_fit_that_has_not_come_to_its_end_says_so_in_its_card(tmp_path):
    for converged, warned in ((False, 1), (True, 0)):
        (tmp_path / "a.json").write_text(json.dumps(facts(converged=converged)), encoding="utf-8")
        header = Card.of(read_law(tmp_path / "a.json")).header()
        assert sum("WARNING: the fit has not come to its end" in line for line in header) == warned
