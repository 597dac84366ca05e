import numpy as np
import pytest
from paper_law import TABLE_4

from gui.pages.law.curve import LawCurve, joined, places_hz, resonances_hz
from instrument.facts.identification import PointFitted
from instrument.facts.rows import LawRow


def curve(low=14.0, high=310.0, count=41):
    return LawCurve.stated(TABLE_4, np.geomspace(low, high, count))


def rows(c):
    return [
        LawRow(
            frequency_hz=f,
            storage_modulus_pa=1e6 * G,
            loss_factor=eta,
            storage_modulus_standard_error_pa=np.nan,
            loss_factor_standard_error=0.01,
        )
        for f, G, eta in zip(c.frequency_hz, c.storage_mpa, c.loss, strict=True)
    ]


def point(frequency_hz, measured_m_s, segment=1):
    said = {"measured_m_s": measured_m_s, "predicted_m_s": measured_m_s, "difference_percent": 0.0}
    return PointFitted(frequency_hz=frequency_hz, segment=segment, **said)


def test_between_rows_the_law_is_met():
    for f in (14.0, 33.3, 100.0, 280.0, 310.0):
        G, eta = TABLE_4.storage_and_loss(2 * np.pi * np.array([f]))
        found = curve().at(f)
        assert found.storage_mpa == pytest.approx(1e-6 * G[0], rel=1e-5)
        assert found.loss == pytest.approx(eta[0], rel=1e-5)


def test_outside_the_measured_range_nothing_is_said():
    assert curve().at(13.0) is None
    assert curve().at(311.0) is None


def test_absent_errors_stay_absent():
    c = LawCurve.of(rows(curve()))
    assert np.isnan(c.storage_error_mpa).all()
    assert c.at(100.0).loss_error == pytest.approx(0.01)


def test_joined_curves_stay_apart():
    one = curve(count=3)
    both = joined([one, one])
    assert np.isnan(both.frequency_hz).tolist() == [False] * 3 + [True] + [False] * 3 + [True]
    assert len(joined([]).loss) == 0


def test_a_resonance_is_a_peak_inside_its_segment():
    first = [point(f, 1 / (1 + (f - 20) ** 2)) for f in np.arange(15.0, 26.0)]
    rising = [point(f, f, 2) for f in np.arange(90.0, 99.0)]
    sentinel = [point(20.0, 9.0, 2)]
    assert resonances_hz(first + sentinel + rising) == {1: 20.0}


def test_numbers_are_stated_where_it_was_measured():
    assert places_hz({1: 19.0, 2: 250.0}, curve(15.0, 120.0)) == [
        (19.0, "peak of segment 1"),
        (20.0, ""),
        (100.0, ""),
    ]
