"""A campaign: cases judged in processes, stopped, gone on with, never mixed."""

import json
from dataclasses import asdict
from types import SimpleNamespace

import numpy as np
import pytest
from click.testing import CliRunner

from fitting.diagnosis.verdict.result import Diagnosis, FoundEffect, ParameterEstimate, Stage
from fitting.identification.result import LawBand
from fitting.identification.validation import HeldOutSegment, Validation
from fitting.laws.fractional_zener import FractionalZener
from instrument.campaign import run as running
from instrument.campaign.cases import KINDS, draw
from instrument.campaign.outcome import Outcome, line_of, outcome_of, said_of
from instrument.campaign.run import (
    BEGUN,
    OUTCOMES,
    ROTATION,
    Job,
    jobs_of,
    read_lines,
    run_campaign,
    write_summary,
)
from instrument.cli.campaign import campaign
from instrument.errors import BadInput, StoppedByUser

UNANSWERED = Outcome("spot_offset", 1, ("spot_offset",), False, 1, 900.0, None, None, "MemoryError: ")


def found_diagnosis(law):
    nothing = np.zeros(0)
    segments = tuple(HeldOutSegment(k, rms, 1.0) for k, rms in ((1, 2.0), (2, 30.0), (3, 4.0)))
    band = LawBand(*(nothing,) * 5)
    stage = Stage(law, {}, band, nothing + 0j, nothing, nothing, 1.2, Validation(held_out=segments), ())
    effect = FoundEffect("gain_error", {"gain": ParameterEstimate(1.02, 0.001, "1")})
    groups = {"gain_error": ("gain_error", "spot_offset")}
    return Diagnosis("ambiguous", (effect,), (), groups, (), stage, stage, "", (), np.ones(0, dtype=bool), ())


def test_facts_are_taken_from_a_diagnosis():
    case = draw("gain_error", 1)
    facts = said_of(case, found_diagnosis(FractionalZener(*case.truth.law.values)), 3.0, 1.0)
    assert (facts.verdict, facts.group) == ("ambiguous", ("gain_error", "spot_offset"))
    assert facts.after.held_out_percent == 4.0
    assert facts.after.storage_error_percent == pytest.approx((0, 0, 0))


@pytest.fixture
def diagnosis(monkeypatch):
    """A diagnosis that always gives the same answer, and what it was asked."""
    asked = []

    def diagnose(sweep, specimen, hammer=None, without=frozenset()):
        asked.append(without)
        return SimpleNamespace(result=found_diagnosis(specimen.core.law), seconds=1.0, setup_seconds=0.5)

    monkeypatch.setattr(running, "import_module", lambda name: SimpleNamespace(diagnose=diagnose))
    monkeypatch.setattr(running, "visible_chi2", lambda case: 7.0)
    return asked


def test_a_single_effect_is_diagnosed_again_without_it(diagnosis):
    line = running.judge(Job("gain_error", 1), taken_out=True)
    assert diagnosis == [frozenset(), frozenset({"gain_error"})]
    one = outcome_of(line)
    assert (one.kind, one.seed, one.truth) == ("gain_error", 1, ("gain_error",))
    assert one.without.verdict == "ambiguous"
    diagnosis.clear()
    running.judge(Job("none", 1), taken_out=True)
    assert diagnosis == [frozenset()]


def test_a_diagnosis_that_raises_is_an_outcome_without_an_answer(monkeypatch):
    def diagnose(sweep, specimen, hammer, without):
        raise np.linalg.LinAlgError("singular\nmatrix")

    monkeypatch.setattr(running, "import_module", lambda name: SimpleNamespace(diagnose=diagnose))
    monkeypatch.setattr(running, "visible_chi2", lambda case: 7.0)
    one = outcome_of(running.judge(Job("none", 1), taken_out=False))
    assert one.said is None
    assert one.error == "LinAlgError: singular matrix"


def test_jobs_go_round_the_kinds():
    jobs = jobs_of(2 * len(ROTATION), 1000)
    assert {j.kind for j in jobs} == set(KINDS)
    assert len({j.seed for j in jobs}) == len(jobs)
    assert {j.kind for j in jobs_of(5, 0, ("pair",))} == {"pair"}
    assert jobs_of(3, 1000) == jobs[:3]


def test_a_campaign_goes_on_where_it_was(tmp_path):
    jobs = jobs_of(5, 10)
    first = run_campaign(jobs[:2], tmp_path, judged_by=asdict, workers=1)
    with open(tmp_path / OUTCOMES, "a", encoding="utf-8") as file:
        file.write('{"kind": "none", "se')
    judged = (tmp_path / OUTCOMES).read_text().count("\n")
    lines = run_campaign(jobs, tmp_path, judged_by=asdict)
    assert lines == [asdict(job) for job in jobs]
    assert first == lines[:2]
    assert (tmp_path / OUTCOMES).read_text().count("\n") == judged + 3
    assert len(read_lines(tmp_path)) == 5


def test_a_campaign_that_was_stopped_before_its_first_case_goes_on(tmp_path):
    run_campaign([], tmp_path, judged_by=asdict)
    assert (tmp_path / OUTCOMES).read_bytes() == b""
    jobs = jobs_of(1, 10)
    assert run_campaign(jobs, tmp_path, judged_by=asdict, workers=1) == [asdict(jobs[0])]


def test_a_case_without_an_answer_is_tried_again(tmp_path):
    jobs = jobs_of(1, 10)
    run_campaign(jobs, tmp_path, judged_by=asdict, workers=1)
    line = {**asdict(jobs[0]), "error": "MemoryError: "}
    (tmp_path / OUTCOMES).write_text(json.dumps(line) + "\n")
    assert run_campaign(jobs, tmp_path, judged_by=asdict, workers=1) == [asdict(jobs[0])]


def test_two_programs_are_never_mixed(tmp_path):
    run_campaign([], tmp_path, judged_by=asdict)
    with pytest.raises(BadInput, match="expected a new folder"):
        run_campaign([], tmp_path, taken_out=False, judged_by=asdict)
    (tmp_path / BEGUN).write_text(json.dumps({"taken_out": True, "sources": "older"}))
    with pytest.raises(BadInput, match="other sources"):
        run_campaign([], tmp_path, judged_by=asdict)


def test_a_damaged_file_is_one_line(tmp_path):
    run_campaign([], tmp_path, judged_by=asdict)
    (tmp_path / OUTCOMES).write_text("not json\n")
    with pytest.raises(BadInput, match="not a line of JSON"):
        run_campaign([], tmp_path, judged_by=asdict)


def test_ctrl_c_keeps_what_is_done(tmp_path):
    jobs = jobs_of(40, 10)
    told = []

    class Stopping:
        def __enter__(self):
            return self.report

        def __exit__(self, *raised):
            return None

        def report(self, fraction):
            told.append(fraction)
            if len(told) == 3:
                raise KeyboardInterrupt

    with pytest.raises(StoppedByUser, match=r"of 40 cases done.*goes on"):
        run_campaign(jobs, tmp_path, judged_by=asdict, progress=lambda name: Stopping())
    kept = read_lines(tmp_path)
    assert 2 <= len(kept) <= 40
    assert run_campaign(jobs, tmp_path, judged_by=asdict, workers=1) == [asdict(job) for job in jobs]


def test_the_summary_is_kept_beside_the_lines(tmp_path):
    text = write_summary([line_of(UNANSWERED)], tmp_path)
    assert (tmp_path / "summary.md").read_text() == text


def test_the_command_judges_and_prints(tmp_path, monkeypatch):
    monkeypatch.setattr(
        "instrument.cli.campaign.run_campaign", lambda jobs, out, **options: [line_of(UNANSWERED)]
    )
    result = CliRunner().invoke(campaign, ["plant", str(tmp_path), "--count", "1", "--kind", "spot_offset"])
    assert result.exit_code == 0, result.output
    assert "MemoryError" in result.output
    assert CliRunner().invoke(campaign, ["plant", str(tmp_path), "--kind", "gremlins"]).exit_code == 2
