"""A batch: rows that fail beside rows that do not, one table, one page."""

import csv
import json
import re
import shutil

import pytest
from batch_cases import CORRUPT, write_specimen, write_sweeps
from diagnosed_session import diagnosed_session
from json_schema import faults
from pyarrow import parquet

from instrument.batch.asking import tasks_of
from instrument.batch.counted import Counted
from instrument.batch.page import short_names, write_page
from instrument.batch.run import BatchRow, here, run_batch
from instrument.batch.task import BatchTask
from instrument.batch.work import outcome_of
from instrument.cli.main import run
from instrument.errors import BadInput
from instrument.facts.schema import schema_of


@pytest.fixture(scope="module")
def plate(tmp_path_factory):
    return write_specimen(tmp_path_factory.mktemp("plate"))


@pytest.fixture(scope="module")
def sweeps(tmp_path_factory, plate):
    folder = tmp_path_factory.mktemp("sweeps")
    paths = write_sweeps(folder, plate, 4, points=(9, 12))
    paths[2].write_text(CORRUPT, encoding="utf-8")
    return paths


def rows_of(folder):
    with open(folder / "batch.csv", encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def batch(*arguments):
    """In this process: others take longer to begin than such sweeps to fit."""
    return run(["batch", *map(str, arguments), "--workers", "1"])


@pytest.fixture(scope="module")
def whole(tmp_path_factory, sweeps, plate):
    """The batch of all sweeps, on both processors; to be looked at."""
    folder = tmp_path_factory.mktemp("whole")
    words = [*sweeps, "--specimen", plate, "--out", folder, "--json", folder / "said.json"]
    assert run(["batch", *map(str, words), "--workers", "2"]) == 0
    return folder


def test_a_corrupt_file_is_a_row_with_its_reason(whole):
    said = json.loads((whole / "said.json").read_text())
    assert faults(said, schema_of("batch")) == []
    assert (said["rows"], said["done"], said["failed"]) == (4, 3, 1)
    assert said["verdicts"] == {"not diagnosed": 3}
    rows = rows_of(whole)
    assert [row["status"] for row in rows] == ["done", "done", "failed", "done"]
    assert rows[2]["reason"] == said["failures"][0]["reason"]
    assert rows[2]["reason"].startswith("header: column frequency_hz missing")
    assert rows[0]["points"] == "9"
    assert float(rows[0]["storage_modulus_pa"]) == pytest.approx(0.9e6, rel=0.5)
    assert float(rows[0]["g0_pa"]) > 0
    assert float(rows[0]["alpha_standard_error"]) > 0


def test_where_every_row_failed_so_has_the_batch(tmp_path, sweeps, plate, capsys):
    said = tmp_path / "said.json"
    assert batch(sweeps[2], "--specimen", plate, "--out", tmp_path, "--json", said) == 2
    assert capsys.readouterr().err.strip() == (
        f"viscorig: {tmp_path / 'batch.csv'}: every row failed, expected one that can be worked out"
    )
    assert [row["status"] for row in rows_of(tmp_path)] == ["failed"]
    assert json.loads(said.read_text())["failed"] == 1


def test_a_table_of_another_kind_is_not_written_over(tmp_path, sweeps, plate, capsys):
    table = tmp_path / "batch.csv"
    table.write_text("data,specimen\na.csv,plate.toml\n")
    assert batch(sweeps[2], "--specimen", plate, "--out", tmp_path) == 2
    assert "batch.csv: a table stands there and is not written over" in capsys.readouterr().err
    assert [path.name for path in tmp_path.iterdir()] == ["batch.csv"]
    assert table.read_text().startswith("data,specimen\na.csv")


def test_a_row_says_what_identify_says(tmp_path, sweeps, plate):
    assert batch(sweeps[0], "--specimen", plate, "--out", tmp_path) == 0
    assert (
        run(["identify", str(sweeps[0]), "--specimen", str(plate), "--json", str(tmp_path / "i.json")]) == 0
    )
    alone = json.loads((tmp_path / "i.json").read_text())
    (row,) = rows_of(tmp_path)
    for name, value in alone["parameters"].items():
        assert float(row[name]) == pytest.approx(value, rel=1e-9)
    assert float(row["rms_percent"]) == pytest.approx(alone["rms_percent"], rel=1e-9)


def test_a_sweep_in_another_unit_is_a_row_that_fails_unless_someone_insists(tmp_path, sweeps, plate):
    head, *rows = (line.split(",") for line in sweeps[0].read_text().splitlines())
    lines = [head] + [[row[0], *(repr(1e3 * float(x)) for x in row[1:])] for row in rows]
    (tmp_path / "mm.csv").write_text("\n".join(map(",".join, lines)) + "\n")
    task = BatchTask(str(tmp_path / "mm.csv"), str(plate))
    said = "it looks as if the pickup is read in mm (mm/s, mm/s^2), expected m; --force to go on all the same"
    assert outcome_of(task)["failed"] == said
    assert batch(task.data, "--specimen", plate, "--out", tmp_path, "--force") == 0
    assert rows_of(tmp_path)[0]["status"] == "done"


def test_the_page_needs_nothing_beside_it(whole):
    page = (whole / "batch.html").read_text(encoding="utf-8")
    assert not re.search(r'(src|href)="(?!data:|#)', page)
    for words in ("3 of 4", "sweep-0002.csv", "column frequency_hz missing", "data:image/svg+xml"):
        assert words in page


def test_what_is_said_of_several_rows_stands_on_the_page_once(tmp_path):
    law = {"frequency_hz": [20.0], "storage_modulus_pa": [1e6], "loss_factor": [0.5]}
    law |= {"storage_modulus_standard_error_pa": [1e4], "loss_factor_standard_error": [0.01]}
    nothing = dict.fromkeys(("points", "lowest_hz", "highest_hz", "rms_percent", "chi2_per_dof"), 1.0)
    nothing |= dict.fromkeys(("converged", "borrowed_model", "verdict", "leave_one_out_rms_percent"))
    nothing |= {"law_kind": "", "held_out_rms_percent": None, "effects": (), "parameters": {}, "law": law}
    said = (["tolerances are typical"], ["its own; in two parts", "tolerances are typical"], [])
    rows = [
        BatchRow(BatchTask(f"{k}.csv", "a.toml"), {**nothing, "failed": "", "warnings": one})
        for k, one in enumerate(said)
    ]
    counted = Counted()
    page = write_page(rows, counted, (), (), tmp_path).read_text(encoding="utf-8")
    assert page.count("tolerances are typical") == 1
    cells = re.findall(r"<td[^>]*>(\[1\][^<]*)</td>", page)
    assert cells == ["[1]", "[1]", "[1]; its own; in two parts"]


def test_a_page_names_files_by_as_much_of_their_path_as_tells_them_apart():
    assert short_names(["/data/a/1.csv", "/data/a/2.csv"]) == ["1.csv", "2.csv"]
    assert short_names(["/data/a/1.csv", "/data/b/1.csv"]) == ["a/1.csv", "b/1.csv"]
    assert short_names(["1.csv", "1.csv"]) == ["1.csv", "1.csv"]
    assert short_names([]) == []


def test_started_again_nothing_is_repeated_and_the_table_is_the_same(tmp_path, whole, sweeps, plate, capsys):
    shutil.copytree(whole, tmp_path, dirs_exist_ok=True)
    first, journal = (tmp_path / "batch.csv").read_bytes(), (tmp_path / "batch.jsonl").read_bytes()
    with open(tmp_path / "batch.jsonl", "a", encoding="utf-8") as file:
        file.write('{"key": "torn')
    (tmp_path / "batch.csv").unlink()
    capsys.readouterr()
    assert batch(*sweeps, "--specimen", plate, "--out", tmp_path) == 0
    assert "4 of them known before" in capsys.readouterr().out
    assert (tmp_path / "batch.csv").read_bytes() == first
    assert (tmp_path / "batch.jsonl").read_bytes() == journal


@pytest.mark.parametrize("how", ["a number turned", "numbers lost"])
def test_a_row_that_was_changed_in_the_journal_is_done_again(tmp_path, whole, sweeps, plate, capsys, how):
    shutil.copytree(whole, tmp_path, dirs_exist_ok=True)
    journal, table = tmp_path / "batch.jsonl", (tmp_path / "batch.csv").read_bytes()
    lines = journal.read_text(encoding="utf-8").splitlines(keepends=True)
    at = next(k for k, line in enumerate(lines) if '"law"' in line)
    law = lines[at].index('"law"')
    number = re.compile(r"\d\.\d+, ").search(lines[at], law)
    new = number[0].replace(number[0][2], str((int(number[0][2]) + 1) % 10)) if "turned" in how else ""
    lines[at] = lines[at][: number.start()] + new + lines[at][number.end() :]
    json.loads(lines[at])
    journal.write_text("".join(lines), encoding="utf-8")
    capsys.readouterr()
    assert batch(*sweeps, "--specimen", plate, "--out", tmp_path) == 0
    assert "3 of them known before" in capsys.readouterr().out
    assert (tmp_path / "batch.csv").read_bytes() == table


def test_another_content_is_another_row(tmp_path, plate):
    (path,) = write_sweeps(tmp_path, plate, 1)
    batch(path, "--specimen", plate, "--out", tmp_path / "out")
    write_sweeps(tmp_path, plate, 1, seed=2)
    with run_batch(tasks_of([path], plate), tmp_path / "out", here(1)) as rows:
        assert rows.repeated == 0


def test_a_table_names_data_specimen_and_temperature(tmp_path, sweeps, plate):
    table = sweeps[0].parent / "rows.csv"
    table.write_text(
        "# a comment\n"
        "remark,data,specimen,temperature_c\n"
        f"first,{sweeps[0].name},{plate},21.5\n"
        f"gone,nowhere.csv,{plate},\n"
        f"no plate,{sweeps[1].name},,\n"
        f"wrong plate,{sweeps[1].name},nosuch.toml,\n",
        encoding="utf-8",
    )
    assert batch(table, "--out", tmp_path) == 0
    rows = rows_of(tmp_path)
    assert [row["status"] for row in rows] == ["done", "failed", "failed", "failed"]
    assert rows[0]["temperature_c"] == "21.5"
    assert rows[1]["reason"] == "No such file or directory"
    assert rows[3]["reason"] == "specimen nosuch.toml: No such file or directory"
    assert "--specimen" in rows[2]["reason"]


def test_a_session_is_a_row_without_a_specimen(tmp_path):
    session = diagnosed_session(tmp_path)
    assert batch(session, "--out", tmp_path) == 0
    (row,) = rows_of(tmp_path)
    assert (row["status"], row["specimen"]) == ("done", "")


@pytest.mark.long
def test_diagnosed_rows_carry_a_verdict(tmp_path, sweeps, plate, capsys):
    assert batch(sweeps[0], "--specimen", plate, "--out", tmp_path, "--diagnose") == 0
    (row,) = rows_of(tmp_path)
    assert row["verdict"] in ("none", "effect", "ambiguous", "unknown")
    assert f"1 {row['verdict']}" in capsys.readouterr().out


def test_parquet_holds_the_same_numbers(whole):
    table = parquet.read_table(whole / "batch.parquet").to_pylist()
    rows = rows_of(whole)
    assert [row["data"] for row in table] == [row["data"] for row in rows]
    assert table[0]["storage_modulus_pa"] == float(rows[0]["storage_modulus_pa"])
    assert table[2]["storage_modulus_pa"] is None


@pytest.mark.parametrize(
    ("given", "said"),
    [
        (["sweep-0000.csv"], "Missing option '--specimen'"),
        (["rows.csv", "sweep-0000.csv"], "expected one table"),
        (["empty.csv"], "no rows"),
        (["warm.csv"], "expected a number"),
        (["kelvin.csv"], "line 2: temperature_c = 293.15: is it in K?; --force"),
    ],
)
def test_a_wrong_question_is_one_line(tmp_path, given, said):
    for name, text in (
        ("sweep-0000.csv", "frequency_hz,velocity_m_s\n1,1\n"),
        ("rows.csv", "data\nx.csv\n"),
        ("empty.csv", "data,specimen\n"),
        ("warm.csv", "data,temperature_c\nx.csv,warm\n"),
        ("kelvin.csv", "data,temperature_c\nx.csv,293.15\n"),
    ):
        (tmp_path / name).write_text(text, encoding="utf-8")
    with pytest.raises(BadInput, match=re.escape(said)):
        tasks_of([tmp_path / name for name in given], None)


def test_a_journal_of_another_kind_is_refused(tmp_path, sweeps, plate, capsys):
    (tmp_path / "batch.jsonl").write_text('{"mine": 1}\n', encoding="utf-8")
    assert batch(*sweeps, "--specimen", plate, "--out", tmp_path) == 2
    assert "line 1: not a row of a batch" in capsys.readouterr().err


def test_specimens_that_differ_a_little_share_one_model(tmp_path, plate):
    folder = tmp_path
    plates = [
        write_specimen(folder, f"plate-{k}.toml", core_mm=mm, exact=False)
        for k, mm in enumerate((0.5, 0.502, 0.6))
    ]
    data = write_sweeps(folder, plates[0], 3)
    table = folder / "rows.csv"
    lines = [f"{d.name},{p.name}" for d, p in zip(data, plates, strict=True)]
    table.write_text("\n".join(["data,specimen", *lines, ""]), encoding="utf-8")
    assert batch(table, "--out", folder / "shared") == 0
    shared = rows_of(folder / "shared")
    # Its own, its neighbour's by certificate, and its own again: too far off.
    assert [row["borrowed_model"] for row in shared] == ["false", "true", "false"]
    assert batch(data[1], "--specimen", plates[1], "--out", folder / "own") == 0
    (own,) = rows_of(folder / "own")
    for name in ("storage_modulus_pa", "loss_factor"):
        error = float(own[f"{name.removesuffix('_pa')}_standard_error" + ("_pa" if "_pa" in name else "")])
        assert abs(float(shared[1][name]) - float(own[name])) < 0.1 * error
