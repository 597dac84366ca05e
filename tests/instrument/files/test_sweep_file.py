import numpy as np
import pytest
from data_folder import DATA

from instrument.errors import BadInput
from instrument.files.sweep_file import read_sweep
from instrument.interchange.read_csv import read_csv

AMPLITUDES = "frequency_hz,velocity_m_s\n18.4,0.0726\n19.3,0.1112\n"
PHASORS = "frequency_hz,velocity_re_m_s,velocity_im_m_s\n18.4,-0.01,0.07\n19.3,0.0,0.11\n"


def write(tmp_path, text):
    path = tmp_path / "sweep.csv"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return path


def test_a_sweep_of_amplitudes_alone_has_no_phase(tmp_path):
    sweep = read_sweep(write(tmp_path, AMPLITUDES)).sweep(9.81)
    assert not sweep.has_phase
    np.testing.assert_array_equal(sweep.velocity_m_s, [0.0726, 0.1112])
    np.testing.assert_array_equal(sweep.commanded_m_s2, 9.81)
    assert sweep.base_m_s2 is None


def test_phasors_in_any_column_order_with_comments_and_unknown_columns(tmp_path):
    text = (
        "\ufeff# shaker 2\n\nvelocity_im_m_s, note ,frequency_hz,velocity_re_m_s,level_g\r\n"
        '0.07,"a, b",18.4,-0.01,0.5\r\n# break\r\n0.11,,19.3,0.0,2\r\n'
    )
    file = read_sweep(write(tmp_path, text))
    sweep = file.sweep(9.81)
    np.testing.assert_array_equal(sweep.velocity_m_s, [-0.01 + 0.07j, 0.11j])
    np.testing.assert_allclose(sweep.commanded_m_s2, [4.905, 19.62])
    assert file.unknown == {"note": ["a, b", ""]}


def test_reference_channel_scales_the_response(tmp_path):
    text = (
        "frequency_hz,velocity_re_m_s,velocity_im_m_s,base_accel_re_m_s2,base_accel_im_m_s2\n"
        "18.4,0.0,0.07,0.0,9.0\n"
    )
    sweep = read_sweep(write(tmp_path, text)).sweep(9.81)
    assert sweep.response_m_s[0] == pytest.approx(0.07 / 9 * 9.81)


FORCED = (
    "frequency_hz,acceleration_re_m_s2,acceleration_im_m_s2,force_re_n,force_im_n\n18.4,0.0,0.07,0.0,2.0\n"
)


def test_a_force_drives_in_the_place_of_the_base(tmp_path):
    sweep = read_sweep(write(tmp_path, FORCED)).sweep(1.0, "force")
    assert sweep.response_m_s[0] == pytest.approx(0.07 / 2 / (2j * np.pi * 18.4))


@pytest.mark.parametrize(
    ("text", "drive", "said"),
    [
        (FORCED, "base", "column force_re_n"),
        (PHASORS, "force", "no force"),
        (FORCED.replace("force_re_n,force_im_n", "base_accel_re_m_s2,base_accel_im_m_s2"), "force", "base_"),
        (
            FORCED.replace("18.4", "18.4,1").replace("frequency_hz", "frequency_hz,level_g"),
            "force",
            "level_g",
        ),
    ],
)
def test_columns_of_another_drive_are_refused(tmp_path, text, drive, said):
    with pytest.raises(BadInput, match=said):
        read_sweep(write(tmp_path, text)).sweep(1.0, drive)


def test_repeated_frequencies_are_kept_where_level_sweep_or_time_tells_them_apart(tmp_path):
    for column, values in (("level_g", "12"), ("sweep", "12"), ("time_s", "12")):
        text = f"frequency_hz,velocity_m_s,{column}\n18.4,0.07,{values[0]}\n18.4,0.07,{values[1]}\n"
        assert len(read_sweep(write(tmp_path, text)).columns["frequency_hz"]) == 2


def test_practice_sweep_is_read_whole():
    sweep = read_sweep(DATA / "practice-002.csv").sweep(9.81)
    assert len(sweep) == 353
    assert sorted(set(sweep.segment)) == [1, 2, 3]
    assert sweep.has_phase


BAD = {
    "empty": ("", "empty"),
    "comments only": ("# nothing\n", "no header"),
    "header only": ("frequency_hz,velocity_m_s\n", "no rows"),
    "binary": (b"\x00\xff\xfe\x89", "a binary file, expected text"),
    "nul": (b"frequency_hz\0", "NUL"),
    "no frequency": ("f,velocity_m_s\n1,2\n", "column frequency_hz missing"),
    "no velocity": ("frequency_hz\n1\n", "no velocity"),
    "half a phasor": ("frequency_hz,velocity_re_m_s,velocity_m_s\n1,2,3\n", "velocity_im_m_s missing"),
    "half a reference": (
        AMPLITUDES.replace("velocity_m_s", "velocity_m_s,base_accel_re_m_s2", 1),
        "base_accel_im_m_s2 missing",
    ),
    "column twice": ("frequency_hz,velocity_m_s,frequency_hz\n1,2,1\n", "twice"),
    "next to nothing": (
        AMPLITUDES.replace("0.0726", "1e-300"),
        "line 2: velocity_m_s = 1e-300, expected at least",
    ),
    "a frequency of next to nothing": (AMPLITUDES.replace("18.4", "1e-300"), "expected at least 1e-06 Hz"),
    "a weight of next to nothing": (
        "frequency_hz,velocity_m_s,weight\n18.4,0.07,1\n19.3,0.1,1e-300\n",
        "line 3: weight = 1e-300, expected at least 1e-30",
    ),
    "a phasor of next to nothing": (PHASORS.replace("-0.01,0.07", "1e-300,0"), "line 2: velocity is zero"),
    "nan": (AMPLITUDES.replace("0.0726", "nan"), "line 2: velocity_m_s = nan"),
    "infinite": (AMPLITUDES.replace("0.0726", "inf"), "line 2: velocity_m_s = inf"),
    "too large": (AMPLITUDES.replace("0.0726", "2e30"), "velocity_m_s = 2e30, expected nothing beyond"),
    "text": (AMPLITUDES.replace("0.0726", "loud"), "line 2: velocity_m_s = 'loud'"),
    "missing value": (AMPLITUDES.replace("0.0726", ""), "line 2: velocity_m_s = ''"),
    "ragged": (AMPLITUDES.replace("19.3,", "19.3,1,"), "line 3: 3 columns, expected 2"),
    "negative frequency": (AMPLITUDES.replace("18.4", "-18.4"), "line 2: frequency_hz = -18.4"),
    "zero frequency": (AMPLITUDES.replace("18.4", "0"), "line 2: frequency_hz = 0"),
    "zero amplitude": (AMPLITUDES.replace("0.0726", "0"), "line 2: velocity_m_s = 0"),
    "zero phasor": (PHASORS.replace("-0.01,0.07", "0,0"), "line 2: velocity is zero"),
    "row twice": (AMPLITUDES + "18.4,0.0726\n", "line 4: the same point as line 2"),
    "segment": (
        AMPLITUDES.replace("velocity_m_s", "velocity_m_s,segment")
        .replace("0.0726", "0.0726,1.5")
        .replace("0.1112", "0.1112,1"),
        "whole number",
    ),
    "huge segment": (
        "frequency_hz,velocity_m_s,segment\n18.4,0.07,1e20\n19.3,0.11,1\n",
        "segment = 1e20",
    ),
    "weight": (
        AMPLITUDES.replace("velocity_m_s", "velocity_m_s,weight")
        .replace("0.0726", "0.0726,-1")
        .replace("0.1112", "0.1112,1"),
        "weight = -1",
    ),
    "open quote": (AMPLITUDES.replace("0.0726", '"0.07'), "line 2"),
}


@pytest.mark.parametrize("case", BAD)
def test_bad_sweep_is_refused_in_one_line(tmp_path, case):
    text, expected = BAD[case]
    path = write(tmp_path, text)
    with pytest.raises(BadInput) as refused:
        read_sweep(path)
    message = str(refused.value)
    assert message.startswith(str(path))
    assert expected in message
    assert "\n" not in message


@pytest.mark.parametrize("name", ["phase_deg", "velocity_phase_rad", "Phase [deg]"])
def test_a_phase_beside_amplitudes_is_not_passed_over(tmp_path, name):
    text = f"frequency_hz,velocity_m_s,{name}\n18.4,0.07,-90\n19.3,0.11,-100\n"
    with pytest.raises(BadInput, match=r"header: column .* beside amplitudes, phases are not read so"):
        read_sweep(write(tmp_path, text))


def test_a_phase_beside_both_parts_is_a_column_of_its_own(tmp_path):
    text = "frequency_hz,velocity_re_m_s,velocity_im_m_s,phase_deg\n18.4,-0.01,0.07,98\n"
    assert read_sweep(write(tmp_path, text)).unknown == {"phase_deg": ["98"]}


def test_a_column_of_temperatures_has_a_mean_and_ends(tmp_path):
    text = "frequency_hz,velocity_m_s,temperature_c\n18.4,0.07,20\n19.3,0.11,23\n19.9,0.1,\n"
    file = read_sweep(write(tmp_path, text))
    assert file.temperature_c == 21.5
    assert file.temperature_range_c == (20.0, 23.0)
    assert read_sweep(write(tmp_path, AMPLITUDES)).temperature_range_c is None


def test_a_column_of_angular_frequencies_is_told_its_cure(tmp_path):
    text = "omega_rad_s,velocity_m_s\n115.6,0.07\n"
    with pytest.raises(
        BadInput, match=r"frequency_hz missing, found omega_rad_s: expected Hz, rad/s over 2 pi"
    ):
        read_sweep(write(tmp_path, text))


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("frequency_hz;velocity_m_s\n20;0,1\n", "header: semicolons between the columns and decimal commas"),
        ("frequency_hz\tvelocity_m_s\n20\t0.1\n", "header: tabs between the columns, expected commas"),
        ("sep=;\nfrequency_hz;velocity_m_s\n20;0,1\n", "header: a spreadsheet's line 'sep=;' above it"),
        ("sep=,\nfrequency_hz,velocity_m_s\n20,0.1\n", "header: a spreadsheet's line 'sep=' above it"),
        ("frequency_hz,velocity_m_s\n20,4.17D-05\n", "= '4.17D-05', expected a number .E before an exponent"),
        ("frequency_hz,velocity_m_s\nHz,m/s\n20,0.1\n", r"line 2: units \(Hz, m/s\) below the header"),
        (
            "frequency_hz,velocity_re_mm_s,velocity_im_mm_s\n20,0.1,1\n",
            "velocity_re_mm_s is not in m, expected velocity_re_m_s, in m",
        ),
    ],
)
def test_what_import_reads_is_sent_there_and_import_reads_it(tmp_path, text, said):
    row = text.splitlines()[-1]
    path = write(tmp_path, f"{text}{row.replace('20', '30', 1)}\n")
    with pytest.raises(BadInput, match=rf"{said}.*; 'viscorig import' reads other programs' tables"):
        read_sweep(path)
    (columns,) = read_csv(path).sweeps
    np.testing.assert_allclose(columns["frequency_hz"], [20.0, 30.0])


def test_a_decimal_comma_in_a_cell_is_told_its_cure(tmp_path):
    with pytest.raises(BadInput, match="velocity_m_s = '0,1', expected a number with a decimal point"):
        read_sweep(write(tmp_path, 'frequency_hz,velocity_m_s\n20,"0,1"\n'))


def test_quotes_about_cells_change_nothing(tmp_path):
    plain, quoted = tmp_path / "a.csv", tmp_path / "b.csv"
    plain.write_text("frequency_hz,velocity_m_s,remark\n10.0,1e-3,a\n11.0,2e-3, b \n")
    quoted.write_text('"frequency_hz",velocity_m_s,remark\n10.0,"1e-3","a"\n11.0,2e-3, b \n')
    one, other = read_sweep(plain), read_sweep(quoted)
    assert one.columns["velocity_m_s"].tolist() == other.columns["velocity_m_s"].tolist() == [1e-3, 2e-3]
    assert one.unknown == other.unknown == {"remark": ["a", "b"]}
