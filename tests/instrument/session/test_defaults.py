"""What counts where a file is silent stands in one place."""

import re
import tomllib

import pytest
from data_folder import DATA

from instrument.files.experiment_file import ExperimentDocument, SweepTable
from instrument.files.rig_file import RigDocument
from instrument.session.setup import sweep_settings
from instrument.stepped_sine.settings import SweepSettings

SEGMENT = {"low_hz": 15.0, "high_hz": 25.0, "points": 5}
GUIDE = (DATA.parent.parent / "docs" / "experiment.md").read_text(encoding="utf-8")


def test_files_that_say_nothing_are_measured_with_the_settings_as_they_are(silent_experiment, silent_rig):
    assert sweep_settings(silent_experiment, silent_rig) == SweepSettings()


@pytest.mark.parametrize("table", ["control", "settle", "dwell"])
def test_the_guide_states_the_defaults(table):
    (line,) = re.findall(rf"^ +# \[sweep\.{table}\] +(.*)$", GUIDE, re.M)
    stated = tomllib.loads(line.replace(", ", "\n"))
    assert stated == getattr(SweepTable(segments=[SEGMENT]), table).model_dump()


@pytest.fixture
def silent_rig():
    there = {"address": "10.0.0.2:502"}
    return RigDocument.model_validate(
        {
            "shaker": there,
            "vibrometer": there,
            "front_end": {"address": "http://10.0.0.2"},
            "channels": {"base": {"input": 1}, "velocity": {"input": 2}},
        }
    )


@pytest.fixture
def silent_experiment():
    return ExperimentDocument(specimen="s.toml", rig="r.toml", sweep={"segments": [SEGMENT]})
