"""Tables in other programs' texts: where they begin, what their columns are called, and what is refused."""

from pathlib import Path

import numpy as np
import pytest

from fitting.gravity import STANDARD_GRAVITY_M_S2
from instrument.cli.main import run
from instrument.errors import BadInput
from instrument.files.sweep_file import read_sweep
from instrument.interchange.naming import Naming
from instrument.interchange.read_csv import read_csv
from instrument.interchange.readers import read_foreign
from instrument.interchange.text_table import find_table, is_number, number_of

F = np.array([15.0, 18.5, 20.0, 41.25])
H = np.array([0.02 - 0.001j, 0.04 - 0.03j, -0.03 - 0.07j, -0.007 + 0.003j])
NAMES, UNITS = ["Frequency", "Real", "Imaginary"], ["Hz", "(m/s)/(m/s²)", "(m/s)/(m/s²)"]


def rows(separator="\t", point=".", columns=(F, H.real, H.imag)):
    return "".join(
        separator.join(f"{x:.9e}".replace(".", point) for x in row) + "\n"
        for row in zip(*columns, strict=True)
    )


def line(cells, separator="\t", around="{}"):
    return separator.join(around.format(cell) for cell in cells) + "\n"


POLYTEC = "FFT\nSource File Name:\tD:\\a.svd\nPoint Index:\t1\nSignal:\tVib & Ref1 H1\n\n"
TESTLAB = "Function class\tFRF\nPoint id\tPlate:1\nX axis unit\tHz\nY axis unit\t(m/s)/(m/s^2)\n"
SIGNALCALC = '"SignalCalc","ACE"\n"X Units","Hz"\n"Y Units","(m/s)/(m/s^2)"\n'
MESCOPE = "ME'scope Data Block\nUnits,Hz,(m/s)/(m/s^2)\n"
PULSE = (
    "Header Size:\t6\nVersion:\tPULSE\nData Type:\tComplex\nX-Axis size:\t4\nX-Axis unit:\tHz\n"
    "AmplitudeUnit:\t(m/s)/(m/s²)\n\n"
)
TEXTS = {
    "Polytec": POLYTEC + line(NAMES) + line(UNITS, around="[ {} ]") + rows(),
    "m+p": "SO Analyzer\nMeasurement;Run 3\n\n"
    + line([f"{name} [{unit}]" for name, unit in zip(NAMES, UNITS, strict=True)], ";")
    + rows(";", ","),
    "Data Physics": SIGNALCALC + line(['"Freq (Hz)"', '"Real"', '"Imag"'], ",") + rows(","),
    "ME'scope": MESCOPE + "X-Axis (Hz),M#1 Real ((m/s)/(m/s^2)),M#1 Imag ((m/s)/(m/s^2))\n" + rows(","),
    "PULSE": PULSE
    + "".join(
        f"{n}\t{f:.9e}\t{h.real:.9e}\t{h.imag:.9e}\n" for n, (f, h) in enumerate(zip(F, H, strict=True), 1)
    ),
    "BK Connect": "Title;FRF H1\nReference;Base\n\n"
    + line(["X", "Real", "Imag"], ";")
    + line(UNITS, ";")
    + rows(";"),
    "Test.Lab, units above": TESTLAB + line(UNITS) + line(["X", "Real", "Imag"]) + rows(point=","),
    "Test.Lab, units in its head": TESTLAB + line(["Linear", "Real", "Imag"]) + rows(),
    "Excel's first line": "sep=;\n" + line(["Frequency [Hz]", "FRF re [s]", "FRF im [s]"], ";") + rows(";"),
    "numpy.savetxt": "# Frequency (Hz), FRF re (s), FRF im (s)\n" + rows(","),
    "a comment below the names": "frequency_hz,H_re [s],H_im [s]\n# calibrated in May\n" + rows(","),
    "Fortran": "   FREQ[HZ]   FRF_RE[S]     FRF_IM[S]\n" + rows("   ").replace("e", "D"),
    "blanks in names": "Frequency [Hz]   FRF re [s]   FRF im [s]\n" + rows("   "),
    "empty last column": line(["Frequency [Hz]", "FRF re [s]", "FRF im [s]"], ",")
    + rows(",").replace("\n", ",\n"),
    "German": line(["Frequenz [Hz]", "FRF Realteil [s]", "FRF Imaginärteil [s]"], ";") + rows(";", ","),
    "complex": "Frequency [Hz],H [s]\n"
    + "".join(f"{f},{h.real}{h.imag:+}i\n" for f, h in zip(F, H, strict=True)),
    "dB": "FREQ (HZ),FRF MAG (dB re 1 (m/s)/(m/s^2)),FRF PHASE (DEG)\n"
    + rows(",", columns=(F, 20 * np.log10(np.abs(H)), np.angle(H, deg=True) - 720)),
    "dB of a thousandth": "f [Hz],H mag [dB re 1e-3 (m/s)/(m/s^2)],H phase [rad]\n"
    + rows(",", columns=(F, 20 * np.log10(1e3 * np.abs(H)), np.angle(H))),
    "parts twice": "f [Hz],H re [s],H im [s],H mag [s],H phase [deg]\n"
    + rows(",", columns=(F, H.real, H.imag, np.abs(H), np.angle(H, deg=True))),
}


@pytest.mark.parametrize("maker", TEXTS)
def test_a_response_is_the_same_from_any_program(tmp_path, maker):
    (tmp_path / "a.txt").write_text(TEXTS[maker], encoding="cp1252")
    (sweep,) = read_csv(tmp_path / "a.txt").sweeps
    np.testing.assert_allclose(sweep["frequency_hz"], F)
    ratio = (sweep["velocity_re_m_s"] + 1j * sweep["velocity_im_m_s"]) / sweep["base_accel_re_m_s2"]
    np.testing.assert_allclose(ratio, H, rtol=1e-6)


def test_what_stands_above_the_names_is_said_to_be_passed_over(tmp_path):
    (tmp_path / "a.txt").write_text(TEXTS["Polytec"], encoding="cp1252")
    assert "names in line 6, 4 lines above it passed over" in read_csv(tmp_path / "a.txt").said[0]
    (tmp_path / "b.csv").write_text("sep=;\nf [Hz];v [m/s]\n20;0,1\n30;0,2\n")
    assert "names in line 2, the line above it passed over" in read_csv(tmp_path / "b.csv").said[0]


TABLE = "Frequency [Hz],FRF re [s],FRF im [s]\n" + rows(",")
REFUSED = {
    "no names": (
        rows(","),
        "no line of names above the numbers in line 1, expected one, or --columns with 3",
    ),
    "two tables": (TEXTS["Polytec"] * 2, "'FFT' below the table that begins in line 8, expected one table"),
    "a table above another": ("1,2,3\n" + TABLE, "line 1: 3 columns of numbers above the table"),
    "a footer": (TABLE + "End of data\n", "'End of data' below the table"),
    "a column in one row": (TABLE.replace("\n4.125", "\n7,4.125"), "4 columns, expected 3"),
    "a column in a row amid others": (
        TABLE.replace("\n1.85", "\n7,1.85"),
        "line 3: 4 columns, expected 3 as in line 2 and in line 4",
    ),
    "a spreadsheet's error in a first cell": (
        TABLE.replace("\n1.85", "\n#N/A,,\n1.85"),
        r"line \d+: '#N/A, , ' among rows of numbers",
    ),
    "an overload in the place of a row": (
        TABLE.replace("\n1.85", "\nOVERLOAD,,\n1.85"),
        r"line \d+: 'OVERLOAD, , ' among rows of numbers",
    ),
    "a value in a column without a name": (
        TABLE.replace("\n", ",\n").replace("e-03,\n", "e-03,5\n"),
        "4 columns, expected 3",
    ),
    "a name twice": ("Frequency [Hz],Real [s],Real [s]\n" + rows(","), "column Real .s. twice.*--columns"),
    "per volt": (
        POLYTEC + line(NAMES) + line(["Hz", "m/s / V", "m/s / V"]) + rows(),
        "Real .m/s / V.*--columns",
    ),
    "dB of what": ("f [Hz],MAG (DB),PHASE (DEG)\n" + rows(","), "dB of what.*--columns"),
    "dB of a part": ("f [Hz],H re [dB re 1 m/N],H im [dB re 1 m/N]\n" + rows(","), "dB of a part"),
    "parts that contradict": (
        "f [Hz],H re [s],H im [s],H mag [s],H phase [deg]\n"
        + rows(",", columns=(F, H.real, H.imag, np.abs(H), -np.angle(H, deg=True))),
        "are not those of real and imaginary part",
    ),
    "no units": ("Frequency,Real,Imag\n" + rows(","), "units in the names.*--columns"),
    "an infinite cell": (
        "f [Hz],v re [m/s],v im [m/s]\n20,0.1,1\n# a break\n\n30,1,inf\n",
        r"line 5: v im \[m/s\] = inf, expected a finite number",
    ),
    "a cell that is no number": (
        "f [Hz],v re [m/s],v im [m/s]\n20,0.1,1\n30,nan,1\n",
        r"line 3: v re \[m/s\] = nan, expected a finite number",
    ),
    "a number that is too large": (
        "f [Hz],v [m/s]\n20,0.1\n30,2e31\n",
        r"line 3: velocity_m_s = 2e\+31, expected nothing beyond 1e\+30 in size",
    ),
    "words": ("a,b\nx,y\n", "no rows of numbers"),
}


@pytest.mark.parametrize("what", REFUSED)
def test_what_is_in_doubt_is_asked_about(tmp_path, what):
    text, said = REFUSED[what]
    (tmp_path / "a.csv").write_text(text)
    with pytest.raises(BadInput, match=said):
        read_foreign(tmp_path / "a.csv")


def test_columns_say_what_a_file_does_not(tmp_path, capsys):
    (tmp_path / "a.dat").write_text(POLYTEC + rows(columns=(F, H.real, H.imag, H.real)))
    out = tmp_path / "b.csv"
    names = "Frequency [Hz],Velocity re [mm/s],Velocity im [mm/s],-"
    assert run(["import", str(tmp_path / "a.dat"), "--columns", names, "--out", str(out)]) == 0
    np.testing.assert_allclose(read_sweep(out).columns["velocity_im_m_s"], 1e-3 * H.imag)
    assert run(["import", str(tmp_path / "a.dat"), "--columns", "f,v", "--out", str(out)]) == 2
    assert "4 columns, expected 2" in capsys.readouterr().err


def test_columns_are_those_of_a_text(tmp_path, capsys):
    (tmp_path / "a.uff").write_text("x")
    assert run(["import", str(tmp_path / "a.uff"), "--columns", "f,v"]) == 2
    assert "--columns is of arrays with names" in capsys.readouterr().err


def test_a_number_is_one_number():
    assert number_of("1,5D-3", comma=True) == 1.5e-3
    assert number_of("1.5-2e-1j", comma=False) == 1.5 - 0.2j
    assert not any(is_number(text, comma=False) for text in ("1,5", "1.2.3", "1e", "", "12V", "1_0"))


def test_the_separator_is_that_of_the_rows():
    table = find_table(Path("a"), "a; b\n1,5 2,5\n2,5 3,5\n".replace("; ", " "), None)
    assert (table.separator, table.names, table.rows[0]) == ("", ["a", "b"], (2, ["1,5", "2,5"]))


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (
            "Frequency [Hz];v [mm/s]\n999;1\n1.000;2\n1.001;3\n",
            "line 3: Frequency .Hz. = '1.000' beside whole",
        ),
        (
            'Frequency [Hz],v [mm/s]\n"20,5","1,25"\n"21,5","2,25"\n',
            "line 2: '20,5' where commas are between",
        ),
    ],
    ids=["a mark between thousands", "decimal commas between commas"],
)
def test_a_mark_that_may_not_be_a_decimal_one_is_asked_about(tmp_path, text, said):
    (tmp_path / "a.csv").write_text(text, encoding="utf-8")
    with pytest.raises(BadInput, match=said):
        read_csv(tmp_path / "a.csv")


def test_whole_numbers_beside_fractions_are_no_thousands(tmp_path):
    (tmp_path / "a.csv").write_text("Frequency [Hz];v [mm/s]\n100;1\n100,125;2\n100,25;0,125\n")
    (columns,) = read_csv(tmp_path / "a.csv").sweeps
    assert columns["frequency_hz"].tolist() == [100.0, 100.125, 100.25]


def test_a_typeset_minus_is_one(tmp_path):
    text = "Frequency [Hz],v re [m/s],v im [m/s]\n20,1,\N{MINUS SIGN}2\n21,2,\N{MINUS SIGN}3\n"
    (tmp_path / "a.csv").write_text(text, encoding="utf-8")
    (columns,) = read_csv(tmp_path / "a.csv").sweeps
    assert columns["velocity_im_m_s"].tolist() == [-2.0, -3.0]


def test_names_given_for_another_number_of_columns_are_refused(tmp_path):
    (tmp_path / "a.csv").write_text("20,1,2\n21,2,3\n")
    with pytest.raises(BadInput, match="line 1: 3 columns, expected 2 as --columns has names"):
        read_csv(tmp_path / "a.csv", Naming.of("Frequency [Hz],v [m/s]"))


def test_units_behind_their_names_without_brackets(tmp_path):
    (tmp_path / "a.txt").write_bytes(
        "Function;FRF plate:1 (1,2 µm)\n\nLinear Hz;Real (m/s)/g;Imaginary (m/s)/g\n"
        "20,5;0,5;-0,25\n21,5;1,0;0,5\n".encode("cp1252")
    )
    assert run(["import", str(tmp_path / "a.txt"), "--out", str(tmp_path / "a.csv")]) == 0
    sweep = read_sweep(tmp_path / "a.csv").sweep(1.0)
    np.testing.assert_array_equal(sweep.frequency_hz, [20.5, 21.5])
    over_base = sweep.velocity_m_s / sweep.base_m_s2
    np.testing.assert_allclose(over_base, np.array([0.5 - 0.25j, 1.0 + 0.5j]) / STANDARD_GRAVITY_M_S2)
