import numpy as np
import pytest
from session_cases import RATE, SyntheticSession, configuration

from instrument.errors import BadInput
from instrument.session.dwell import dwell_of
from instrument.session.storage import SessionFile
from instrument.stepped_sine.sine_fit import sine_fit
from instrument.stream.derived import PointMeasured
from instrument.stream.raw import BlockAcquired


@pytest.fixture(scope="module")
def synthetic():
    synthetic = SyntheticSession(configuration())
    synthetic.begin()
    synthetic.calibrate()
    synthetic.sweep((1,), steps=4)
    return synthetic


@pytest.fixture(scope="module")
def points(synthetic):
    return [e for e in synthetic.events if isinstance(e, PointMeasured)]


@pytest.fixture
def session(synthetic, tmp_path):
    with SessionFile(synthetic.save(tmp_path)) as session:
        yield session


@pytest.mark.parametrize("number", [0, 4, -1])
def test_its_sine_fit_is_the_point(session, points, number):
    """Calibration, sentinel and step alike; the calibration is not taken off the samples."""
    point = points[number]
    dwell = dwell_of(session, point.step)
    assert len(dwell.time_s) == round(point.dwell_s * RATE)
    x = np.stack([dwell.base_m_s2, dwell.velocity_m_s])
    fit = sine_fit(x, point.sample, RATE, point.frequency_hz)
    assert fit.phasor[0] == pytest.approx(point.base_m_s2, rel=1e-9)
    assert abs(fit.phasor[1]) == pytest.approx(abs(point.velocity_m_s), rel=0.03)
    if point.purpose == "calibration":
        assert fit.phasor[1] == pytest.approx(point.velocity_m_s, rel=1e-9)


def test_a_step_that_is_not_there_is_said(session):
    with pytest.raises(BadInput, match="no point of step 999"):
        dwell_of(session, 999)


def test_lost_samples_are_said(synthetic, points, tmp_path):
    lost = SyntheticSession(synthetic.configuration)
    lost.events = [
        e for e in synthetic.events if not (isinstance(e, BlockAcquired) and e.first_sample > 5000)
    ]
    with SessionFile(lost.save(tmp_path)) as session, pytest.raises(BadInput, match="samples of step"):
        dwell_of(session, points[-1].step)


def test_reading_is_broken_off_where_it_is_no_longer_wanted(session, points):
    class Unwanted(Exception):
        pass

    def look():
        raise Unwanted

    with pytest.raises(Unwanted):
        dwell_of(session, points[-1].step, look)
