"""Cases of the published plate, diagnosed and scored."""

from types import SimpleNamespace

import numpy as np
import pytest
from click.testing import CliRunner

from campaign.__main__ import campaign
from campaign.plant import run as running
from campaign.plant.cases import KINDS, draw
from campaign.plant.outcome import Outcome, line_of, outcome_of, said_of
from campaign.plant.run import ROTATION, run_plant, write_plant_summary
from campaign.run import Job
from fitting.diagnosis.verdict.result import Diagnosis, FoundEffect, ParameterEstimate, Stage
from fitting.identification.result import LawBand
from fitting.identification.validation import HeldOutSegment, Validation
from fitting.laws.fractional_zener import FractionalZener
from instrument.errors import BadInput

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

    def diagnose(files, hammer=None, without=frozenset()):
        asked.append(without)
        return SimpleNamespace(
            result=found_diagnosis(files[0].specimen.core.law), seconds=1.0, setup_seconds=0.5
        )

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
    def diagnose(files, hammer, without):
        raise np.linalg.LinAlgError("singular\nmatrix")

    monkeypatch.setattr(running, "import_module", lambda name: SimpleNamespace(diagnose=diagnose))
    monkeypatch.setattr(running, "visible_chi2", lambda case: 7.0)
    one = outcome_of(running.judge(Job("none", 1), taken_out=False))
    assert one.said is None
    assert one.error == "LinAlgError: singular matrix"


def test_every_kind_is_in_rotation():
    assert set(ROTATION) == set(KINDS)


def test_a_campaign_with_and_one_without_a_second_diagnosis_are_never_mixed(tmp_path):
    run_plant([], tmp_path)
    with pytest.raises(BadInput, match="expected a new folder"):
        run_plant([], tmp_path, taken_out=False)


def test_the_summary_is_kept_beside_the_lines(tmp_path):
    text = write_plant_summary([line_of(UNANSWERED)], tmp_path)
    assert (tmp_path / "summary.md").read_text() == text


def test_the_command_judges_and_prints(tmp_path, monkeypatch):
    monkeypatch.setattr("campaign.__main__.run_plant", lambda jobs, out, **options: [line_of(UNANSWERED)])
    result = CliRunner().invoke(campaign, ["plant", str(tmp_path), "--count", "1", "--kind", "spot_offset"])
    assert result.exit_code == 0, result.output
    assert "MemoryError" in result.output
    assert CliRunner().invoke(campaign, ["plant", str(tmp_path), "--kind", "gremlins"]).exit_code == 2
