"""What is told of a batch's rows: cells, counts, a figure; and what a batch broken off still knows."""

import pytest
from batch_cases import write_specimen

from instrument.batch.columns import cells, columns_of, error_name, middle
from instrument.batch.counted import Counted
from instrument.batch.families import with_families
from instrument.batch.figure import laws_figure
from instrument.batch.journal import NAME, OutcomeJournal
from instrument.batch.run import BatchRow, run_batch
from instrument.batch.task import BatchTask
from instrument.errors import BadInput, StoppedByUser

LAW = {
    "frequency_hz": [10.0, 30.0, 90.0],
    "storage_modulus_pa": [1e6, 2e6, 3e6],
    "storage_modulus_standard_error_pa": [1e4, 2e4, 3e4],
    "loss_factor": [0.5, 0.6, 0.7],
    "loss_factor_standard_error": [0.01, 0.02, 0.03],
}
DONE = {
    "failed": "",
    "again": False,
    "points": 9,
    "lowest_hz": 10.0,
    "highest_hz": 90.0,
    "converged": True,
    "law_kind": "constant",
    "rms_percent": 1.0,
    "chi2_per_dof": 1.1,
    "borrowed_model": False,
    "leave_one_out_rms_percent": None,
    "held_out_rms_percent": 2.0,
    "verdict": None,
    "effects": [],
    "warnings": ["one", "two"],
    "parameters": {"g_pa": 2e6},
    "standard_errors": {"g_pa": 1e3},
    "law": LAW,
}


def row(data="a/b.csv", **outcome):
    return BatchRow(BatchTask(data), {**DONE, **outcome})


FAILED = row("c.csv", failed="no such file")


def test_a_standard_error_is_named_with_the_unit_of_its_parameter():
    names = ("g0_pa", "tau_s", "omega_rad_s", "alpha")
    said = [
        "g0_standard_error_pa",
        "tau_standard_error_s",
        "omega_standard_error_rad_s",
        "alpha_standard_error",
    ]
    assert [error_name(name) for name in names] == said


def test_a_failed_row_says_its_reason_and_no_number():
    assert cells(FAILED) == {
        "data": "c.csv",
        "specimen": None,
        "hammer": None,
        "temperature_c": None,
        "material": None,
        "status": "failed",
        "reason": "no such file",
    }


def test_every_cell_of_a_row_has_a_column_of_its_own():
    rows = [FAILED, row(), row(parameters={"tau_s": 1.0}, standard_errors={})]
    columns = columns_of(rows)
    assert len(columns) == len(set(columns))
    for one in rows:
        assert set(cells(one)) <= set(columns)
    assert columns.index("g_standard_error_pa") == columns.index("g_pa") + 1
    assert cells(rows[2])["tau_standard_error_s"] is None


def test_points_left_out_one_by_one_go_before_segments_held_out():
    assert cells(row())["held_out_rms_percent"] == 2.0
    assert cells(row(leave_one_out_rms_percent=3.0))["held_out_rms_percent"] == 3.0


def test_the_middle_of_a_band_is_its_geometric_mean():
    found = middle(LAW, 10.0, 90.0)
    assert found == {
        "middle_hz": 30.0,
        "storage_modulus_pa": 2e6,
        "storage_modulus_standard_error_pa": 2e4,
        "loss_factor": 0.6,
        "loss_factor_standard_error": 0.02,
    }
    assert middle({}, 10.0, 90.0) == {}


def test_failed_rows_are_counted_apart_with_their_reasons_in_order():
    seen = row(verdict="effect", effects=["added_mass"], borrowed_model=True)
    both = row(verdict="effect", effects=["spot_offset", "added_mass"])
    result = Counted.of([seen, FAILED, row(), both]).result(known_before=1, files=())
    assert (result.rows, result.done, result.failed, result.borrowed_models) == (4, 3, 1, 1)
    assert result.verdicts == {"effect": 2, "not diagnosed": 1}
    assert list(result.effects.items()) == [("added_mass", 2), ("spot_offset", 1)]
    assert [(f.data, f.reason) for f in result.failures] == [("c.csv", "no such file")]


def test_a_law_that_doubts_itself_is_counted_by_its_data_unless_it_was_diagnosed():
    doubt = {"warnings": ["it may be less"], "doubts": ["it may be less"]}
    rows = [row(**doubt), row(verdict="effect", effects=["added_mass"], **doubt), row(), FAILED]
    result = Counted.of(rows).result(known_before=0, files=())
    assert result.doubted == (rows[0].task.data,)


def test_a_few_laws_are_named_by_their_files_and_failed_rows_are_not_drawn():
    figure = laws_figure(
        [row("a/first.csv"), BatchRow(BatchTask("c.csv"), {"failed": "why"}), row("a/2.csv")], 2
    )
    left, right = figure.axes
    assert [line.get_label() for line in left.lines] == ["first.csv", "2.csv"]
    assert left.lines[0].get_ydata() == pytest.approx([1, 2, 3])
    assert right.lines[0].get_ydata() == pytest.approx(LAW["loss_factor"])
    assert [text.get_text() for text in left.get_legend().get_texts()] == ["first.csv", "2.csv"]


def test_a_row_torn_by_a_kill_is_forgotten_and_the_whole_ones_are_known(tmp_path):
    with OutcomeJournal(tmp_path) as journal:
        journal.keep("a", DONE)
        journal.keep("b", {**DONE, "again": True})
    whole = (tmp_path / NAME).read_bytes()
    (tmp_path / NAME).write_bytes(whole + b'{"key": "c", "out')
    with OutcomeJournal(tmp_path) as journal:
        assert ("a" in journal, "b" in journal, "c" in journal) == (True, False, False)
        assert journal["a"] == DONE
        journal.keep("c", DONE)
        assert journal["c"] == DONE
    assert (tmp_path / NAME).read_bytes().startswith(whole + b'{"key": "c", "outcome"')


def test_another_file_in_the_journals_place_is_refused_by_its_line(tmp_path):
    (tmp_path / NAME).write_text('{"key": "a", "outcome": {"again": false}}\nnothing of ours\n')
    with pytest.raises(BadInput, match=r"batch\.jsonl: line 2: not a row of a batch"):
        OutcomeJournal(tmp_path)


def test_the_first_specimen_of_its_kind_lends_its_model_to_the_others(tmp_path):
    first, thicker = (
        write_specimen(tmp_path, f"{k}.toml", core_mm=mm, exact=False) for k, mm in ((1, 0.5), (2, 0.505))
    )
    exact = write_specimen(tmp_path, "exact.toml")
    asked = [first, thicker, exact, tmp_path / "none.toml", first]
    tasks = [BatchTask("a.csv"), *(BatchTask("a.csv", str(path)) for path in asked)]
    assert [task.like for task in with_families(tasks)] == [None, None, str(first), None, None, None]


def test_a_batch_that_is_stopped_says_how_many_rows_it_will_not_do_again(tmp_path):
    paths = [tmp_path / f"{k}.csv" for k in range(4)]
    for k, path in enumerate(paths):
        path.write_text(f"{k}", encoding="utf-8")
    tasks = [BatchTask(str(path)) for path in (*paths, tmp_path / "gone.csv", paths[0])]

    def stopped(done):
        def runner(left, keep):
            for task, again in zip(left, done, strict=False):
                keep(task, {**DONE, "again": again})
            raise KeyboardInterrupt

        return runner

    with pytest.raises(StoppedByUser, match=r"^0 of 6 rows done"):
        run_batch(tasks, tmp_path, stopped([True]))
    with pytest.raises(StoppedByUser, match=r"^2 of 6 rows done"):
        run_batch(tasks, tmp_path, stopped([False, True]))
    with pytest.raises(StoppedByUser, match=r"^3 of 6 rows done"):
        run_batch(tasks, tmp_path, stopped([False]))
