"""`viscorig diagnose` as a user calls it: what it reads, refuses, prints, saves."""

import json
import re
from pathlib import Path

import numpy as np
import pytest
from called import call
from data_folder import DATA
from diagnosis_cases import UNSEEN, diagnosed, diagnosis
from diagnosis_cases import sweep as some_sweep
from following_cases import BACKWARDS, SPOT
from session_cases import RATE
from uff_files import ratio_set, write_sets

import instrument.cli.diagnose as command
from instrument.cli.output import Output
from instrument.cli.reading import read_each
from instrument.facts.follow_up import FollowUp
from instrument.paper_case import case_file
from instrument.report.diagnosis import diagnosis_sections
from instrument.results.next_words import advice
from instrument.session.contents import contents_of
from instrument.session.storage import SessionFile
from instrument.stream.derived import DiagnosisFound

ZN1, TABLE5 = str(case_file("zn1.toml")), str(case_file("table5.csv"))


@pytest.fixture
def given(monkeypatch):
    """What the command hands on, in place of a diagnosis that takes its time."""
    seen = {}

    def stub(files, hammer, without, progress, accept, resamples):
        (one,) = files
        seen.update(sweep=one.sweep, specimen=one.specimen, hammer=hammer, without=without, accept=accept)
        seen.update(resamples=resamples)
        return diagnosed(some_sweep())

    monkeypatch.setattr(command, "diagnose_files", stub)
    monkeypatch.setattr(command, "diagnosis_from", lambda found: diagnosis())
    return seen


@pytest.fixture(scope="module")
def coarse(tmp_path_factory):
    """The paper's specimen on its own mesh: quick."""
    path = tmp_path_factory.mktemp("coarse") / "coarse.toml"
    path.write_text(case_file("zn1.toml").read_text() + "\n[mesh]\nelements_x = 10\nelements_y = 10\n")
    return path


@pytest.mark.long
def test_nine_amplitudes_end_to_end(capsys, coarse, tmp_path):
    status, out, err = call(
        capsys,
        *("diagnose", TABLE5, "--specimen", coarse, "--without", "core_law", "--resamples", "1"),
        *("--figures", tmp_path / "figures", "--json", tmp_path / "found.json"),
    )
    assert status == 0, err
    assert err == ""
    found = json.loads((tmp_path / "found.json").read_text())
    assert found["verdict"] in ("none", "effect", "ambiguous", "unknown")
    assert out.startswith(f"verdict: {found['verdict']}")
    assert len(found["points"]) == 9
    assert found["before"]["rms_percent"] == pytest.approx(5.2, abs=0.4)
    assert found["p_value"] in (0.5, 1.0)
    assert found["nested_held_out_rms_percent"] > 5
    assert found["before"]["held_out_rms_percent"] == found["before"]["leave_one_out_rms_percent"] > 5
    assert "core_law" not in {c["name"] for c in found["candidates"]}
    assert found["seconds"] > 0
    assert found["setup_seconds"] > 0
    assert len(list((tmp_path / "figures").glob("*.png"))) == 3


@pytest.mark.usefixtures("given")
def test_standard_output_can_be_the_json_alone(capsys):
    status, out, err = call(capsys, "diagnose", TABLE5, "--specimen", ZN1, "--json", "-")
    assert (status, err) == (0, "")
    assert json.loads(out)["verdict"] == "effect"


def test_effects_can_be_left_out(capsys, given):
    names = ("--without", "added_mass", "--without", "spot_offset")
    assert call(capsys, "diagnose", TABLE5, "--specimen", ZN1, *names)[0] == 0
    assert given["without"] == {"added_mass", "spot_offset"}


def test_what_would_tell_rivals_apart_is_listed_with_its_cost(capsys, given, monkeypatch, tmp_path):
    one = FollowUp(
        kind="spot",
        needs_hands=True,
        frequencies_hz=(20.0, 21.0),
        segments=(1, 1),
        level_g=1.0,
        spot_mm=(285.0, 24.0),
        seconds=209.0,
        separation=5.7,
        probability_resolved=0.92,
        between=("gain_error", "none"),
        why="A gain is the same at every spot.",
        todo="Point the laser at (285, 24) mm and make the same steps.",
    )
    ranked = (one, *(one.but(kind=kind) for kind in ("level", "frequencies", "clamping")))
    changed = {"next_measurements": ranked, "next_measurement": advice(one), "unseen": UNSEEN}
    monkeypatch.setattr(command, "with_open_questions", lambda result, found: result.but(**changed))
    path = tmp_path / "found.json"
    status, out, err = call(capsys, "diagnose", TABLE5, "--specimen", ZN1, "--json", path)
    assert (status, err) == (0, "")
    assert "warming 2.27 K" in out
    assert "Point the laser at (285, 24) mm" in out
    assert "level: A gain is the same at every spot. It separates gain_error and no effect." in out
    said = " ".join(out.split())
    # One advice: the sentence is the first row in words, and its reason stands there alone.
    assert "Next measurement: To tell gain_error and no effect apart, point the laser at (285, 24) mm" in said
    assert (
        "A gain is the same at every spot. It takes 3 min and, if one of these is true, settles the matter "
        "with 92 % chance."
    ) in said
    assert "spot:" not in out
    assert "92 %" in out
    assert "clamping:" not in out
    found = json.loads(path.read_text())
    assert [f["kind"] for f in found["next_measurements"]] == ["spot", "level", "frequencies", "clamping"]
    assert found["next_measurements"][0]["spot_mm"] == [285.0, 24.0]


@pytest.mark.parametrize(
    ("names", "accepted"),
    [((), None), (("added_mass", "spot_offset"), ("added_mass", "spot_offset")), (("none",), ())],
)
def test_effects_can_be_accepted_or_all_of_them_declined(capsys, given, names, accepted):
    words = [f"--accept={name}" for name in names]
    assert call(capsys, "diagnose", TABLE5, "--specimen", ZN1, *words)[0] == 0
    assert given["accept"] == accepted


@pytest.mark.parametrize(
    ("arguments", "word"),
    [
        ((TABLE5, "--specimen", ZN1, "--without", "ghosts"), "ghosts"),
        ((TABLE5, "--specimen", ZN1, "--accept", "none", "--accept", "spot_offset"), "excludes"),
        ((TABLE5,), "--specimen"),
        (("none.csv", "--specimen", ZN1), "none.csv"),
        ((TABLE5, "--specimen", ZN1, "--hammer", "x.json", "--no-hammer"), "exclude"),
        ((TABLE5, "--specimen", ZN1, "--hammer", "none.json"), "none.json"),
        ((case_file("zn1.toml"), "--specimen", ZN1), "zn1.toml"),
    ],
)
def test_bad_input_is_one_line(capsys, arguments, word):
    status, out, err = call(capsys, "diagnose", *arguments)
    assert (status, err.count("\n"), out) == (2, 1, "")
    assert word in err


def test_repeats_of_the_search_are_refused_with_several_files(capsys, coarse, tmp_path):
    other = tmp_path / "other.csv"
    other.write_text(re.sub(r"\d,(\d)\n", r"0,\1\n", Path(TABLE5).read_text()))
    words = ("diagnose", TABLE5, other, "--specimen", coarse, "--force", "--resamples", "1")
    status, _, err = call(capsys, *words)
    assert status == 2
    assert "--resamples with several files or spots, a beam or a shear pair" in err
    assert err.count("\n") == 1


def test_repeats_of_the_search_are_refused_where_nothing_is_searched_for(capsys, given):
    words = ("diagnose", TABLE5, "--specimen", ZN1, "--accept", "spot_offset", "--resamples")
    status, _, err = call(capsys, *words, "5")
    assert (status, err.count("\n")) == (2, 1)
    assert "--resamples with --accept: no search to repeat" in err
    status, _, err = call(capsys, *words, "0")
    assert status == 0, err


def test_a_sweep_keeps_its_times_and_a_hammer_test_takes_part(capsys, given, tmp_path):
    path = tmp_path / "hammer.json"
    path.write_text(json.dumps({"modes": [{"frequency_hz": 17.7, "damping_ratio": 0.003}]}))
    status, _, err = call(capsys, "diagnose", DATA / "practice-002.csv", "--specimen", ZN1, "--hammer", path)
    assert status == 0, err
    assert given["hammer"].frequency_hz.tolist() == [17.7]
    assert given["sweep"].has_phase


def test_a_session_brings_its_specimen_its_hammer_test_and_its_times(capsys, given, session_path):
    status, out, err = call(capsys, "diagnose", session_path)
    assert status == 0, err
    assert "31 points, velocity absolute, its hammer test with 8 modes" in out
    assert given["specimen"].reads == "absolute"
    assert len(given["hammer"].frequency_hz) == 8
    with SessionFile(session_path) as file:
        samples = np.array([p.sample for p in contents_of(file, with_hits=False).measured])
    np.testing.assert_allclose(given["sweep"].time_s, (samples - samples[0]) / RATE, atol=1e-9)
    assert call(capsys, "diagnose", session_path, "--no-hammer")[0] == 0
    assert given["hammer"] is None


# FRFs of the pickup over the base's acceleration

# No plate answers so: whoever reads it insists.
F = np.array([18.0, 19.0, 20.0, 21.0, 22.0, 23.0])
V_OVER_A = (3.0 - 2.0j) * 1e-3 / F


def frf_csv(path, stem, H):
    rows = "\n".join(f"{f},{h.real!r},{h.imag!r}" for f, h in zip(F.tolist(), H.tolist(), strict=True))
    path.write_text(f"frequency_hz,{stem}_re,{stem}_im\n{rows}\n")
    return path


@pytest.mark.parametrize(("stem", "power"), [("receptance", -1), ("mobility", 0), ("accelerance", 1)])
def test_an_frf_is_the_pickup_over_the_bases_acceleration(capsys, given, tmp_path, stem, power):
    path = frf_csv(tmp_path / "frf.csv", stem, V_OVER_A * (2j * np.pi * F) ** power)
    status, out, err = call(capsys, "diagnose", path, "--specimen", ZN1, "--force")
    assert status == 0, err
    assert "over the base's acceleration" in out
    np.testing.assert_allclose(given["sweep"].response_m_s, V_OVER_A * 9.81, rtol=1e-12)


def test_what_is_taken_for_granted_of_several_frfs_is_said_once(capsys, tmp_path):
    paths = [frf_csv(tmp_path / f"{k}.csv", "mobility", k * V_OVER_A) for k in (1.0, 1.01)]
    read_each(Output(None), paths, [Path(ZN1)], None, no_hammer=False, insist=True)
    assert capsys.readouterr().out.count("an FRF: taken as") == 1


def write_uff(path, under):
    """Velocity over what the code says: 12 an acceleration, 13 a force."""
    write_sets(path, ratio_set(F, V_OVER_A, 11, under))
    return path


def test_a_universal_file_says_itself_what_it_is_over(capsys, given, tmp_path):
    status, _, err = call(capsys, "diagnose", write_uff(tmp_path / "a.uff", 12), "--specimen", ZN1, "--force")
    assert status == 0, err
    np.testing.assert_allclose(given["sweep"].response_m_s, V_OVER_A * 9.81, rtol=1e-12)


def test_a_universal_file_over_a_force_is_refused(capsys, tmp_path):
    status, _, err = call(capsys, "diagnose", write_uff(tmp_path / "a.uff", 13), "--specimen", ZN1)
    assert (status, err.count("\n")) == (2, 1)
    assert "velocity over force" in err
    assert "expected" in err


# What to measure next


def test_what_is_advised_first_is_written_as_an_experiment(capsys, given, monkeypatch, tmp_path):
    ranked = (FollowUp.model_validate(SPOT),)
    monkeypatch.setattr(command, "diagnosis_from", lambda found: diagnosis().but(next_measurements=ranked))
    monkeypatch.setattr(command, "with_open_questions", lambda result, found: result)
    path = tmp_path / "next.toml"
    status, out, err = call(capsys, "diagnose", TABLE5, "--specimen", ZN1, "--next", path)
    assert status == 0, err
    assert f"[sweep] of {path}; its specimen file has to say [pickup] x_mm = 250, y_mm = 100" in out
    assert "frequencies_hz = [105.5, 104, 96.5]" in path.read_text()


def test_a_new_experiment_needs_a_specimen_to_name(capsys, given, tmp_path):
    status, _, err = call(capsys, "diagnose", tmp_path / "a.h5", "--next", tmp_path / "next.toml")
    assert status == 2
    assert "a new file, expected --specimen for it to name" in err


# The report


def test_a_session_without_a_diagnosis_has_no_section_of_it(contents):
    assert diagnosis_sections(contents) == []


def test_the_report_tells_the_recorded_diagnosis(contents):
    contents.diagnosis = DiagnosisFound(1, 9, diagnosis())
    (section,) = diagnosis_sections(contents)
    kinds = [b.kind for b in section.blocks]
    # The law before and after is drawn where the one to use is.
    assert (kinds.count("picture"), kinds.count("table")) == (2, 3)
    said = " ".join(b.text for b in section.blocks if b.kind == "sentence")
    assert "added_mass (mass 8.00 +- 0.10 g" in said
    assert "Next measurement" in said


def test_the_report_ranks_what_would_tell_the_explanations_apart(contents):
    ranked = tuple(FollowUp.model_validate(o) for o in (SPOT, BACKWARDS))
    contents.diagnosis = DiagnosisFound(1, 9, diagnosis().but(next_measurements=ranked, unseen=UNSEEN))
    (section,) = diagnosis_sections(contents)
    (hidden,) = (b for b in section.blocks if b.kind == "table" and "would not be seen" in b.title)
    assert hidden.rows[0][:4] == ("temperature_drift", "warming 2.27 K", "4", "26.9")
    (table,) = (b for b in section.blocks if b.kind == "table" and "tell the explanations apart" in b.title)
    assert [row[0] for row in table.rows] == [SPOT["todo"], BACKWARDS["todo"]]
    assert table.rows[0][1:] == ("30 s", "80 %", "55 times", "spot_offset and gain_error", SPOT["why"])
    # Where the first is made is drawn below the table.
    drawn = section.blocks[section.blocks.index(table) + 1]
    assert drawn.kind == "picture"
    assert drawn.title.endswith(SPOT["todo"])


def test_the_report_says_why_there_is_none(contents):
    contents.diagnosis = DiagnosisFound(1, 9, None, "too few points")
    (section,) = diagnosis_sections(contents)
    assert "too few points" in section.blocks[0].text
