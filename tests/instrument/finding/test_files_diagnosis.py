"""What a diagnosis looks for in files under one law."""

from types import SimpleNamespace as Like

import pytest
from shear_pair_cases import pair, sweep

from fitting.diagnosis.diagnose import DiagnosisOptions
from fitting.effects import CATALOGUE
from fitting.errors import OutsideModel
from instrument.finding.effect_names import effects_among
from instrument.finding.exchanged import exchanged
from instrument.finding.files_diagnosis import FilesDiagnosis
from instrument.models.files import File
from instrument.progress import quiet

FILES = [File(sweep(pair(m), points=30), pair(m), name) for m, name in ((0.2533, "a.csv"), (0.573, "b.csv"))]


def diagnosis_of(files, *, searches=True):
    return FilesDiagnosis(files, effects_among([f.specimen for f in files]), None, quiet, searches=searches)


def test_an_effect_of_several_files_may_be_in_all_of_them_or_in_one():
    alone, beside = diagnosis_of(FILES[:1]), diagnosis_of(FILES)
    names = [e.name for e in alone.effects]
    assert [e.name for e in beside.effects] == names
    gain = names.index("gain_error")
    assert alone.effects[gain] == CATALOGUE["gain_error"].form_on([FILES[0].specimen])
    assert len(beside.effects[gain].variants()) == 3


def test_exchanged_specimens_are_refused_where_a_cause_is_searched_for():
    masses = (0.2533, 0.573, 1.196)
    turned = [
        File(sweep(pair(m), points=60), pair(other)) for m, other in zip(masses, masses[::-1], strict=True)
    ]
    assert exchanged(turned) is not None
    with pytest.raises(OutsideModel):
        diagnosis_of(turned).traced(lambda *_: None, DiagnosisOptions())
    way = diagnosis_of(turned, searches=False)
    way.set_up(quiet)
    accepted = DiagnosisOptions(accepted_by_hand=["gain_error"])
    handed = way.traced(lambda _, seen, options: Like(verdict="none", seen=seen, options=options), accepted)
    assert len(handed.seen.why_aside) == len(way.given)
    assert handed.options.accepted_by_hand == ["gain_error"]
    assert handed.options.settle is not None


def test_whether_a_common_cause_widens_the_band_is_asked_with_how_many_files_there_are(monkeypatch):
    monkeypatch.setattr(
        "instrument.finding.files_diagnosis.remarks_on_common_causes", lambda _, files: (f"wide in {files}",)
    )
    found = Like(before=Like(rms_percent=1.0))
    assert f"wide in {len(FILES)}" in diagnosis_of(FILES).remarks(found, ())
    assert "wide in 1" in diagnosis_of(FILES[:1]).remarks(found, ())
