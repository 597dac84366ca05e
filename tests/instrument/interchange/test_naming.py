"""Names that somebody gives to the columns and arrays of a file."""

import numpy as np
import pytest
from scipy.io import savemat

from instrument.cli.main import run
from instrument.errors import BadInput
from instrument.files.impact_csv import read_impact_csv
from instrument.files.sweep_file import read_sweep
from instrument.interchange.importing import import_file
from instrument.interchange.naming import Naming

F = np.linspace(20.0, 30.0, 11)
H = np.exp(0.3j * F) / F


def test_in_order_or_by_their_own_names():
    assert Naming.of("Frequency [Hz], -,FRF [(m/s)/g]").in_order == ("Frequency [Hz]", "-", "FRF [(m/s)/g]")
    assert Naming.of("f=Frequency [Hz],H = FRF [g/N]").by_own == {"f": "Frequency [Hz]", "H": "FRF [g/N]"}


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("f=Frequency,H", "'H', expected OWN=NAME"),
        ("f=", "'f=', expected"),
        ("f=a,f=b", "f twice"),
        ("f=a,g=a", "a twice"),
    ],
)
def test_both_at_once_are_refused(text, said):
    with pytest.raises(BadInput, match=said):
        Naming.of(text)


def test_arrays_of_matlab_are_what_they_are_said_to_be(tmp_path, capsys):
    savemat(tmp_path / "a.mat", {"f": F, "H": H})
    out = tmp_path / "a.csv"
    names = "f=Frequency [Hz],H=FRF [(m/s)/(m/s^2)]"
    assert run(["import", str(tmp_path / "a.mat"), "--out", str(out)]) == 2
    assert "names what is called f and H" in capsys.readouterr().err
    assert run(["import", str(tmp_path / "a.mat"), "--columns", names, "--out", str(out)]) == 0
    read = read_sweep(out).columns
    over_base = read["velocity_re_m_s"] + 1j * read["velocity_im_m_s"]
    np.testing.assert_allclose(over_base / read["base_accel_re_m_s2"], H)


def test_they_may_stand_in_structs(tmp_path):
    savemat(tmp_path / "a.mat", {"run1": {"freq": F, "H": H}, "note": "x"})
    import_file(tmp_path / "a.mat", tmp_path / "a.csv", Naming.of("H=FRF [g/N]"))
    assert (tmp_path / "a.csv").read_text().splitlines()[1].startswith("frequency_hz,accelerance_re")


def test_one_that_is_not_there_is_refused_with_those_that_are(tmp_path):
    savemat(tmp_path / "a.mat", {"f": F, "H": H})
    with pytest.raises(BadInput, match=r"a\.mat: no G as --columns has it, found f, H"):
        import_file(tmp_path / "a.mat", tmp_path / "a.csv", Naming.of("G=FRF [g/N]"))


def test_arrays_are_in_no_order(tmp_path):
    savemat(tmp_path / "a.mat", {"f": F, "H": H})
    with pytest.raises(BadInput, match="in no order, expected OWN=NAME"):
        import_file(tmp_path / "a.mat", tmp_path / "a.csv", Naming.of("Frequency [Hz],FRF [g/N]"))


def test_some_of_a_text_are_named_and_the_others_kept(tmp_path):
    t = np.arange(8) / 1000
    rows = "".join(f"{a},{b},{b / 2}\n" for a, b in zip(t, np.sin(t * 300), strict=True))
    (tmp_path / "a.txt").write_text("Time [s],Ch1,Ch2\n" + rows)
    import_file(tmp_path / "a.txt", tmp_path / "a.csv", Naming.of("Ch1=Force [N],Ch2=Acceleration [g]"))
    (hit,) = read_impact_csv(tmp_path / "a.csv")
    np.testing.assert_allclose(hit.force_n, np.sin(t * 300))


def test_a_column_is_passed_over_by_a_dash(tmp_path):
    rows = "".join(f"{f},{h.real},1,{h.imag},2\n" for f, h in zip(F, H, strict=True))
    (tmp_path / "a.txt").write_text(rows)
    import_file(tmp_path / "a.txt", tmp_path / "a.csv", Naming.of("f [Hz],v re [m/s],-,v im [m/s],-"))
    np.testing.assert_allclose(read_sweep(tmp_path / "a.csv").columns["velocity_im_m_s"], H.imag)
    savemat(tmp_path / "a.mat", {"f": F, "frf_g_per_n": H, "a": F, "b": F})
    import_file(tmp_path / "a.mat", tmp_path / "b.csv", Naming.of("a=-,b=-"))


def test_two_arrays_do_not_get_one_name(tmp_path):
    savemat(tmp_path / "a.mat", {"f": F, "H": H})
    with pytest.raises(BadInput, match="H would be a second f"):
        import_file(tmp_path / "a.mat", tmp_path / "a.csv", Naming.of("H=f"))


@pytest.mark.parametrize("names", ["Frequency [Hz],FRF real [km],FRF imag [km]", "a,b,c"])
def test_whoever_names_columns_is_not_told_to(tmp_path, names):
    (tmp_path / "a.csv").write_text("x,y,z\n10,1,2\n11,1,2\n")
    for naming, is_told in ((None, True), (Naming.of(names), False)):
        with pytest.raises(BadInput) as refused:
            import_file(tmp_path / "a.csv", tmp_path / "b.csv", naming)
        assert ("--columns" in str(refused.value)) == is_told
