"""What the commands print of results made by hand."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from result_cases import LAW_ROW

from fitting.depth.intervals import Intervals
from fitting.modal.frf import DampingEstimate, Refusal
from instrument.cli.damping import ratio_or_refusal
from instrument.cli.output import Output
from instrument.cli.print_beside import print_beside
from instrument.cli.print_budget import print_budget
from instrument.cli.print_modes import print_formulas, print_modal_law, print_modes
from instrument.cli.print_run import print_quality
from instrument.cli.print_uncertainty import print_in_depth
from instrument.facts.beside import BesideTable
from instrument.facts.budget import BudgetRow
from instrument.facts.modal import FormulaRow, ModeFitted
from instrument.facts.rows import LawRow
from instrument.results.uncertainty_facts import InDepth


def lines(capsys):
    """Printed, each line's words apart."""
    return [line.split() for line in capsys.readouterr().out.splitlines()]


def budget_row(f, *sources):
    keys = ("source", "storage_modulus_percent", "loss_factor")
    return BudgetRow.model_validate(
        {
            "frequency_hz": f,
            "storage_modulus_standard_error_percent": 2.0,
            "loss_factor_standard_error": 0.01,
            "sources": [dict(zip(keys, s, strict=True)) for s in sources],
        }
    )


def test_a_budget_shows_both_ends_and_the_middle_without_what_is_small_everywhere(capsys):
    all_small, small_but_at_the_top = ("noise", 0.03, 1e-4), ("gain", 0.03, 1e-4)
    rows = [
        budget_row(f, ("thickness", 1.9, 0.009), all_small, small_but_at_the_top) for f in (10, 20, 50, 70)
    ]
    rows.append(budget_row(100, ("thickness", 1.9, 0.009), all_small, ("gain", 0.5, 1e-4)))
    print_budget(Output(None), rows)
    title, head, *body = lines(capsys)
    assert title[:2] == ["Standard", "uncertainty"]
    assert [word for word in head if word.isdigit()] == ["10", "50", "100"]
    assert [row[0] for row in body] == ["thickness", "gain", "all"]
    assert body[1] == ["gain", "0.030", "0.00010", "0.030", "0.00010", "0.500", "0.00010"]
    assert body[2][1:3] == ["2.000", "0.01000"]


def test_a_budget_of_one_frequency_is_one_column_pair(capsys):
    print_budget(Output(None), [budget_row(10, ("noise", 2.0, 0.01))])
    assert lines(capsys)[2:] == [["noise", "2.000", "0.01000"], ["all", "2.000", "0.01000"]]


def test_modes_stand_measured_beside_predicted(capsys):
    mode = ModeFitted(
        file=2, mode=3, frequency_hz=123.456, predicted_hz=124.0, loss_factor=0.1, predicted_loss_factor=0.11
    )
    print_modes(Output(None), [mode])
    assert lines(capsys)[2] == ["2", "3", "123.46", "124", "0.1", "0.11"]


def test_of_a_long_law_a_few_rows_are_shown_from_its_lowest_frequency_on(capsys):
    law = [LawRow.model_validate(LAW_ROW | {"frequency_hz": float(f)}) for f in range(100, 1300, 10)]
    print_modal_law(Output(None), law)
    body = lines(capsys)[2:]
    assert 6 <= len(body) <= 7
    assert body[0] == ["100.0", "0.4000", "+-", "0.0010", "0.900", "+-", "0.010"]


def formula(**keys):
    least = {"file": 1, "mode": 2, "frequency_hz": 250.0, "method": "oberst", "loss_factor": 0.3}
    return FormulaRow.model_validate(least | keys)


def test_a_formula_stands_beside_the_full_model_with_what_is_against_it(capsys):
    row = formula(
        storage_modulus_pa=2e6,
        full_storage_modulus_pa=2.5e6,
        full_loss_factor=0.35,
        objections=("too thin",),
    )
    print_formulas(Output(None), [row])
    _, title, _, body, note = lines(capsys)
    assert title[-1] == "oberst)"
    assert body == ["1", "2", "250", "2", "2.5", "0.3", "0.35"]
    assert note == ["note:", "mode", "2", "by", "formula:", "too", "thin"]


def test_central_impedance_speaks_of_the_whole_beam_and_no_formula_of_nothing(capsys):
    print_formulas(Output(None), [])
    assert lines(capsys) == []
    print_formulas(Output(None), [formula(method="central-impedance", bending_stiffness_n_m2=1.5)])
    _, title, _, body = lines(capsys)
    assert title[-2:] == ["whole", "beam"]
    assert body == ["1", "2", "250", "1.5", "0.3"]


def intervals(bounds):
    linear = {level: np.array([[90.0, 110.0]]) for level in (68, 95)}
    return Intervals("profile", ("G'",), np.array([100.0]), linear, {68: bounds, 95: bounds})


def test_an_interval_without_an_end_is_open_and_is_to_be_taken(capsys):
    print_in_depth(Output(None), InDepth((intervals(np.array([[90.0, np.nan]])),)))
    _, _, body, advice = lines(capsys)
    assert " ".join(body) == "G' 100 90 to 110 90 to open 90 to 110 90 to open"
    assert " ".join(advice).endswith("for G' (upper is open)")


@dataclass
class Drawn:
    """What is printed of a sampler."""

    r_hat: np.ndarray
    weight_share: float
    samples: int = 1000
    seconds: float = 2.0
    one_evaluation_s: float = 0.5
    checked: int = 50

    @property
    def effective(self):
        return np.array([200.0, 400.0])


@pytest.mark.parametrize(
    ("r_hat", "share", "notes"), [(1.01, 0.9, []), (1.2, 0.9, ["chains"]), (1.01, 0.1, ["response"])]
)
def test_a_restless_or_far_sampler_is_said_to_be_one(capsys, r_hat, share, notes):
    drawn = Drawn(np.array([1.0, r_hat]), share)
    print_in_depth(Output(None), InDepth((intervals(np.array([[90.0, 110.0]])),), drawn))
    said = [" ".join(words) for words in lines(capsys)]
    assert "1000 samples in 2.0 s, as long as 4 full evaluations" in said[4]
    assert "effective sample size 200 to 400" in said[4]
    assert [line.split()[2] for line in said if line.startswith("note:")] == notes


@dataclass
class Table:
    """What is printed of a file."""

    kind: str = "tension"
    poisson: float | None = 0.49
    path: Path = Path("dma.csv")


@dataclass
class At:
    temperature_c: float
    p_value: float
    differs: bool | None


def at(temperature_c):
    return {
        "temperature_c": temperature_c,
        "rows": 3,
        "storage_modulus_mean_difference_percent": 1.0,
        "storage_modulus_rms_difference_percent": 2.0,
        "loss_factor_mean_difference": -0.01,
        "loss_factor_rms_difference": 0.02,
        "chi2": 1.0,
        "degrees_of_freedom": 6,
        "p_value": 0.5,
        "differs": None,
        "noise": "stated",
    }


def said_beside(*temperatures):
    return BesideTable.model_validate(
        {
            "source": "dma.csv",
            "kind": "tension",
            "rows": 9,
            "rows_in_band": 3 * len(temperatures),
            "temperatures": [at(t) for t in temperatures],
        }
    )


def test_a_table_beside_the_law_has_a_row_a_temperature_and_a_verdict_each(capsys):
    found = [At(20.0, 0.5, False), At(25.0, 1e-4, True), At(np.nan, np.nan, None)]
    print_beside(Output(None), Table(), found, said_beside(20.0, 25.0, float("nan")))
    title, _, *body = (" ".join(words) for words in lines(capsys))
    assert title.startswith(
        "With dma.csv, tension to shear with Poisson's ratio 0.49: 9 of 9 rows inside the band"
    )
    assert [row.split(" 3 +1.00")[0] for row in body] == ["20", "25", "not stated"]
    assert [row.rsplit(" ", 1)[-1] for row in body] == ["agrees", "differs", "told"]


def test_a_table_outside_the_band_is_said_to_have_nothing_to_compare(capsys):
    print_beside(Output(None), Table(poisson=None), [], said_beside())
    assert capsys.readouterr().out == "with dma.csv: 0 of 9 rows inside the band, nothing to compare\n"


def test_a_refused_damping_is_said_to_be_and_no_number():
    assert ratio_or_refusal(Refusal("too few lines")) == "refused"
    assert ratio_or_refusal(DampingEstimate(100.0, 0.0123, 1e-4)) == "1.230 +- 0.010"


def test_a_sweep_that_was_stopped_before_its_first_step_has_no_quality(capsys):
    print_quality(Output(None), [])
    assert "no step of the sweep was measured" in capsys.readouterr().out
