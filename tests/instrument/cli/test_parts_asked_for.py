"""Which parts of an experiment a command runs, what ends or holds it, what is refused beforehand."""

import signal
from pathlib import Path

import click
import pytest
from click.testing import CliRunner

from instrument.cli.batch import batch
from instrument.cli.card import card
from instrument.cli.check import check
from instrument.cli.compare import compare
from instrument.cli.damping import damping
from instrument.cli.demo import demo
from instrument.cli.export import export
from instrument.cli.hammer import hammer
from instrument.cli.identify import identify
from instrument.cli.import_ import import_
from instrument.cli.new import new
from instrument.cli.plan import plan
from instrument.cli.predict import predict
from instrument.cli.reading import are_tables, read_each, read_tables
from instrument.cli.recover import recover
from instrument.cli.replay import replay
from instrument.cli.report import report
from instrument.cli.run import run
from instrument.cli.simulate import simulate
from instrument.cli.stopping import safe_stop
from instrument.cli.sweep import sweep
from instrument.errors import BadInput, RigStopped
from instrument.run.control import RunControl
from instrument.session.storage import SessionFile

MODES = "mode,frequency_hz,loss_factor\n1,20,0.1\n"


def said(command, *arguments):
    """The status, and the last line of what a command says against these."""
    result = CliRunner().invoke(command, list(map(str, arguments)))
    if isinstance(result.exception, BadInput):
        return 2, str(result.exception)
    return result.exit_code, result.output.splitlines()[-1]


@pytest.mark.parametrize(
    ("command", "arguments", "why"),
    [
        (batch, ("a.csv", "--workers", 2, "--scheduler", "tcp://h:1"), "--workers and --scheduler exclude"),
        (batch, ("batch.csv",), "batch.csv: both given and to be written"),
        (card, ("a.json", "--to", "csv", "--out", "nowhere/card.csv"), "no such folder to write to"),
        (
            card,
            ("a.json", "--to", "ansys", "--out", "a.csv"),
            "'.csv', expected .mac or .inp or .dat or .txt",
        ),
        (check, ("none.toml",), "1 fault, nothing can be run"),
        (compare, ("a.h5",), "a.h5: one file, expected two or more"),
        (compare, ("a.h5", "b.h5", "--remounts", "--spread"), "--remounts finds the repeatability"),
        (compare, ("a.h5", "./a.h5"), "a.h5: named twice"),
        (compare, ("a.h5", "b.h5", "--repeatability", "nan"), "'nan' is not a number"),
        (damping, ("a.csv", "--band", "20-40"), "'20-40', expected LOW:HIGH in Hz"),
        (damping, ("a.csv", "--band", "40:20"), "expected LOW below HIGH"),
        (damping, ("a.csv", "--at", "20,-3"), "expected frequencies above 0 Hz"),
        (damping, ("a.csv", "--at", "20 Hz"), "expected F1,F2,... in Hz"),
        (damping, ("a.csv", "--rate", "1e9"), "--rate 1e+09, expected samples a second below 1e+08"),
        (
            run,
            ("a.toml", "--out", "x", "--resume", "y/b.running"),
            "--out x with --resume: the session stays",
        ),
        (
            sweep,
            ("a.toml", "--out", "x", "--resume", "y/b.running"),
            "--out x with --resume: the session stays",
        ),
        (demo, ("--seed", -1), "-1 is not in the range"),
        (export, ("a.h5", "--to", "xls"), "'xls' is not one of"),
        (export, ("none.h5", "--to", "mat"), "none.h5: no such file"),
        (identify, ("a.csv", "--pointwise", "--method", "paper"), "expected the direct method"),
        (identify, ("a.csv", "--vertical"), "expected --shift with them"),
        (identify, ("a.csv", "--figures", "here"), "expected --pointwise, --with or --shift"),
        (identify, ("a.csv", "--bare", "b.csv"), "--bare: expected a table of modes of a beam"),
        (identify, ("a.h5", "--hammer", "h.json", "--no-hammer"), "--hammer and --no-hammer exclude"),
        (import_, ("none.uff",), "none.uff: no such file"),
        (new, ("sandwich",), "'sandwich' is not one of"),
        (plan, ("a.toml", "--band", "20:20.5"), "at least 5 % apart"),
        (plan, ("a.toml", "--band", "20"), "'20', expected LOW:HIGH in Hz"),
        (predict, ("a", "--frequencies", 20, "--real-modes", "--fit", "f"), "expected one of them"),
        (recover, ("none",), "none: no such folder"),
        (replay, ("a.h5", "--speed", 0), "0.0 is not in the range"),
        (replay, ("a.h5", "--speed", "nan"), "'nan' is not a number"),
        (report, ("a.h5", "--out", "a.doc"), "a.doc: ending '.doc', expected .html or .htm or .pdf or .png"),
        (report, ("a.h5", "--pdf", "a.html"), "a.html: ending '.html', expected .pdf"),
        (report, ("a.h5", "--out", "nowhere/a.pdf"), "no such folder to write to"),
        (simulate, ("a.toml", "--modbus-port", 70000), "70000 is not in the range"),
    ],
)
def test_what_cannot_be_meant_is_refused_with_a_reason_before_anything_is_made(
    command, arguments, why, tmp_path, monkeypatch
):
    monkeypatch.chdir(tmp_path)
    status, line = said(command, *arguments)
    assert status == 2
    assert why in line
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("command", "parts"), [(hammer, ("hammer",)), (sweep, ("sweep",)), (run, ("hammer", "sweep"))]
)
def test_a_command_runs_its_own_parts_of_an_experiment(command, parts, monkeypatch, tmp_path):
    asked = []
    monkeypatch.setattr(
        f"instrument.cli.{command.name}.run_parts", lambda *given, insist: asked.append((*given, insist))
    )
    words = ["a.toml", "--out", str(tmp_path), "--resume", "b.running", "--json", "-"]
    assert CliRunner().invoke(command, words).exit_code == 0
    ((path, out, resume, json_path, given, insist),) = asked
    assert (path.name, out, resume.name, json_path, insist) == ("a.toml", tmp_path, "b.running", "-", False)
    assert given == parts


def test_a_table_of_modes_needs_its_specimen_and_no_other_data(tmp_path):
    modes, other = tmp_path / "modes.csv", tmp_path / "sweep.csv"
    modes.write_text(MODES)
    other.write_text("frequency_hz,velocity_m_s\n20,1\n")
    assert are_tables([modes, modes], [tmp_path / "a.toml"]) is True
    assert are_tables([other], []) is False
    with pytest.raises(click.UsageError, match="beside other data"):
        are_tables([modes, other], [tmp_path / "a.toml"])
    with pytest.raises(click.UsageError, match="does not say whose they are"):
        are_tables([modes], [])


def test_specimens_are_one_for_all_files_or_one_for_each(tmp_path):
    files, two = [tmp_path / f"{k}.csv" for k in range(3)], [tmp_path / "a.toml", tmp_path / "b.toml"]
    with pytest.raises(click.UsageError, match="2 times --specimen for 3 tables"):
        read_tables(files, two, insist=False)
    with pytest.raises(click.UsageError, match="2 times --specimen for 3 files"):
        read_each(None, files, two, None, no_hammer=False, insist=False)
    with pytest.raises(click.UsageError, match="--hammer with several files"):
        read_each(None, files, two[:1], tmp_path / "h.json", no_hammer=False, insist=False)


def raise_and_clean_up(number):
    """A second one does not break off the cleaning up."""
    try:
        signal.raise_signal(number)
    finally:
        signal.raise_signal(signal.SIGTERM)


@pytest.mark.parametrize(("name", "why"), [("SIGTERM", "terminated"), ("SIGHUP", "the terminal was closed")])
def test_a_terminated_command_stops_the_rig_once_and_the_signals_are_as_before(name, why):
    numbers = [signal.Signals[n] for n in ("SIGTERM", "SIGHUP", "SIGTSTP")]
    before = [signal.getsignal(n) for n in numbers]
    with pytest.raises(RigStopped, match=why), safe_stop(RunControl()):
        raise_and_clean_up(signal.Signals[name])
    assert [signal.getsignal(n) for n in numbers] == before


def test_ctrl_z_holds_and_goes_on_again(capsys):
    control = RunControl()
    with safe_stop(control):
        signal.raise_signal(signal.SIGTSTP)
        assert control.held
        signal.raise_signal(signal.SIGTSTP)
        assert not control.held
    first, second = capsys.readouterr().err.splitlines()
    assert first.startswith("held")
    assert second == "going on"


def test_commands_to_go_on_with_quote_names_with_blanks(monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("instrument.cli.demo._run_rig", lambda *_: None)
    shown = CliRunner().invoke(demo, ["--out", "demo out"]).output
    assert "then  viscorig run 'demo out/experiment.toml'" in shown
    (tmp_path / "a b.running").mkdir()
    with pytest.raises(BadInput, match=r"viscorig recover 'a b\.running' puts its session together"):
        SessionFile(Path("a b.running"))
