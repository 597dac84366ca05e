import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from impact_cases import BARE_HZ, RATE, TABLE_3, clean_hit, noisy_hits
from scipy.io import savemat
from uff_files import write_frf, write_hits

from fitting.gravity import STANDARD_GRAVITY_M_S2 as G
from fitting.modal.frf import Frf
from instrument.cli.main import run
from instrument.errors import BadInput
from instrument.files.impact_csv import write_frf_csv, write_impact_csv
from instrument.files.records import Named, read_records

REAL = Path(__file__).parents[3].parent / "shared/data/real/long_single_header_multi_ch.lvm"


@pytest.fixture(scope="module")
def hits():
    return noisy_hits(clean_hit(), np.random.default_rng(0))


def same_hits(a, b, rtol=1e-12):
    assert len(a) == len(b)
    for x, y in zip(a, b, strict=True):
        assert x.sample_rate_hz == pytest.approx(y.sample_rate_hz)
        np.testing.assert_allclose(x.force_n, y.force_n, rtol=rtol, atol=1e-9)
        assert [c.motion for c in x.responses] == [c.motion for c in y.responses]
        np.testing.assert_allclose(x.responses[0].samples, y.responses[0].samples, rtol=rtol, atol=1e-9)


def test_csv_round_trip(tmp_path, hits):
    write_impact_csv(tmp_path / "a.csv", hits)
    same_hits(read_records(tmp_path / "a.csv", Named()), hits)


@pytest.mark.parametrize("binary", [True, False])
def test_uff_round_trip_of_hits(tmp_path, hits, binary):
    write_hits(tmp_path / "a.uff", hits, binary=binary)
    same_hits(read_records(tmp_path / "a.uff", Named()), hits, rtol=1e-10 if binary else 1e-4)


@pytest.mark.parametrize("binary", [True, False])
@pytest.mark.parametrize("even", [True, False])
def test_uff_round_trip_of_an_frf(tmp_path, binary, even):
    f = np.linspace(10, 20, 50) if even else np.array([10, 11, 12.5, 15, 20.0, 21])
    frf = Frf(f, np.exp(1j * f), "velocity")
    write_frf(tmp_path / "a.uff", {"mobility": frf}, binary=binary)
    (back,) = read_records(tmp_path / "a.uff", Named()).values()
    assert back.motion == "velocity"
    np.testing.assert_allclose(back.frequency_hz, f, rtol=1e-5)
    np.testing.assert_allclose(back.H, frf.H, rtol=1e-4)


def test_uff_records_are_read_in_the_units_they_are_labelled_with(tmp_path, hits):
    plain = hits[:1]
    labelled = [
        replace(h, responses=(replace(h.responses[0], samples=h.responses[0].samples / G),)) for h in plain
    ]
    write_hits(tmp_path / "a.uff", labelled, ordinate_axis_units_lab={"acceleration": "g", "force": "N"})
    same_hits(read_records(tmp_path / "a.uff", Named()), plain)


def test_uff_records_of_no_known_kind_are_left_out(tmp_path, hits):
    write_hits(tmp_path / "a.uff", hits[:1], further=(0,))
    (hit,) = read_records(tmp_path / "a.uff", Named())
    assert len(hit.responses) == 1


def test_frf_csv_round_trip(tmp_path):
    f = np.linspace(10, 20, 50)
    frf = Frf(f, np.exp(1j * f), "acceleration")
    write_frf_csv(tmp_path / "a.csv", frf, np.ones(50))
    (back,) = read_records(tmp_path / "a.csv", Named()).values()
    np.testing.assert_array_equal(back.H, frf.H)
    assert back.motion == "acceleration"


def test_mat_with_named_variables(tmp_path, hits):
    h = hits[0]
    content = {"F": h.force_n, "a": h.responses[0].samples / 9.80665, "fs": RATE, "note": "x"}
    savemat(tmp_path / "a.mat", content)
    named = Named(force="F", responses=("a:g",), rate_hz=RATE)
    same_hits(read_records(tmp_path / "a.mat", named), [h], rtol=1e-9)
    units_in_names = {
        "force_n": h.force_n,
        "acceleration_m_s2": h.responses[0].samples,
        "sample_rate_hz": RATE,
    }
    savemat(tmp_path / "b.mat", units_in_names)
    same_hits(read_records(tmp_path / "b.mat", Named()), [h])


def test_times_written_with_few_digits_give_the_rate(tmp_path):
    rows = [f"{k / 5120:.6f},0.0,{k}" for k in range(100)]
    (tmp_path / "a.csv").write_text("\n".join(["time_s,force_n,velocity_m_s", *rows]))
    (hit,) = read_records(tmp_path / "a.csv", Named())
    assert hit.sample_rate_hz == pytest.approx(5120, rel=1e-3)


def lvm_text(hits, *, separator="\t", comma=False, repeat_header=True):
    def text(x):
        return repr(float(x)).replace(".", ",") if comma else repr(float(x))

    head = [
        "LabVIEW Measurement\t",
        "Separator\tTab",
        "X_Columns\tNo",
        f"Decimal_Separator\t{',' if comma else '.'}",
    ]
    lines = [*head, "***End_of_Header***\t", "\t"]
    for k, h in enumerate(hits):
        if k == 0 or repeat_header:
            n = len(h.force_n)
            lines += ["Channels\t2\t\t", f"Samples\t{n}\t{n}\t", "Y_Unit_Label\tN\tm/s^2\t"]
            lines += [f"Delta_X\t{text(1 / RATE)}\t{text(1 / RATE)}\t", "***End_of_Header***\t\t"]
            lines += ["X_Value\tF\ta\tComment"]
        lines += [f"\t{text(f)}\t{text(a)}" for f, a in zip(h.force_n, h.responses[0].samples, strict=True)]
    return "\n".join(lines) + "\n"


@pytest.mark.parametrize("comma", [False, True])
@pytest.mark.parametrize("repeat_header", [False, True])
def test_lvm_with_several_segments(tmp_path, hits, comma, repeat_header):
    path = tmp_path / "a.lvm"
    path.write_text(lvm_text(hits[:2], comma=comma, repeat_header=repeat_header))
    same_hits(read_records(path, Named()), hits[:2], rtol=1e-9)


BAD = {
    "units.csv": ("force,acceleration\n1,2\n", "units are part of the name"),
    "rate.csv": ("force_n,acceleration_m_s2\n" + "1,2\n" * 20, "no sample rate"),
    "uneven.csv": ("time_s,force_n,velocity_m_s\n0,1,1\n1,1,1\n5,1,1\n", "evenly"),
    "rates.csv": (
        "# sample_rate_hz: 48000\ntime_s,force_n,velocity_m_s\n"
        + "".join(f"{k / 1000},0,1\n" for k in range(20)),
        "contradict",
    ),
    "nan.csv": ("# sample_rate_hz: 10\nforce_n,velocity_m_s\nnan,1\n", "line 3: force_n = nan"),
    "empty.csv": ("", "empty"),
    "frf.csv": ("frequency_hz,accelerance_re\n1,2\n", "frequency_hz, expected 5"),
    "bad.lvm": ("nothing\n", "LabVIEW"),
    "bad.uff": ("nothing\n", "universal file|data set 58"),
    "bad.mat": ("nothing\n", "MATLAB"),
    "bad.xyz": ("nothing\n", "unknown ending"),
}


@pytest.mark.parametrize("name", BAD)
def test_bad_record_is_refused_in_one_line(tmp_path, capsys, name):
    text, expected = BAD[name]
    (tmp_path / name).write_text(text)
    with pytest.raises(BadInput, match=expected) as refused:
        read_records(tmp_path / name, Named())
    assert "\n" not in str(refused.value).strip()
    assert run(["damping", str(tmp_path / name)]) == 2
    assert capsys.readouterr().err.count("\n") == 1


def test_channels_without_units_ask_for_them(tmp_path, hits):
    path = tmp_path / "a.lvm"
    path.write_text(lvm_text(hits[:1]).replace("m/s^2", ""))
    with pytest.raises(BadInput, match="say --response a:UNIT"):
        read_records(path, Named())
    assert read_records(path, Named(responses=("a:m/s^2",)))[0].responses[0].motion == "acceleration"


def test_damping_command_writes_the_contracts_json_and_figures(tmp_path, capsys, hits):
    write_impact_csv(tmp_path / "a.csv", hits)
    out = tmp_path / "d.json"
    assert (
        run(["damping", str(tmp_path / "a.csv"), "--json", str(out), "--figures", str(tmp_path / "f")]) == 0
    )
    assert "rational fit" in capsys.readouterr().out
    found = json.loads(out.read_text())
    assert len(found["modes"]) == 8
    keys = {"frequency_hz", "damping_ratio", "channel", "half_power", "rational_fit", "lscf"}
    assert set(found["modes"][0]) >= keys | {"lines_in_bandwidth", "accepted", "why"}
    assert set(found["modes"][3]["rational_fit"]) == {"ratio", "standard_error"}
    assert found["modes"][0]["half_power"] is None
    assert [h["accepted"] for h in found["hits"]] == [True] * 3
    assert {p.name for p in (tmp_path / "f").iterdir()} == {"frf.png", "hits.png", "modes.png"}


def test_files_of_one_hit_each_are_averaged_and_bands_respected(tmp_path, capsys, hits):
    paths = []
    for k, hit in enumerate(hits):
        write_impact_csv(tmp_path / f"{k}.csv", [hit])
        paths.append(str(tmp_path / f"{k}.csv"))
    assert run(["damping", *paths, "--band", "100:300", "--json", "-"]) == 0
    found = json.loads(capsys.readouterr().out)
    np.testing.assert_allclose([m["frequency_hz"] for m in found["modes"]], BARE_HZ[2:5], rtol=5e-4)
    np.testing.assert_allclose([m["damping_ratio"] for m in found["modes"]], TABLE_3[2:5], rtol=2e-2)


@pytest.mark.skipif(not REAL.exists(), reason=f"no real record at {REAL}")
def test_real_record_agrees_with_its_reference(capsys):
    at = "19.77,21.15,70.5,160.4,235.84,339.63"
    assert run(["damping", str(REAL), "--at", at, "--json", "-"]) == 0
    found = json.loads(capsys.readouterr().out)
    ratios = [100 * m["damping_ratio"] for m in found["modes"]]
    assert ratios[5] == pytest.approx(0.411, rel=0.03)
    np.testing.assert_allclose(ratios[2:5], [0.815, 0.465, 0.174], rtol=0.10)
    for mode in found["modes"][:2]:
        assert mode["half_power"] is None
        assert "lines in its bandwidth" in mode["why"]
    assert any("inverted" in w for w in found["warnings"])


def test_matlab_times_that_are_no_samples_give_no_rate(tmp_path):
    times = np.array([0.0, 0.1, 0.2, 0.9])
    savemat(tmp_path / "a.mat", {"time_s": times, "force_n": times, "acceleration_m_s2": times})
    with pytest.raises(BadInput, match="time_s is not evenly spaced"):
        read_records(tmp_path / "a.mat", Named())


def test_matlab_hits_as_rows_of_a_matrix_are_told_how_they_are_expected(tmp_path):
    rows = {"force_n": np.zeros((3, 64)), "velocity_m_s": np.ones((3, 64)), "sample_rate_hz": RATE}
    savemat(tmp_path / "a.mat", rows)
    with pytest.raises(
        BadInput, match="no vector but force_n 3 x 64, velocity_m_s 3 x 64, expected a vector"
    ):
        read_records(tmp_path / "a.mat", Named())
