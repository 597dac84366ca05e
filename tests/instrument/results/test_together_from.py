"""What is said of several files, point by point."""

from diagnosis_cases import diagnosed, sweep

from fitting.diagnosis.joining import joined
from instrument.files.specimen_file import read_specimen
from instrument.models.files import File
from instrument.models.together import DiagnosedTogether
from instrument.paper_case import case_file
from instrument.results.together_from import diagnosed_together_from


def test_every_point_diagnosed_tells_its_file_and_spot():
    plate, one = read_specimen(case_file("zn1.toml")), sweep()
    files = [
        File(one, plate, "", 1, 0),
        File(one, plate, "", 1, 2),
        File(one, plate, "", 2),
    ]
    whole = joined([f.sweep for f in files])
    found = diagnosed_together_from(DiagnosedTogether(diagnosed(whole), whole), files)
    taken = len(found.points)
    assert taken == len(whole) - len(found.set_aside_hz)
    assert [p.frequency_hz for p in found.points_set_aside] == list(found.set_aside_hz)
    places = [(p.file, p.pickup, p.segment) for p in found.points_set_aside]
    assert places == [(1, 0, 2), (1, 0, 3)]
    told = [(p.file, p.pickup) for p in found.points]
    assert sorted(set(told), key=told.index) == [(1, 0), (1, 2), (2, None)]
    segment = {(1, 0): (1, 2, 3), (1, 2): (4, 5, 6), (2, None): (7, 8, 9)}
    assert all(p.segment in segment[p.file, p.pickup] for p in found.points)
