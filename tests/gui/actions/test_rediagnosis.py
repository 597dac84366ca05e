from pathlib import Path

import pytest
from diagnosis_cases import diagnosis

from gui.actions.rediagnosis import DiagnosisAsked, ShownDiagnosis, effects_of
from gui.files.pairing import PairedFile

DATA = Path("s.h5")


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        (DiagnosisAsked(DATA), ["diagnose", "s.h5"]),
        (DiagnosisAsked(DATA, accept=("a", "b")), ["diagnose", "s.h5", "--accept=a", "--accept=b"]),
        (DiagnosisAsked(DATA, accept=()), ["diagnose", "s.h5", "--accept=none"]),
        (DiagnosisAsked(DATA, decline=("a",)), ["diagnose", "s.h5", "--without=a"]),
        (DiagnosisAsked(DATA, Path("p.toml")), ["diagnose", "s.h5", "--specimen", "p.toml"]),
        (
            DiagnosisAsked(DATA, Path("p.toml"), further=(PairedFile(Path("t.csv"), Path("q.toml")),)),
            ["diagnose", "s.h5", "t.csv", "--specimen", "p.toml", "--specimen", "q.toml"],
        ),
    ],
)
def test_it_is_asked_as_on_the_command_line(asked, said):
    assert asked.arguments == said


def test_a_pair_is_two_effects():
    assert effects_of(["a + b", "b", "none"]) == ("a", "b")


def test_it_is_of_the_session_only_where_its_data_are_that_session_alone():
    found = diagnosis()
    assert ShownDiagnosis(found, "recorded").is_of(DATA)
    assert ShownDiagnosis(found, "", DiagnosisAsked(DATA)).is_of(DATA)
    for asked in (
        DiagnosisAsked(Path("other.h5")),
        DiagnosisAsked(DATA, Path("p.toml")),
        DiagnosisAsked(DATA, further=(PairedFile(Path("other.h5"), None),)),
    ):
        assert not ShownDiagnosis(found, "", asked).is_of(DATA)
