"""One law and one verdict of a session, whoever says it: the same numbers, as printed."""

import json
from dataclasses import replace

import pytest
from diagnosed_session import diagnosed_session
from diagnosis_cases import diagnosis
from session_cases import whole_session
from sessions import contents_in, point

import viscorig as vr
from instrument.cli.main import run
from instrument.results.diagnosis_words import verdict_line
from instrument.results.session_result import Conditions, recorded_result, result_of
from instrument.session.points import sweep_of
from instrument.stream.raw import SessionEnded

UNKNOWN = diagnosis(verdict="unknown").but(effects=(), equivalent={})
NOTHING = diagnosis(verdict="none").but(effects=(), equivalent={})
AMBIGUOUS = diagnosis(verdict="ambiguous")
DIAGNOSES = {"effect": diagnosis(), "ambiguous": AMBIGUOUS, "unknown": UNKNOWN, "none": NOTHING}


@pytest.fixture(params=DIAGNOSES)
def diagnosed(request, tmp_path):
    """A session with that verdict, and what is recorded as its diagnosis."""
    found = DIAGNOSES[request.param]
    return diagnosed_session(tmp_path, diagnosis=found), found


def said_by(capsys, *arguments):
    """Standard output of a command."""
    assert run([str(a) for a in arguments]) == 0
    return capsys.readouterr().out


def facts_by(capsys, *arguments):
    return json.loads(said_by(capsys, *arguments, "--json", "-"))


def result_lines(text):
    return [line.removeprefix("result: ") for line in text.splitlines() if line.startswith("result: ")]


def verdicts(text):
    """Every verdict that is said."""
    return [part.split(";")[0].split("\n")[0] for part in text.split("verdict: ")[1:]]


def test_every_command_says_the_same_law_and_verdict(capsys, diagnosed, tmp_path):
    session, found = diagnosed
    words = recorded_result(contents_in(session)).words
    assert verdict_line(found) in words
    exported = said_by(capsys, "export", session, "--to", "csv", "--out", tmp_path / "csv")
    identified = said_by(capsys, "identify", session)
    for text in (exported, identified):
        assert result_lines(text) == [words]
        assert set(verdicts(text)) == set(verdicts(words))
    assert "before the diagnosis" in identified
    (written,) = (tmp_path / "csv").glob("*-result.json")
    assert json.loads(written.read_text())["words"] == words
    assert vr.load_session(session).lines()[-1] == f"result: {words}"
    assert vr.load_session(session).as_dict()["result"]["words"] == words
    in_json = facts_by(capsys, "identify", session)["session_result"]
    assert (in_json["words"], in_json["verdict"]) == (words, found.verdict)


def test_card_and_batch_take_the_law_after_the_diagnosis(capsys, diagnosed, tmp_path):
    session, found = diagnosed
    after = next(row for row in found.after.law if row.frequency_hz == 100.0)
    card = said_by(capsys, "card", session, "--to", "csv", "--out", "-")
    assert f"# verdict: {found.verdict}" in card.splitlines()
    rows = [line.split(",") for line in card.splitlines() if line.startswith("100.0,")]
    assert float(rows[0][1]) == after.storage_modulus_pa
    said_by(capsys, "batch", session, "--workers", "1", "--out", tmp_path / "batch")
    head, row = ((tmp_path / "batch" / "batch.csv").read_text().splitlines())[:2]
    cells = dict(zip(head.split(","), row.split(","), strict=False))
    assert cells["verdict"] == found.verdict
    assert float(cells["rms_percent"]) == found.after.rms_percent


def test_the_numbers_are_those_after_the_diagnosis_not_before():
    found = diagnosis()
    result = result_of(None, found, Conditions.of_diagnosis(found))
    assert result.law == tuple(r for r in found.after.law if r.frequency_hz in (20.0, 100.0, 280.0))
    assert result.rms_percent == found.after.rms_percent != found.before.rms_percent
    used = [p.frequency_hz for p in found.points]
    assert (result.low_hz, result.high_hz) == (min(used), max(used))
    assert result.low_level_m_s2 == result.high_level_m_s2 == 9.81
    assert "valid 18 to 293.3 Hz, at 9.81 m/s^2 (1 g), temperature not known" in result.words


def test_a_replay_ends_with_the_result(capsys, tmp_path):
    session = whole_session(tmp_path)
    words = recorded_result(contents_in(session)).words
    assert result_lines(said_by(capsys, "replay", session)) == [words]
    assert facts_by(capsys, "replay", session)["result"]["words"] == words


def test_a_law_of_one_s_own_word_says_so():
    found = diagnosis().but(by_hand=True)
    result = result_of(None, found, Conditions.of_diagnosis(found))
    assert result.standing == "by hand"
    assert "verdict: by your word: added_mass" in result.words


def test_a_law_that_nothing_explains_is_not_sold_as_known():
    result = result_of(None, UNKNOWN, Conditions.of_diagnosis(UNKNOWN))
    assert "may be far off its band" in result.words


def test_without_a_diagnosis_the_fit_says_it_was_not_diagnosed(capsys, tmp_path):
    session = whole_session(tmp_path)
    result = recorded_result(contents_in(session))
    assert (result.standing, result.verdict) == ("not diagnosed", None)
    assert result.words.endswith("not diagnosed")
    identified = said_by(capsys, "identify", session)
    assert "before the diagnosis" not in identified
    assert result_lines(identified) == []
    assert result_lines(said_by(capsys, "export", session, "--to", "mat", "--out", tmp_path)) == [
        result.words
    ]


def test_why_there_is_no_diagnosis_is_part_of_the_result(tmp_path):
    session = diagnosed_session(tmp_path, message="the fit failed")
    words = recorded_result(contents_in(session)).words
    assert words.endswith(
        "not diagnosed: the fit failed; the law may be biased beyond its band: see the notes"
    )


def test_temperature_and_level_are_those_of_the_points():
    found = diagnosis()
    result = result_of(None, found, Conditions(30, (4.903325, 9.80665), (21.0, 23.5)))
    assert "at 4.903 to 9.807 m/s^2 (0.5 to 1 g), 21 to 23.5 degC" in result.words
    assert result.temperature_range_c == (21.0, 23.5)


@pytest.mark.parametrize(
    ("ended", "happened"),
    [
        (None, "the run was killed after 31 points"),
        (SessionEnded("stopped by the user", ""), "the run was stopped by the user after 31 points"),
        (SessionEnded("stopped safely", "too hot"), "the run was stopped safely (too hot) after 31 points"),
    ],
)
def test_a_run_that_ended_early_says_so_and_how_to_go_on(tmp_path, ended, happened):
    early = contents_in(whole_session(tmp_path))
    early.fit, early.ended = None, ended
    result = recorded_result(early)
    assert result.standing == "no law"
    assert happened in result.words
    assert f"--resume {early.configuration.name}.running" in result.words
    assert f"viscorig identify {early.path.name}" in result.words


def test_a_law_of_a_part_of_a_run_says_that_the_run_ended_early(tmp_path):
    early = contents_in(whole_session(tmp_path))
    early.ended = SessionEnded("stopped by the user", "")
    assert "not diagnosed: the run was stopped by the user after 31 points" in recorded_result(early).words


def test_a_sweep_that_ended_early_goes_on_as_a_sweep(tmp_path):
    early = contents_in(whole_session(tmp_path))
    early.fit, early.ended = None, None
    assert "to go on: viscorig run EXPERIMENT.toml" in recorded_result(early).words
    early.damping = None
    assert "to go on: viscorig sweep EXPERIMENT.toml" in recorded_result(early).words


def test_the_result_states_the_level_reached_where_the_drives_limit_kept_the_base_under_its_own():
    remarks = ("drive held at its limit of 5 V", "level -16 % off, limit 1 %")
    held = [
        point(k, 20.0 + k, level_m_s2=39.24, base_accel_re_m_s2=base, base_accel_im_m_s2=0.0, remarks=remarks)
        for k, base in enumerate((33.0, 35.4))
    ]
    free = replace(held[0], level_m_s2=33.5, remarks=())
    found = result_of(None, NOTHING, Conditions.of_points([*held, free]))
    assert (
        "at 33 to 35.4 m/s^2 (3.37 to 3.61 g), the drive's limit kept the base up to 16 % under"
        in found.words
    )
    assert (found.low_level_m_s2, found.high_level_m_s2) == (33.0, 35.4)
    swept = Conditions.of_sweep(sweep_of(held))
    assert swept == Conditions.of_points(held)
    assert "limit" not in result_of(None, NOTHING, Conditions.of_points([free])).words
