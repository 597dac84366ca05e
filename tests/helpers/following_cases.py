"""A run that goes on after its diagnosis, on a plate made of formulas: what it finds is made up.

A program that kills itself: EXPERIMENT.toml, folder of the session, after how many points (0: never), the
folder to resume from where there is one.
"""

import os
import signal
import sys
from dataclasses import replace
from functools import partial
from pathlib import Path

from diagnosis_cases import diagnosis
from result_cases import identification
from run_at_point import RunAtPoint

from instrument.run.experiment import run_experiment
from instrument.run.live_diagnosis import diagnose_points
from instrument.session.configuration import read_whole_experiment
from instrument.stream.derived import DiagnosisFound, FitUpdated

SPOT_MM = (250.0, 100.0)
SEGMENTS = """
[[sweep.segments]]
mode = 1
span_percent = 50.0
points = 9
[[sweep.segments]]
mode = 3
span_percent = 25.0
points = 9
"""
"""Two resonances of the solid plate, few steps each."""
STEPS = {"frequencies_hz": [105.5, 104.0, 96.5], "segments": [1, 1, 1]}
OFFER = {
    "needs_hands": False,
    "seconds": 30.0,
    "separation": 4.0,
    "probability_resolved": 0.8,
    "between": ["spot_offset", "gain_error"],
    "why": "A gain is the same at every spot.",
    "todo": "Do it.",
}
BACKWARDS = {**OFFER, **STEPS, "kind": "reversed", "level_g": 1.0}
HALF = {**BACKWARDS, "kind": "level", "level_g": 0.5}
SPOT = {**BACKWARDS, "kind": "spot", "needs_hands": True, "spot_mm": SPOT_MM, "todo": "Aim it elsewhere."}

SPOT_OF_THE_CASE = {**SPOT, "segments": [2, 2, 2]}
"""Of the simulated plate, whose third mode is the second segment."""

CLAMPING = {**BACKWARDS, "kind": "clamping", "needs_hands": True, "todo": "Clamp it anew."}

STRUCK = {
    **OFFER,
    "kind": "damped_struck",
    "needs_hands": True,
    "seconds": 600.0,
    "struck_mm": (285.0, 180.0),
    "spot_mm": (15.0, 20.0),
    "held": "free",
}
STRUCK_IN_ITS_CLAMP = {**STRUCK, "spot_mm": None, "held": "clamped"}

MASS_KG, MASS_MM = 0.005, (280.0, 100.0)
MASS = {**BACKWARDS, "kind": "added_mass", "needs_hands": True, "mass_kg": MASS_KG, "mass_at_mm": MASS_MM}


def a_law(number, last_step, points, damping, specimen):
    return FitUpdated(number, last_step, identification())


def grouped(*offers):
    """A diagnosis that ends in a group as long as there are offers, one after another."""

    def diagnose(asked):
        measured = {p.sweep for p in asked.points if p.step <= asked.last_step}
        left = offers[len(measured) + len(asked.struck) - 1 :][:1]
        result = diagnosis().but(next_measurements=left)
        return DiagnosisFound(asked.number, asked.last_step, result)

    return diagnose


def run(experiment, out, offers=(BACKWARDS, SPOT), **options):
    if not hasattr(experiment, "document"):
        experiment = read_whole_experiment(Path(experiment))
    return run_experiment(experiment, Path(out), ("sweep",), fit=a_law, diagnose=grouped(*offers), **options)


def really(*offers):
    """A diagnosis as a run makes it, but for what it proposes: the ranking of such data may be empty."""
    proposed = grouped(*offers)

    def diagnose(asked):
        found = diagnose_points(asked)
        offered = proposed(asked).result.next_measurements
        return replace(found, result=found.result.but(next_measurements=offered))

    return diagnose


if __name__ == "__main__":
    experiment, out, after, *folder = sys.argv[1:]
    run_experiment(
        read_whole_experiment(Path(experiment)),
        Path(out),
        ("sweep",),
        diagnose=really(SPOT_OF_THE_CASE),
        companion=RunAtPoint(int(after), partial(os.kill, os.getpid(), signal.SIGKILL)),
        resume=Path(folder[0]) if folder else None,
    )
