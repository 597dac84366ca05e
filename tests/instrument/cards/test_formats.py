"""One card of a law made by hand, in every format: what each says at one frequency."""

import json

import numpy as np
import pytest
from paper_law import TABLE_4

from instrument.cards.abaqus import abaqus
from instrument.cards.ansys import ansys
from instrument.cards.card import USUAL_POISSON, Card
from instrument.cards.comsol import comsol
from instrument.cards.formats import FORMATS
from instrument.cards.nastran import nastran
from instrument.cards.plain import as_csv, as_json
from instrument.facts.card import CardResult
from instrument.material.found_law import MaterialLaw

F = np.geomspace(14.0, 300.0, 25)
WRITERS = {
    "abaqus": abaqus,
    "ansys": ansys,
    "nastran": nastran,
    "comsol": comsol,
    "csv": as_csv,
    "json": as_json,
}


def law():
    G, eta = TABLE_4.storage_and_loss(2 * np.pi * F)
    nan = np.full(len(F), np.nan)
    return MaterialLaw(
        "found.json", "plate", "none", TABLE_4.kind, {"a": 1.0}, {"a": None}, F, G, eta, nan, nan
    )


@pytest.fixture(scope="module")
def card():
    return Card.of(law(), 0.45)


def test_every_format_has_its_writer_and_an_ending_of_its_own():
    assert {name: one.write for name, one in FORMATS.items()} == WRITERS
    assert len({one.endings[0] for one in FORMATS.values()}) == len(FORMATS)


def test_a_card_is_in_si_and_its_bulk_modulus_goes_with_poisson_s_ratio(card):
    assert card.young_pa(1e6) == pytest.approx(2.9e6)
    assert card.bulk_over_shear() == pytest.approx(2.9 / 0.3)
    assert card.loss == pytest.approx(card.storage * card.law.loss_factor)
    assert (Card.of(law()).poisson, Card.of(law()).poisson_is_assumed) == (USUAL_POISSON, True)


def test_abaqus_begins_at_the_instantaneous_modulus_and_its_shares_leave_the_long_term_one(card):
    young, poisson = abaqus(card).split("*ELASTIC, MODULI=INSTANTANEOUS\n")[1].splitlines()[0].split(",")
    assert float(young) == pytest.approx(card.young_pa(card.prony.g_0_pa))
    assert float(poisson) == 0.45
    terms = abaqus(card).split("TIME=PRONY\n")[1].split()
    assert 1 - sum(float(t.rstrip(",")) for t in terms[::3]) == pytest.approx(
        card.prony.g_inf_pa / card.prony.g_0_pa, abs=1e-6
    )


def test_tables_list_what_was_found_at_each_frequency(card):
    rows = [line.split() for line in comsol(card).splitlines() if not line.startswith("%")]
    assert np.array(rows, float)[:, :3] == pytest.approx(np.column_stack([F, card.storage, card.loss]))
    rows = [line.split(",") for line in as_csv(card).splitlines() if line[0].isdigit()]
    assert [float(row[1]) for row in rows] == card.storage.tolist()
    # Nothing stands where there is no error.
    assert {tuple(row[3:]) for row in rows} == {("", "")}


def test_nastran_s_fields_are_sixteen_wide(card):
    data = [line for line in nastran(card).splitlines() if line and not line.startswith("$")]
    assert {line[:8].strip() for line in data} == {"MAT1*", "*", "MATF1*", "TABLED1*"}
    (shear,) = (line[40:56] for line in data if line.startswith("MAT1*"))
    assert float(shear) == pytest.approx(card.storage[12])


def test_ansys_has_a_line_of_its_own_for_every_comment(card):
    text = ansys(card)
    assert card.header()
    assert all(any(line == f"! {said}" for line in text.splitlines()) for said in card.header())


def test_json_is_a_card_s_result_again(card):
    found = CardResult.model_validate(json.loads(as_json(card)))
    assert [row.frequency_hz for row in found.law] == F.tolist()
    assert np.isnan(found.law[0].loss_factor_standard_error)
    assert found.poisson == 0.45
    assert sum(term.share for term in found.prony.terms) < 1.0
