"""What identify and diagnose make of tables of modes and of several temperatures: asked, refused, printed."""

import json
import runpy
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import click
import numpy as np
import pytest
from beam_tables import BEAM, LAW, read
from shear_pair_temperatures import T, alone, fitted, shifted

from fitting.errors import OutsideModel
from fitting.identification.result import LawBand
from fitting.mode_tables.build import member_of
from fitting.mode_tables.diagnose import diagnose_modes as diagnose_members
from fitting.mode_tables.problem import ModalProblem
from fitting.mode_tables.standing import standing
from fitting.temperature.simple import Verdict
from instrument.cli import diagnose_modes as diagnosing
from instrument.cli import identify_modes as identifying
from instrument.cli import identify_shifted as shifting
from instrument.cli.output import Output
from instrument.errors import BadInput
from instrument.finding.modal import TablesDiagnosed
from instrument.material.found_law import read_law
from instrument.results import shifted_figures
from instrument.temperatures.shifted import Shifted

TABLE = read(BEAM, 4)
FILE = Path("a.csv")


@pytest.fixture
def questions(monkeypatch):
    """Tables that need no file; which commands asked whether they are of this beam."""
    asked = []
    for command in (diagnosing, identifying):
        monkeypatch.setattr(command, "read_tables", lambda data, specimens, insist: ([TABLE], [BEAM]))
        monkeypatch.setattr(command, "question_modes", lambda tables, fit, data, *_: asked.append(data))
    return asked


# Tables of modes


@pytest.fixture(scope="module")
def diagnosed():
    effects = tuple(e for e in standing([BEAM]) if e.name == "substrate_stiffness")
    found = diagnose_members(ModalProblem.of([member_of(TABLE, BEAM)]), effects, LAW)
    return TablesDiagnosed(found, effects, 0.5, 1.5, ())


def test_a_diagnosis_of_modes_is_told_and_written(capsys, monkeypatch, questions, diagnosed, tmp_path):
    looked_for = []

    def diagnose(tables, specimens, without, progress):
        looked_for.append(set(without))
        return diagnosed

    monkeypatch.setattr(diagnosing, "diagnose_tables", diagnose)
    out = Output(str(tmp_path / "a.json"))
    diagnosing.diagnose_modes(out, [FILE], [Path("beam.toml")], frozenset({"core_law"}), insist=False)
    said = capsys.readouterr().out
    assert "no effect is called for" in " ".join(said.split())
    written = json.loads((tmp_path / "a.json").read_text())
    assert (written["verdict"], written["files"]) == ("none", ["a.csv"])
    assert [m["mode"] for m in written["modes"]] == [1, 2, 3, 4]
    assert looked_for == [{"core_law"}]
    assert questions == [[FILE]]


def test_whoever_insists_is_not_asked_whether_the_modes_are_of_this_beam(
    capsys, monkeypatch, questions, diagnosed
):
    monkeypatch.setattr(diagnosing, "diagnose_tables", lambda *_: diagnosed)
    diagnosing.diagnose_modes(Output(None), [FILE], [], frozenset(), insist=True)
    assert questions == []


@pytest.fixture
def identified(monkeypatch, questions):
    """What was asked of the fit; its result is made by hand, its tables are not printed."""
    asked = []
    fit = SimpleNamespace(uncertainty=SimpleNamespace(chi2_per_dof=1.25))

    def identify(tables, specimens, progress, bare):
        asked.append(bare)
        return SimpleNamespace(fit=fit, odd=None)

    result = SimpleNamespace(
        law_kind="constant",
        parameters={"g_pa": 4e5},
        standard_errors={"g_pa": 1e3},
        modes=("modes",),
        law=("law",),
        formulas=("formulas",),
        warnings=("look at mode 1",),
        as_json=lambda: {"law_kind": "constant"},
    )
    monkeypatch.setattr(identifying, "identify_tables", identify)
    monkeypatch.setattr(identifying, "modal_from", lambda found, tables, names: result)
    monkeypatch.setattr(identifying, "read_modal_table", lambda path: f"bare beam of {path}")
    for name in ("print_modes", "print_modal_law", "print_formulas"):
        monkeypatch.setattr(identifying, name, lambda out, rows, name=name: out.say(f"<{name} {rows[0]}>"))
    return asked


def test_a_law_of_modes_is_told_with_its_errors_modes_and_warnings(capsys, identified, questions):
    identifying.identify_modes(Output(None), [FILE], [Path("beam.toml")])
    lines = [line.split() for line in capsys.readouterr().out.splitlines()]
    assert lines[0] == ["constant", "by", "modes"]
    assert ["g_pa", "400000", "1e+03"] in lines
    said = [" ".join(line) for line in lines]
    order = [
        "<print_modes modes>",
        "<print_modal_law law>",
        "<print_formulas formulas>",
        "note: look at mode 1",
    ]
    assert [said.index(one) for one in order] == sorted(said.index(one) for one in order)
    assert "chi-square per degree of freedom 1.25" in said
    assert identified == [None]
    assert questions == [[FILE]]


def test_the_bare_beam_s_modes_go_along_and_of_a_plate_are_refused(monkeypatch, identified, questions):
    identifying.identify_modes(Output(None), [FILE], [], Path("bare.csv"), insist=True)
    assert identified == ["bare beam of bare.csv"]
    assert questions == []
    plate = SimpleNamespace(kind="plate")
    monkeypatch.setattr(identifying, "read_tables", lambda *_, **__: ([TABLE], [plate]))
    with pytest.raises(click.UsageError, match="--bare with a plate: expected a beam"):
        identifying.identify_modes(Output(None), [FILE], [], Path("bare.csv"))


def test_intervals_of_a_law_of_modes_are_told_where_they_are_asked_for(capsys, questions, tmp_path):
    out = Output(str(tmp_path / "a.json"))
    identifying.identify_modes(out, [FILE], [Path("beam.toml")], profiled=True)
    assert "intervals by profile" in capsys.readouterr().out
    written = json.loads((tmp_path / "a.json").read_text())
    (one,) = written["uncertainty"]
    assert one["method"] == "profile"
    g, eta = one["quantities"][:2]
    assert (g["quantity"], eta["quantity"]) == ("g_pa", "loss_factor")
    half = written["standard_errors"]["g_pa"]
    low, high = g["interval_68_percent"]
    assert g["value"] - low == pytest.approx(half, rel=0.1)
    assert high - g["value"] == pytest.approx(half, rel=0.1)


@pytest.mark.parametrize("command", [diagnosing, identifying])
def test_mode_numbers_that_are_all_one_off_are_asked_about_before_any_fit(monkeypatch, command):
    off = replace(TABLE, mode=TABLE.mode + 1)
    monkeypatch.setattr(command, "read_tables", lambda *_, **__: ([off], [BEAM]))
    monkeypatch.setattr(command, command.__name__.rpartition(".")[2].replace("_modes", "_tables"), None)
    call, more = (
        (diagnosing.diagnose_modes, {"without": frozenset()})
        if command is diagnosing
        else (identifying.identify_modes, {})
    )
    with pytest.raises(BadInput, match=r"a\.csv: mode numbers seem shifted by one"):
        call(Output(None), [FILE], [Path("beam.toml")], insist=False, **more)


# Several temperatures


FILES = [Path(f"{t:g}.csv") for t in T]


def given(zn1, k, *, modes=None, session=False):
    sweep = SimpleNamespace(pickup=None)
    return SimpleNamespace(specimen=zn1, sweep=sweep, temperature_c=float(T[k]), modes=modes, session=session)


@pytest.fixture
def found(monkeypatch):
    """One law over three temperatures, as simple as it is told to be; what was asked of the fit."""
    of = {True: fitted(shifted())[1:], False: fitted(shifted()[::-1])[1:]}
    fit = of[True][0]
    f = np.geomspace(50, 4000, 18)
    G, eta = fit.law.storage_and_loss(2 * np.pi * f)
    band = LawBand(f, G, eta, 0.01 * G, 0.01 * eta)
    asked, told = [], []

    def make(simple=True, softens=True, *, stands=True, otherwise="", cause="", advice=()):
        words = ("one law serves" if simple else "no one law serves") + cause
        verdict = Verdict(simple, 0.4, 1.2, words, advice, law_stands=stands)

        def identify(sweeps, specimens, kind, reference_c, progress, *, vertical, hammer, temperature_k):
            asked.append(([s.name for s in sweeps], kind, reference_c, vertical, hammer))
            told.append(([s.specimen for s in sweeps], specimens))
            fit, each = of[softens]
            return Shifted(fit, verdict, band, alone(each), None, 2.0, otherwise=otherwise)

        monkeypatch.setattr(shifting, "identify_at_temperatures", identify)
        return asked

    make.told = told
    return make


def shift(given_, figures=None, out=None, files=FILES, *, depths=(), insist=False):
    out = out or Output(None)
    asked = SimpleNamespace(
        shift="wlf", reference_c=20.0, figures=figures, vertical=True, temperature_k=None, depths=depths
    )
    shifting.identify_shifted(out, files, given_, asked, insist=insist)


def test_shifts_and_law_are_told_and_written(capsys, zn1, found, tmp_path):
    asked = found()
    shift([given(zn1, k) for k in range(3)], out=Output(str(tmp_path / "a.json")))
    assert asked == [(["10.csv", "20.csv", "30.csv"], "wlf", 20.0, True, None)]
    said = capsys.readouterr().out
    rows = {line.split()[0]: line.split()[1:] for line in said.splitlines() if line.strip()}
    assert rows["20.csv"] == ["20", "+0.0000", "0.0000", "1"]
    assert float(rows["10.csv"][1]) == pytest.approx(1.5 / np.log(10), abs=0.01)
    assert "one law serves" in said
    written = json.loads((tmp_path / "a.json").read_text())
    assert [one["name"] for one in written["temperatures"]] == ["10.csv", "20.csv", "30.csv"]
    assert written["simple"] is True
    assert "uncertainty" not in written


def test_intervals_of_a_shifted_law_are_told_over_its_reduced_frequencies(capsys, zn1, found, tmp_path):
    found()
    out = Output(str(tmp_path / "a.json"))
    shift([given(zn1, k) for k in range(3)], out=out, depths=("profile",))
    assert "intervals by profile" in capsys.readouterr().out
    (one,) = json.loads((tmp_path / "a.json").read_text())["uncertainty"]
    quantities = [q["quantity"] for q in one["quantities"]]
    assert "storage_modulus_pa at 50 Hz" in quantities
    assert quantities[-1] == "loss_factor at 4000 Hz"
    assert all(q["interval_95_percent"][0] < q["value"] for q in one["quantities"])


def test_a_core_that_stiffens_as_it_warms_is_asked_about_unless_someone_insists(capsys, zn1, found):
    found(softens=False)
    with pytest.raises(BadInput, match=r"20 degC is above that of 10 .* are temperatures exchanged"):
        shift([given(zn1, k) for k in range(3)])
    assert not capsys.readouterr().out
    shift([given(zn1, k) for k in range(3)], insist=True)
    assert "no polymer stiffens as it warms" in " ".join(capsys.readouterr().out.split())


def test_columns_that_fit_in_another_unit_are_asked_about_unless_someone_insists(capsys, zn1, found):
    found(simple=None, stands=False, otherwise="loss_factor holds damping ratios: is it so?")
    with pytest.raises(BadInput, match="loss_factor holds damping ratios: is it so"):
        shift([given(zn1, k) for k in range(3)])
    shift([given(zn1, k) for k in range(3)], insist=True)
    assert "no one law serves" in " ".join(capsys.readouterr().out.split())


def test_a_law_that_nothing_explains_is_printed_as_not_to_be_used(capsys, zn1, found, tmp_path):
    found(simple=None, stands=False)
    shift([given(zn1, k) for k in range(3)], out=Output(str(tmp_path / "a.json")))
    assert "the law at 20 degC, +- one standard error (not to be used, see below)" in " ".join(
        capsys.readouterr().out.split()
    )
    warned = json.loads((tmp_path / "a.json").read_text())["warnings"]
    assert "this one is not to be used" in warned[0]


def test_figures_are_said_to_be_saved_after_the_results(capsys, monkeypatch, zn1, found, tmp_path):
    found(simple=None, stands=False)
    monkeypatch.setattr(shifted_figures, "save_shifted_figures", lambda found, folder: [folder / "n.png"])
    shift([given(zn1, k) for k in range(3)], tmp_path, Output(None))
    said = capsys.readouterr().out
    assert 0 < said.index("the law at 20 degC") < said.index("saved ")


def test_a_law_that_is_not_simple_is_refused_after_its_figures_and_json_are_written(
    capsys, monkeypatch, zn1, found, tmp_path
):
    found(simple=False, cause=": plate; clamp", advice=("try --shift free",))
    saved = [tmp_path / "nomogram.png"]
    monkeypatch.setattr(shifted_figures, "save_shifted_figures", lambda found, folder: saved)
    out = Output(str(tmp_path / "a.json"))
    with pytest.raises(OutsideModel, match=r"^no one law serves: plate; clamp$"):
        shift([given(zn1, k) for k in range(3)], tmp_path, out)
    said = capsys.readouterr().out
    assert f"saved {saved[0]}" in "".join(said.splitlines())
    notes = [line for line in said.splitlines() if line.startswith("note: ")]
    assert notes[0] == "note: try --shift free"
    assert notes[1].startswith("note: the specimen is taken to have stayed where it was")
    written = json.loads((tmp_path / "a.json").read_text())
    assert (written["simple"], written["words"]) == (
        False,
        "no one law serves: plate; clamp; try --shift free",
    )
    assert "one law for all temperatures is refused" in written["doubts"][0]
    with pytest.raises(BadInput, match=r"a\.json: one law for all its temperatures was refused"):
        read_law(tmp_path / "a.json")


def test_the_first_file_s_hammer_test_is_that_of_all_and_of_sessions_that_is_said(capsys, zn1, found):
    asked = found()
    shift([given(zn1, 0), given(zn1, 1, modes="modes", session=True), given(zn1, 2, modes="others")])
    assert asked[-1][-1] == "modes"
    assert "the hammer test is that of 20.csv" in capsys.readouterr().out
    shift([given(zn1, 0, modes="modes"), given(zn1, 1), given(zn1, 2)])
    assert "the hammer test is that of" not in capsys.readouterr().out


def test_sweeps_that_make_no_shift_are_refused(zn1, found):
    found()
    with pytest.raises(click.UsageError, match="--shift: 1 file, expected sweeps at two temperatures"):
        shift([given(zn1, 0)], files=FILES[:1])
    longer = replace(zn1, length_m=1.01 * zn1.length_m)
    others = [given(zn1, 0, modes="modes"), given(longer, 1), given(zn1, 2)]
    with pytest.raises(BadInput, match="a hammer test with several plates, expected one plate"):
        shift(others)
    roving = given(zn1, 1)
    roving.sweep = SimpleNamespace(pickup=np.array([0, 1]))
    with pytest.raises(BadInput, match=r"20\.csv: rows of several pickups with --shift"):
        shift([given(zn1, 0), roving, given(zn1, 2)])
    cold = given(zn1, 1)
    cold.temperature_c = None
    with pytest.raises(BadInput, match=r"20\.csv: no temperature, expected a column temperature_c"):
        shift([given(zn1, 0), cold, given(zn1, 2)])


def test_a_specimen_stays_one_whatever_law_its_file_begins_with_and_another_is_another(zn1, found):
    found()
    longer = replace(zn1, length_m=1.01 * zn1.length_m)
    shift([given(zn1, 0), given(zn1.with_law(LAW), 1), given(longer, 2)])
    assert found.told[-1] == ([1, 1, 2], [zn1, longer])
    shift([given(BEAM, k) for k in range(3)])
    assert found.told[-1] == ([1, 1, 1], [BEAM])


# Without its script


def test_the_module_is_the_command(monkeypatch):
    called = []
    monkeypatch.setattr("instrument.cli.main.main", lambda: called.append("main"))
    runpy.run_module("instrument.cli.__main__", run_name="__main__")
    assert called == ["main"]
