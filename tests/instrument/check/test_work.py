"""The time that a run's work is going to take, before it begins."""

import re

import pytest

from instrument.check.forecast import Forecast
from instrument.check.work import planned_regions, planned_work
from instrument.files.new_file import write_new
from instrument.session.configuration import read_whole_experiment
from instrument.simulated_case import write_case


@pytest.mark.parametrize(
    ("kind", "least_s", "most_s"), [("plate", 30, 100), ("beam", 3, 8), ("shear-pair", 1, 4)]
)
def test_what_is_computed_takes_as_long_as_that_structure_does(tmp_path, kind, least_s, most_s):
    path = write_case(tmp_path)
    if kind != "plate":
        specimen = tmp_path / "specimen.toml"
        specimen.unlink()
        write_new(kind, specimen)
        # A hammer test is of a bare plate or beam.
        path.write_text(re.sub(r"(?ms)^\[hammer\].*?(?=^\[)", "", path.read_text()))
    experiment = read_whole_experiment(path)
    forecast = Forecast.of(experiment.the_specimen())
    work = planned_work(experiment, forecast, ("sweep",))
    assert [piece.kind for piece in work[-2:]] == ["fit", "diagnosis"]
    assert least_s < sum(piece.fixed_s for piece in work[-2:]) < most_s
    assert len(planned_regions(experiment, forecast)) == len(experiment.document.sweep.segments)
