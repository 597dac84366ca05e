"""What follows a diagnosis of a plate alone is said of other structures."""

from types import SimpleNamespace

import pytest
from beam_cases import BEAM

from instrument.check.follow_up_remark import follow_up_remarks
from instrument.files.specimen_file import read_specimen
from instrument.files.structure_file import read_structure
from instrument.paper_case import case_file


def experiment(specimen, follow_up="do", sweep=True):
    document = SimpleNamespace(diagnosis=SimpleNamespace(follow_up=follow_up), sweep=sweep or None)
    return SimpleNamespace(document=document, the_specimen=lambda: specimen)


@pytest.fixture
def beam(tmp_path):
    (tmp_path / "beam.toml").write_text(BEAM)
    return read_structure(tmp_path / "beam.toml")


@pytest.mark.parametrize("wanted", ["do", "offer"])
def test_after_the_sweep_of_a_beam_nothing_is_measured(beam, wanted):
    (said,) = follow_up_remarks(experiment(beam, wanted))
    assert said == (
        f'diagnosis.follow_up = "{wanted}" is for plates only: nothing is measured after the sweep of a beam'
    )


def test_nothing_is_said_of_a_plate_or_where_nothing_was_to_follow(beam):
    assert follow_up_remarks(experiment(read_specimen(case_file("zn1.toml")))) == []
    assert follow_up_remarks(experiment(beam, "none")) == []
    assert follow_up_remarks(experiment(beam, sweep=False)) == []
