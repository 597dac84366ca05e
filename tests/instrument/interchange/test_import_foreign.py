"""Files of other programs become this one's CSV."""

import numpy as np
import pytest
from foreign_files import BASE, RATIO, F, V, frf_set, lms, over_base, sweep_of, time_set
from scipy.io import savemat
from uff_files import write_sets

from instrument.errors import BadInput
from instrument.files.impact_csv import read_impact_csv
from instrument.files.sweep_file import read_sweep
from instrument.interchange.importing import import_file

UNITS_MM = {
    "type": 164,
    "units_code": 5,
    "units_description": "mm (milli newton)",
    "temp_mode": 1,
    "length": 1000.0,
    "force": 1000.0,
    "temp": 1.0,
    "temp_offset": 273.15,
}
I_OMEGA = 2j * np.pi * F


@pytest.mark.parametrize(
    ("data", "over", "under"),
    [
        (RATIO, 11, 12),
        (RATIO * I_OMEGA, 12, 12),
        (RATIO / I_OMEGA, 8, 12),
        (RATIO * I_OMEGA, 11, 11),
        (RATIO * I_OMEGA, 8, 8),
    ],
)
def test_any_motion_over_any_motion_of_the_base_is_velocity_over_acceleration(tmp_path, data, over, under):
    write_sets(tmp_path / "a.uff", frf_set(data, over, under))
    read = sweep_of(tmp_path / "a.uff", tmp_path / "a.csv").columns
    np.testing.assert_allclose(over_base(read), RATIO, rtol=1e-12)
    assert "level_g" not in read


def test_units_are_read_from_the_set(tmp_path):
    labelled = {"ordinate_axis_units_lab": "mm/s", "orddenom_axis_units_lab": "g"}
    write_sets(tmp_path / "a.uff", frf_set(RATIO * 1e3 * 9.80665, 11, 12, **labelled))
    read = sweep_of(tmp_path / "a.uff", tmp_path / "a.csv").columns
    np.testing.assert_allclose(over_base(read), RATIO, rtol=1e-12)


def test_a_files_own_units_scale_what_has_no_label(tmp_path):
    """mm and mN: accelerance in mm/s^2/mN is m/s^2/N; one in mm/s^2 over a labelled N is not."""
    write_sets(
        tmp_path / "a.uff",
        UNITS_MM,
        frf_set(RATIO, 12, 13),
        frf_set(RATIO, 12, 13, orddenom_axis_units_lab="N"),
    )
    import_file(tmp_path / "a.uff", tmp_path / "a.csv")
    same, scaled = (read_impact_csv(tmp_path / f"a-{k}.csv")["accelerance"].H for k in (1, 2))
    np.testing.assert_allclose(same, RATIO, rtol=1e-12)
    np.testing.assert_allclose(scaled, RATIO * 1e-3, rtol=1e-12)


def test_passes_over_one_band_become_sweeps(tmp_path):
    write_sets(tmp_path / "a.uff", frf_set(RATIO, 11, 12), frf_set(2 * RATIO, 11, 12))
    read = sweep_of(tmp_path / "a.uff", tmp_path / "a.csv").columns
    np.testing.assert_array_equal(read["sweep"], [1] * 5 + [2] * 5)


def test_a_line_at_zero_is_left_out_and_said(tmp_path):
    x = np.array([0.0, 10.0, 20.0])
    write_sets(tmp_path / "a.uff", frf_set(np.array([0, 1j, 2j]), 11, 12, x=x))
    imported = import_file(tmp_path / "a.uff", tmp_path / "a.csv")
    assert read_sweep(tmp_path / "a.csv").columns["frequency_hz"].tolist() == [10, 20]
    assert "left out at 0 Hz or without a value: 1" in imported.said[0]


def test_a_response_before_its_force_is_found(tmp_path):
    force, response = np.zeros(50), np.arange(50.0)
    force[5] = 100.0
    write_sets(tmp_path / "a.uff", time_set(response, 12), time_set(force, 13))
    import_file(tmp_path / "a.uff", tmp_path / "a.csv")
    (hit,) = read_impact_csv(tmp_path / "a.csv")
    np.testing.assert_array_equal(hit.responses[0].samples, response)
    assert hit.sample_rate_hz == pytest.approx(1000)


def test_two_accelerometers_get_a_file_each(tmp_path):
    force, a, b = np.eye(1, 50, 5)[0], np.arange(50.0), -np.arange(50.0)
    write_sets(tmp_path / "a.uff", time_set(force, 13), time_set(a, 12), time_set(b, 12))
    imported = import_file(tmp_path / "a.uff", tmp_path / "a.csv")
    assert [p.name for p in imported.files] == ["a-1.csv", "a-2.csv"]
    (second,) = read_impact_csv(tmp_path / "a-2.csv")
    np.testing.assert_array_equal(second.responses[0].samples, b)


def test_testlab_frf_over_a_base(tmp_path):
    savemat(tmp_path / "a.mat", {"FRF_1": lms(RATIO * 9.80665, "(m/s)/g")})
    read = sweep_of(tmp_path / "a.mat", tmp_path / "a.csv").columns
    np.testing.assert_allclose(read["frequency_hz"], 10 + 0.5 * np.arange(5))
    np.testing.assert_allclose(over_base(read), RATIO, rtol=1e-12)


def test_testlab_frf_over_a_force(tmp_path):
    savemat(tmp_path / "a.mat", {"FRF": lms(RATIO, "g/N")})
    import_file(tmp_path / "a.mat", tmp_path / "a.csv")
    np.testing.assert_allclose(read_impact_csv(tmp_path / "a.csv")["accelerance"].H, RATIO * 9.80665)


def test_testlab_time_records_make_a_hit(tmp_path):
    force, response = np.eye(1, 64, 8)[0] * 50, np.sin(np.arange(64.0))
    signals = {
        "Signal_0": lms(response, "g", "s", 0.0, 1e-3),
        "Signal_1": lms(force, "N", "s", 0.0, 1e-3),
    }
    savemat(tmp_path / "a.mat", signals)
    import_file(tmp_path / "a.mat", tmp_path / "a.csv")
    (hit,) = read_impact_csv(tmp_path / "a.csv")
    np.testing.assert_allclose(hit.force_n, force)
    np.testing.assert_allclose(hit.responses[0].samples, response * 9.80665)
    assert hit.sample_rate_hz == pytest.approx(1000)


def test_arrays_are_known_by_their_names_and_units(tmp_path):
    arrays = {"freq": F, "velocity_mm_s": V * 1e3, "base_accel_g": BASE / 9.80665, "comment": "by hand"}
    savemat(tmp_path / "a.mat", arrays)
    read = sweep_of(tmp_path / "a.mat", tmp_path / "a.csv").columns
    np.testing.assert_allclose(over_base(read), RATIO, rtol=1e-12)


# Foreign CSV


def test_semicolons_decimal_commas_and_units_in_brackets(tmp_path):
    phasors = ("Velocity real [mm/s]", "Velocity imag [mm/s]", "Base accel real [g]", "Base accel imag [g]")
    table = np.column_stack([F, 1e3 * V.real, 1e3 * V.imag, BASE.real / 9.80665, BASE.imag / 9.80665])
    head = ";".join(["Frequency [Hz]", *phasors])
    rows = [";".join(repr(float(x)).replace(".", ",") for x in row) for row in table]
    (tmp_path / "a.csv").write_text("\n".join([head, *rows]))
    read = sweep_of(tmp_path / "a.csv", tmp_path / "out.csv").columns
    np.testing.assert_allclose(over_base(read), RATIO, rtol=1e-12)


def test_magnitude_and_phase_with_a_row_of_units(tmp_path):
    rows = [f"{f}\t{abs(r)}\t{np.degrees(np.angle(r))}" for f, r in zip(F, RATIO, strict=True)]
    text = "\n".join(["Frequency\tFRF magnitude\tFRF phase", "Hz\t(m/s)/(m/s²)\tdeg", *rows])
    (tmp_path / "a.txt").write_text(text, encoding="utf-8")
    read = sweep_of(tmp_path / "a.txt", tmp_path / "out.csv").columns
    np.testing.assert_allclose(over_base(read), RATIO, rtol=1e-12)


def test_amplitudes_alone_stay_amplitudes(tmp_path):
    rows = "\n".join(f"{f},{abs(v) * 1e3}" for f, v in zip(F, V, strict=True))
    (tmp_path / "a.csv").write_text(f"Frequency (Hz),Velocity (mm/s)\n{rows}\n")
    read = sweep_of(tmp_path / "a.csv", tmp_path / "out.csv").columns
    np.testing.assert_allclose(read["velocity_m_s"], np.abs(V), rtol=1e-12)
    assert "base_accel_re_m_s2" not in read


def test_a_record_with_times(tmp_path):
    rows = "\n".join(f"{k * 0.5},{100 * (k == 3)},{k}" for k in range(20))
    (tmp_path / "a.csv").write_text(f"Time [ms],Hammer [N],Acceleration [g]\n{rows}\n")
    import_file(tmp_path / "a.csv", tmp_path / "out.csv")
    (hit,) = read_impact_csv(tmp_path / "out.csv")
    assert hit.sample_rate_hz == pytest.approx(2000)
    assert hit.responses[0].samples[1] == pytest.approx(9.80665)


def test_a_row_of_a_text_is_named_by_its_line(tmp_path):
    (tmp_path / "a.csv").write_text("# of a rig\n\nf [Hz],v [m/s],Weight\n20,0.1,1\n30,0.2,0\n")
    with pytest.raises(BadInput, match=r"a\.csv: line 5: weight = 0, expected more than 0"):
        import_file(tmp_path / "a.csv", tmp_path / "b.csv")
