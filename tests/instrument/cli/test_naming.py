"""Of which files a refusal is."""

from pathlib import Path

import pytest

from fitting.errors import OutsideModel, TooFewPoints
from instrument.cli.naming import naming_files, naming_records
from instrument.errors import BadInput

DATA = Path("a/b.csv")


def refusing(error):
    @naming_files
    def command(*, data):
        raise error

    return command


@pytest.mark.parametrize("data", [Path("a/b.csv"), (Path("a/b.csv"),)])
def test_a_refusal_begins_with_the_data_s_name(data):
    with pytest.raises(TooFewPoints, match=r"^a/b\.csv: one point"):
        refusing(TooFewPoints("one point"))(data=data)


def test_one_that_names_a_file_already_is_left_as_it_is():
    with pytest.raises(OutsideModel, match=r"^b\.csv has no core"):
        refusing(OutsideModel("b.csv has no core"))(data=(Path("a/b.csv"), Path("c.csv")))
    with pytest.raises(OutsideModel, match=r"^a\.csv, c\.csv: of two kinds"):
        refusing(OutsideModel("of two kinds"))(data=(Path("a.csv"), Path("c.csv")))


def test_what_records_hold_together_is_refused_with_their_name():
    with pytest.raises(BadInput, match=r"^a/b\.csv and 1 more: band"), naming_records([DATA, Path("c.csv")]):
        raise BadInput("band 3000 to 4000 Hz holds 0 lines")
    with pytest.raises(BadInput, match=r"^b\.csv hit 1: nothing"), naming_records([DATA]):
        raise BadInput("b.csv hit 1: nothing")


def test_what_the_command_gives_is_given():
    assert naming_files(lambda *, data: len(data))(data=(Path("a.csv"),)) == 1


def test_a_command_without_data_names_its_specimen():
    @naming_files
    def command(*, specimen):
        raise OutsideModel("[pickup] is missing")

    with pytest.raises(OutsideModel, match=r"^beam\.toml: \[pickup\] is missing"):
        command(specimen=Path("beam.toml"))
