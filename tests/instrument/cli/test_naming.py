"""Of which files a refusal is."""

from pathlib import Path

import pytest

from fitting.errors import OutsideModel, TooFewPoints
from instrument.cli.naming import naming_files


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


def test_what_the_command_gives_is_given():
    assert naming_files(lambda *, data: len(data))(data=(Path("a.csv"),)) == 1


def test_a_command_without_data_names_its_specimen():
    @naming_files
    def command(*, specimen):
        raise OutsideModel("[pickup] is missing")

    with pytest.raises(OutsideModel, match=r"^beam\.toml: \[pickup\] is missing"):
        command(specimen=Path("beam.toml"))
