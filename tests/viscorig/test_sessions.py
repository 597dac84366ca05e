"""Sessions, read and made."""

import shutil

import numpy as np
import pytest
from diagnosed_session import diagnosed_session
from session_cases import SyntheticSession, configuration
from sessions import contents_in

import viscorig as vr


@pytest.fixture(scope="module")
def session(session_path):
    return vr.load_session(session_path)


@pytest.fixture(scope="module")
def contents(session_path):
    return contents_in(session_path, with_hits=False)


def test_a_session_holds_what_was_recorded(session, contents):
    assert session.specimen.model == contents.specimen
    assert session.hammer.as_dict() == contents.damping.result.as_json()
    assert session.identification.as_dict() == contents.fit.result.as_json()
    assert session.diagnosis is None
    assert len(session.sweep) == len(contents.points)
    assert np.array_equal(session.sweep.velocity_m_s, [p.point.velocity_m_s for p in contents.points])
    assert session.as_dict()["identify"] == contents.fit.result.as_json()
    assert session.lines()[0] == "session zn1-20260401T080000Z"
    assert session.plot().get_ylabel() == "Velocity / (m/s)"


def test_a_session_can_be_fitted_again_as_the_command_does(session, session_path, command):
    seconds = {"seconds", "setup_seconds", "validation_seconds"}
    expected = command("identify", session_path)
    found = vr.identify(session).as_dict()
    assert {k: v for k, v in found.items() if k not in seconds} == {
        k: v for k, v in expected.items() if k not in seconds
    }
    assert found["session"] == session.name


def test_the_hammer_test_can_be_left_out(session):
    assert "hammer" not in vr.identify(session.sweep, session.specimen).as_dict()


def test_the_recorded_law_predicts(session):
    f = [20.0, 21.0]
    assert vr.predict(session.specimen, f, fit=session.identification).velocity_m_s.shape == (2,)


def test_a_recorded_diagnosis_is_there(tmp_path):
    session = vr.load_session(diagnosed_session(tmp_path))
    assert session.diagnosis.verdict == "effect"
    assert session.as_dict()["diagnose"]["verdict"] == "effect"


def test_why_there_is_no_diagnosis_is_said(tmp_path):
    session = vr.load_session(diagnosed_session(tmp_path, message="too few points"))
    assert session.diagnosis is None
    assert session.remarks == ("no diagnosis: too few points",)


def test_a_hammer_test_alone_is_a_session_without_a_sweep(tmp_path):
    synthetic = SyntheticSession(configuration())
    synthetic.begin()
    synthetic.hammer()
    synthetic.end()
    session = vr.load_session(synthetic.save(tmp_path))
    assert session.sweep is None
    assert session.identification is None
    assert session.to_numpy() == {}
    assert session.plot().get_ylabel() == "Damping ratio / % of critical"
    with pytest.raises(vr.errors.BadInput, match="no point of a sweep"):
        vr.identify(session)


def test_the_file_is_closed_again(session_path, tmp_path):
    import h5py

    path = shutil.copy(session_path, tmp_path / "copy.h5")
    vr.load_session(path)
    with h5py.File(path, "r+"):
        pass


def test_what_is_no_session_is_refused(tmp_path):
    path = tmp_path / "no.h5"
    with pytest.raises(vr.errors.BadInput, match="no such file"):
        vr.load_session(path)
    path.write_bytes(b"nothing of the kind")
    with pytest.raises(vr.errors.BadInput, match="not a session file"):
        vr.load_session(str(path))


def test_a_damaged_session_is_refused(session_path, tmp_path):
    whole = session_path.read_bytes()
    path = tmp_path / "half.h5"
    path.write_bytes(whole[: len(whole) // 2])
    with pytest.raises(vr.errors.BadInput, match=r"half\.h5"):
        vr.load_session(path)
