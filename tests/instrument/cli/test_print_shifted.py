"""One law over several temperatures, printed."""

import pytest

from instrument.cli.output import Output
from instrument.cli.print_shifted import print_shifted
from instrument.facts.rows import LawRow
from instrument.facts.shifted import ModeAt, ShiftAt, ShiftedResult

LAW = tuple(
    LawRow(
        frequency_hz=f,
        storage_modulus_pa=4e5,
        loss_factor=0.3,
        storage_modulus_standard_error_pa=1e3,
        loss_factor_standard_error=0.01,
    )
    for f in (10.0, 100.0)
)


def at(name, t, log10, rms=None):
    return ShiftAt(
        name=name,
        temperature_c=t,
        log10_shift=log10,
        log10_shift_standard_error=0.01,
        vertical=1.0,
        vertical_standard_error=0.0,
        rms_percent=rms,
    )


def result(temperatures, shift="wlf", modes=()):
    return ShiftedResult(
        shift=shift,
        reference_c=20.0,
        shift_parameters={"c1": 9.0, "c2_k": 120.0},
        shift_standard_errors={"c1": 0.5, "c2_k": 4.0},
        temperatures=temperatures,
        law_kind="constant",
        parameters={"g_pa": 4e5, "eta": 0.3},
        standard_errors={"g_pa": 1e3, "eta": 0.01},
        law=LAW,
        simple=True,
        p_value=0.5,
        chi2=10.0,
        chi2_each_alone=9.0,
        wicket_percent=1.0,
        modes=modes,
        words="one law serves",
        warnings=("look",),
        seconds=1.0,
    )


def lines(capsys, *of, **said):
    print_shifted(Output(None), result(*of, **said), law_stands=True)
    return [" ".join(line.split()) for line in capsys.readouterr().out.splitlines()]


def test_the_law_s_parameters_and_the_shift_s_are_printed_with_their_standard_errors(capsys):
    said = lines(capsys, (at("10.csv", 10.0, 0.7), at("20.csv", 20.0, 0.0)))
    assert "constant at 20 degC" in said
    assert "g_pa 400000 1e+03" in said
    assert "eta 0.300 0.01" in said
    assert "shift: wlf" in said
    assert "c2_k 120.0 4" in said
    assert said[-2:] == ["one law serves", "note: look"]


def test_sweeps_have_a_line_a_file_with_the_decimal_logarithm_and_what_the_law_leaves(capsys):
    said = lines(
        capsys, (at("a.csv", 10.0, 0.7, 1.25), at("b.csv", 10.0, 0.7, 2.5), at("c.csv", 20.0, 0.0, 3.0))
    )
    columns = "file temperature/degC log10 a_T standard error b_T difference rms/%"
    assert columns in said
    assert "a.csv 10 +0.7000 0.0100 1 1.25" in said
    assert "b.csv 10 +0.7000 0.0100 1 2.5" in said


def test_tables_have_a_line_a_temperature_from_cold_to_warm_and_all_their_modes(capsys):
    modes = tuple(
        ModeAt(
            name="a.csv",
            temperature_c=t,
            mode=2,
            frequency_hz=100.0,
            predicted_hz=101.0,
            loss_factor=0.1,
            predicted_loss_factor=0.11,
        )
        for t in (20.0, 10.0)
    )
    said = lines(
        capsys, (at("a.csv", 20.0, 0.0), at("a.csv", 10.0, 0.7), at("b.csv", 10.0, 0.7)), modes=modes
    )
    first = said.index("a.csv and 1 more 10 +0.7000 0.0100 1")
    assert said[first + 1] == "a.csv 20 +0.0000 0.0100 1"
    assert "a.csv 20 2 100 101 0.1 0.11" in said


def test_free_factors_are_told_once(capsys):
    said = lines(capsys, (at("10.csv", 10.0, 0.7), at("20.csv", 20.0, 0.0)), shift="free")
    assert not any(line.startswith("shift: ") for line in said)
    assert "10.csv 10 +0.7000 0.0100 1" in said


@pytest.mark.parametrize("which", ["constant at 20 degC", "the law at 20 degC, +- one standard error"])
def test_a_law_that_does_not_stand_is_called_so_wherever_it_is_printed(capsys, which):
    print_shifted(Output(None), result((at("10.csv", 10.0, 0.7),)), law_stands=False)
    assert f"{which} (not to be used, see below)" in capsys.readouterr().out
