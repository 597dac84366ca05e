"""The law of a recorded session, wherever it is asked for: that of `viscorig identify`."""

from dataclasses import replace

import pytest
from called import facts

from instrument.interchange.identified import identify_session
from instrument.session.contents import TimedPoint


def test_a_session_in_which_all_is_as_stated_is_one_file(contents, capsys, session_path):
    found = identify_session(contents)
    assert len(found.files) == 1
    said = facts(capsys, "identify", session_path)
    assert list(said["parameters"].values()) == pytest.approx(found.result.law.values.tolist(), rel=1e-9)


def test_points_with_a_known_mass_are_not_fitted_as_if_it_were_not_there(contents, monkeypatch):
    light = contents.measured
    on = {"sweep": 3, "mass_kg": 0.005, "mass_at_mm": (280.0, 100.0)}
    heavy = [replace(p, **on) for p in light if p.segment == 1]
    both = replace(contents, points=[TimedPoint(p, float(k)) for k, p in enumerate((*light, *heavy))])
    given = []
    monkeypatch.setattr("instrument.interchange.identified.identify", lambda files, **_: given.extend(files))
    identify_session(both)
    assert [len(f.specimen.masses) for f in given] == [0, 1]
    assert [len(f.sweep) for f in given] == [len(light), len(heavy)]
