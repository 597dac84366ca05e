"""What a foreign table or FRF is understood as, before it becomes a file of ours."""

import numpy as np
import pytest

from instrument.errors import BadInput
from instrument.files.units import unit_of
from instrument.interchange.base_frf import is_frf_csv, sweep_of_foreign, sweep_of_frf_csv
from instrument.interchange.found import REFERENCE_M_S2, Found, Ratio, motion_of
from instrument.interchange.provenance import one_line
from instrument.interchange.read_csv import read_csv
from instrument.interchange.readers import foreign_endings, is_foreign, read_foreign

F = np.array([0.0, 10.0, 20.0])
H = np.array([1.0, 0.5 + 0.1j, 0.25j])


def written(path, text):
    path.write_text(text, encoding="utf-8")
    return path


@pytest.mark.parametrize(("quantity", "turns"), [("velocity", 0), ("displacement", 1), ("acceleration", -1)])
def test_any_motion_over_the_bases_acceleration_becomes_velocity_at_the_reference(quantity, turns):
    found = Found()
    found.add_ratio(Ratio("H", F, H, quantity, "acceleration", place=(2, 3)))
    (c,) = found.sweeps
    v = c["velocity_re_m_s"] + 1j * c["velocity_im_m_s"]
    assert v == pytest.approx(H[1:] * (2j * np.pi * F[1:]) ** turns * REFERENCE_M_S2)
    assert (c["sweep"].tolist(), c["segment"].tolist()) == ([2, 2], [3, 3])
    assert "level_g" not in c
    assert found.said[0].endswith("2 lines, 10 to 20 Hz; left out at 0 Hz or without a value: 1")


def test_a_stated_level_is_the_base_of_the_sweep():
    found = Found()
    found.add_ratio(Ratio("H", F, H, "velocity", "acceleration", level_m_s2=2 * REFERENCE_M_S2))
    assert found.sweeps[0]["level_g"].tolist() == [2, 2]
    assert found.sweeps[0]["base_accel_re_m_s2"] == pytest.approx(2 * REFERENCE_M_S2)


def test_an_frf_over_a_force_keeps_its_coherence_line_by_line():
    found = Found()
    found.add_ratio(Ratio("A", F, H, "acceleration", "force"), np.array([0.1, 0.8, 0.9]))
    ((name, frf, coherence),) = found.frfs
    assert (name, frf.motion, frf.frequency_hz.tolist()) == ("A", "acceleration", [10, 20])
    assert coherence.tolist() == [0.8, 0.9]
    with pytest.raises(BadInput, match="a force as response"):
        motion_of("A", "force")


def test_nothing_above_zero_is_passed_over_with_its_reason():
    found = Found()
    found.add_ratio(Ratio("H", F, 0 * H, "velocity", "acceleration"))
    assert (found.sweeps, found.frfs) == ([], [])
    assert found.said == ["passed over: H: no line with a value above 0 Hz"]


@pytest.mark.parametrize("rate_hz", [0.0, -1.0, float("nan"), float("inf")])
def test_a_record_needs_a_rate(rate_hz):
    with pytest.raises(BadInput, match="a: sample rate"):
        Found().add_hit("a", rate_hz, np.ones(3), [("acceleration", np.ones(3))])


SEMICOLONS = "Frequency;Velocity real;Velocity imag;Base\nHz;mm/s;mm/s;g\n10,0;1,5;-0,5;1\n20,0;3,0;0;1\n"


def test_a_decimal_comma_and_a_row_of_units_are_read_as_they_are_meant(tmp_path):
    (c,) = read_csv(written(tmp_path / "a.csv", SEMICOLONS)).sweeps
    assert c["frequency_hz"].tolist() == [10, 20]
    assert c["velocity_re_m_s"] == pytest.approx([1.5e-3, 3e-3])
    assert c["velocity_im_m_s"] == pytest.approx([-0.5e-3, 0])
    assert c["base_accel_re_m_s2"] == pytest.approx(unit_of("g").factor)


def test_hits_that_share_a_file_are_records_of_their_own(tmp_path):
    rows = "".join(f"{k},{n / 1000},{n + k},{-n}\n" for k in (1, 2) for n in range(4))
    head = "hit,time_s,force_n,acceleration_m_s2\n"
    first, second = read_csv(written(tmp_path / "a.csv", head + rows)).hits
    assert (first.force_n.tolist(), second.force_n.tolist()) == ([1, 2, 3, 4], [2, 3, 4, 5])
    assert first.sample_rate_hz == pytest.approx(1000)


def test_a_table_that_is_none_of_ours_is_refused_with_what_was_found_and_expected(tmp_path):
    with pytest.raises(BadInput, match="found colour, size, expected a frequency"):
        read_csv(written(tmp_path / "a.csv", "colour,size\n1,2\n"))
    with pytest.raises(BadInput, match="line 3: 'x', expected a number"):
        read_csv(written(tmp_path / "b.csv", "frequency_hz,velocity_m_s\n1,2\n2,x\n"))


def test_a_file_is_read_by_its_ending_whatever_its_case(tmp_path):
    assert {".uff", ".mat", ".csv"} <= set(foreign_endings())
    assert [is_foreign(tmp_path / n) for n in ("a.UFF", "a.mat", "a.csv", "a.doc")] == [
        True,
        True,
        False,
        False,
    ]
    assert len(read_foreign(written(tmp_path / "A.CSV", SEMICOLONS)).sweeps) == 1
    with pytest.raises(BadInput, match=r"a\.doc: unknown ending '\.doc'"):
        read_foreign(written(tmp_path / "a.doc", ""))


ACCELERANCE = "frequency_hz,accelerance_re,accelerance_im\n"


def test_an_accelerance_is_read_as_velocity_for_the_drives_amplitude(tmp_path):
    lines = "".join(f"{f},0,{2 * np.pi * f * 0.1}\n" for f in range(10, 16))
    path = written(tmp_path / "a.csv", ACCELERANCE + lines)
    assert is_frf_csv(path)
    # i omega v over a force of 1 N, v = 0.1 m/s.
    s = sweep_of_frf_csv(path, 2.0)
    assert s.response_m_s == pytest.approx(0.2 * np.ones(6))
    assert s.commanded_m_s2.tolist() == [2] * 6


def test_the_frf_of_each_pickup_is_told_from_the_others(tmp_path):
    lines = "".join(f"{k},{f},0,{6 - 3 * k}\n" for k in (0, 1) for f in range(10, 16))
    s = sweep_of_frf_csv(written(tmp_path / "a.csv", "pickup," + ACCELERANCE + lines), 1.0)
    assert s.pickup.tolist() == [0] * 6 + [1] * 6
    assert np.abs(s.response_m_s[:6]) == pytest.approx(2 * np.abs(s.response_m_s[6:]))


def test_what_is_driven_by_a_force_needs_one_response_over_it(tmp_path):
    path = written(tmp_path / "a.csv", SEMICOLONS)
    assert is_frf_csv(written(tmp_path / "b.csv", "frequency_hz,velocity_m_s\n1,1\n")) is False
    assert len(sweep_of_foreign(path, 9.81)) == 2
    with pytest.raises(BadInput, match="0 responses over a force, expected one"):
        sweep_of_foreign(path, 1.0, "force")


def test_a_comment_stays_on_its_line():
    assert one_line(" a title\n# not: a comment\r\n ") == "a title # not: a comment"
