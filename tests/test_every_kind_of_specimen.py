"""Every table that has a row for each kind of specimen has one for every kind."""

from typing import get_args

import pytest

from drivers.simulated.plant import built
from fitting.effects import CATALOGUE
from fitting.effects.base import EVERY_STRUCTURE
from fitting.specimen import KINDS
from fitting.structures import AnySpecimen
from gui.form import form
from instrument.files import new_file, plausible, specimen_file, structure_file
from instrument.report import setting

ROWS = {
    "what it may hide on a simulated rig": built._HEEDED,
    "stated numbers that it lacks": specimen_file._NOT_OF,
    "the experiment that it begins with": new_file.SPECIMENS,
    "its document, but for the plate's": {"plate": None, **structure_file._DOCUMENTS},
    "its title in a report": setting._TITLES,
    "structures that effects may name": EVERY_STRUCTURE,
}
AMONG_OTHERS = {
    "commented files to begin with": new_file.TEMPLATES,
    "limits of usual numbers": plausible._USUAL,
    "tables that a form shows unfolded": form._OPEN,
}


@pytest.mark.parametrize("table", ROWS.values(), ids=ROWS)
def test_a_table_of_kinds_has_every_kind_and_no_other(table):
    assert set(table) == set(KINDS)


@pytest.mark.parametrize("table", AMONG_OTHERS.values(), ids=AMONG_OTHERS)
def test_a_table_that_has_other_things_too_has_every_kind(table):
    assert set(KINDS) <= set(table)


def test_each_kind_is_one_class_of_specimen_and_some_effect_stands_on_it():
    assert len(get_args(AnySpecimen)) == len(KINDS)
    for kind in KINDS:
        assert any(effect.on(kind) is not None for effect in CATALOGUE.values())
