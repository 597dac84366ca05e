"""A campaign: cases judged in processes, stopped, gone on with, never mixed."""

import json
from dataclasses import asdict

import pytest

from campaign.run import (
    BEGUN,
    OUTCOMES,
    in_rotation,
    keep_summary,
    read_lines,
    run_campaign,
)
from instrument.errors import BadInput, StoppedByUser

KINDS = ("none", "spot_offset", "pair")
OPTIONS = {"taken_out": True}


def test_jobs_go_round_the_kinds():
    jobs = in_rotation(KINDS, 7, 1000)
    assert [j.kind for j in jobs] == [*KINDS, *KINDS, "none"]
    assert [j.seed for j in jobs] == list(range(1000, 1007))
    assert in_rotation(KINDS, 3, 1000) == jobs[:3]


def test_a_campaign_goes_on_where_it_was(tmp_path):
    jobs = in_rotation(KINDS, 5, 10)
    first = run_campaign(jobs[:2], tmp_path, asdict, OPTIONS, workers=1)
    with open(tmp_path / OUTCOMES, "a", encoding="utf-8") as file:
        file.write('{"kind": "none", "se')
    judged = (tmp_path / OUTCOMES).read_text().count("\n")
    lines = run_campaign(jobs, tmp_path, asdict, OPTIONS)
    assert lines == [asdict(job) for job in jobs]
    assert first == lines[:2]
    assert (tmp_path / OUTCOMES).read_text().count("\n") == judged + 3
    assert len(read_lines(tmp_path)) == 5


def test_a_campaign_that_was_stopped_before_its_first_case_goes_on(tmp_path):
    run_campaign([], tmp_path, asdict, OPTIONS)
    assert (tmp_path / OUTCOMES).read_bytes() == b""
    jobs = in_rotation(KINDS, 1, 10)
    assert run_campaign(jobs, tmp_path, asdict, OPTIONS, workers=1) == [asdict(jobs[0])]


def test_a_case_without_an_answer_is_tried_again(tmp_path):
    jobs = in_rotation(KINDS, 1, 10)
    run_campaign(jobs, tmp_path, asdict, OPTIONS, workers=1)
    line = {**asdict(jobs[0]), "error": "MemoryError: "}
    (tmp_path / OUTCOMES).write_text(json.dumps(line) + "\n")
    assert run_campaign(jobs, tmp_path, asdict, OPTIONS, workers=1) == [asdict(jobs[0])]


def test_two_programs_are_never_mixed(tmp_path):
    run_campaign([], tmp_path, asdict, OPTIONS)
    with pytest.raises(BadInput, match="expected a new folder"):
        run_campaign([], tmp_path, asdict, {"taken_out": False})
    (tmp_path / BEGUN).write_text(json.dumps({"taken_out": True, "sources": "older"}))
    with pytest.raises(BadInput, match="other sources"):
        run_campaign([], tmp_path, asdict, OPTIONS)


def test_a_damaged_file_is_one_line(tmp_path):
    run_campaign([], tmp_path, asdict, OPTIONS)
    (tmp_path / OUTCOMES).write_text("not json\n")
    with pytest.raises(BadInput, match="not a line of JSON"):
        run_campaign([], tmp_path, asdict, OPTIONS)


def test_ctrl_c_keeps_what_is_done(tmp_path):
    jobs = in_rotation(KINDS, 40, 10)
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
        run_campaign(jobs, tmp_path, asdict, OPTIONS, progress=lambda name: Stopping())
    kept = read_lines(tmp_path)
    assert 2 <= len(kept) <= 40
    assert run_campaign(jobs, tmp_path, asdict, OPTIONS, workers=1) == [asdict(job) for job in jobs]


def test_the_summary_is_kept_beside_the_lines(tmp_path):
    text = keep_summary("# Right: 1 of 1\n", tmp_path)
    assert (tmp_path / "summary.md").read_text() == text
