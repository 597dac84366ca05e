"""What is said of several files, point by point."""

from dataclasses import replace

import numpy as np
from diagnosis_cases import diagnosed, sweep

from fitting.diagnosis.several.joining import joined
from fitting.identification.doubt import Doubt
from instrument.files.hammer_file import HammerModes
from instrument.files.specimen_file import read_specimen
from instrument.finding.identification import identify
from instrument.hammer_test.expected import expected_modes_hz
from instrument.models.files import File
from instrument.paper_case import case_file
from instrument.results.diagnosis_from import diagnosis_from
from instrument.results.identification_from import identification_from
from instrument.results.of_files import with_files


def test_every_point_diagnosed_tells_its_file_and_spot():
    plate, one = read_specimen(case_file("zn1.toml")), sweep()
    files = [
        File(one, plate, "", 1, 0),
        File(one, plate, "", 1, 2),
        File(one, plate, "", 2),
    ]
    whole = joined([f.sweep for f in files])
    found = diagnosis_from(diagnosed(whole, files))
    taken = len(found.points)
    assert taken == len(whole) - len(found.set_aside_hz)
    assert [p.frequency_hz for p in found.points_set_aside] == list(found.set_aside_hz)
    places = [(p.file, p.pickup, p.segment) for p in found.points_set_aside]
    assert places == [(1, 0, 2), (1, 0, 3)]
    told = [(p.file, p.pickup) for p in found.points]
    assert sorted(set(told), key=told.index) == [(1, 0), (1, 2), (2, None)]
    segment = {(1, 0): (1, 2, 3), (1, 2): (4, 5, 6), (2, None): (7, 8, 9)}
    assert all(p.segment in segment[p.file, p.pickup] for p in found.points)


def test_a_hammer_test_that_took_part_is_told_of_several_files_too(coarse):
    measured_hz = expected_modes_hz(coarse, None, 300.0)
    hammer = HammerModes(measured_hz, np.full(len(measured_hz), 2e-3), None)
    files = [File(sweep(), coarse, name, k) for k, name in enumerate(("a.csv", "b.csv"), start=1)]
    told = identification_from(identify(files, hammer=hammer)).hammer
    assert [m.measured_hz for m in told.modes] == measured_hz.tolist()
    assert abs(told.substrate_young_over_stated - 1) < 0.02
    assert identification_from(identify(files)).hammer is None


def test_doubts_are_told_among_the_remarks_and_once_more_by_themselves():
    said = ("hardly known above 300 Hz", Doubt("the law may be wrong"))
    found = diagnosed(sweep())
    found = replace(found, result=replace(found.result, warnings=said))
    result = diagnosis_from(found)
    assert (result.warnings, result.doubts) == (said, ("the law may be wrong",))
    identified = identify([File(sweep(), read_specimen(case_file("zn1.toml")))])
    again = replace(identified, result=replace(identified.result, warnings=said))
    written = identification_from(again).as_json()
    assert (written["warnings"], written["doubts"]) == (list(said), ["the law may be wrong"])


def test_a_result_of_one_plate_names_no_file():
    found = diagnosed(sweep())
    result = diagnosis_from(found)
    assert with_files(result, found.files, found.result.used, ()) is result
    assert "files" not in result.as_json()
    assert "file" not in result.as_json()["points"][0]
