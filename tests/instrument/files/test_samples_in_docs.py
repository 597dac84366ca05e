"""The samples of files that the documentation shows can be read as they stand."""

from pathlib import Path
from textwrap import dedent

import pytest

from instrument.files.experiment_file import read_experiment
from instrument.files.sensor_file import read_rig

DOCS = Path(__file__).parents[3] / "docs"


def sample(page, first):
    """The indented block of a page that begins with a line."""
    lines = (DOCS / page).read_text().splitlines()
    begin = next(k for k, line in enumerate(lines) if line.startswith("    " + first))
    end = next(k for k, line in enumerate(lines) if k > begin and line and not line.startswith("    "))
    return dedent("\n".join(lines[begin:end]))


@pytest.fixture
def read(tmp_path):
    def read(page, first, reader):
        path = tmp_path / "sample.toml"
        path.write_text(sample(page, first))
        return reader(path)

    return read


def test_the_sample_of_a_rig_is_a_whole_file(read):
    rig = read("rig.md", "[shaker]", read_rig)
    assert rig.channels.base.input == 1


def test_the_sample_of_an_experiment_needs_no_instrument_that_few_have(read):
    assert read("experiment.md", "title =", read_experiment).temperature is None
