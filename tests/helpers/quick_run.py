"""A run that fits and diagnoses nothing: for tests of the run alone, in a process that can be killed.

A program: EXPERIMENT.toml, folder of the session, the folder to resume from where there is one.
"""

import sys
from pathlib import Path

from instrument.run.experiment import run_experiment
from instrument.session.configuration import read_whole_experiment
from instrument.stream.derived import FitUpdated


def no_fit(number, last_step, points, damping, specimen):
    """As `identify_points`, of which it says how many points it was given."""
    return FitUpdated(number, last_step, None, f"{sum(p.step <= last_step for p in points)} points")


def run(experiment, out: Path, **options):
    """The sweep alone of an experiment that was read."""
    return run_experiment(experiment, out, ("sweep",), fit=no_fit, **options)


def main(experiment: Path, out: Path, resume: Path | None = None) -> None:
    run(read_whole_experiment(experiment), out, resume=resume)


if __name__ == "__main__":
    main(*map(Path, sys.argv[1:]))
