"""Stated numbers that no such rig or experiment has, questioned as a specimen's are. `--force` insists."""

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from fitting.gravity import STANDARD_GRAVITY_M_S2
from instrument.errors import BadInput
from instrument.files.plausible import INSIST, SPOT_MM, Usual, outside, question_specimen
from instrument.files.toml import read_tables

_PER_G = 1 / STANDARD_GRAVITY_M_S2
_ACCELEROMETER = {
    "sensitivity_mv_per_unit": Usual(
        0.02, 500.0, "accelerometers 0.1 to 100, per m/s^2", {"V": 1e3, "mV per g": _PER_G}
    ),
    "mass_g": Usual(0.02, 300.0, "accelerometers 0.2 to 50", {"kg": 1e3, "mg": 1e-3}),
}
_HAMMER = {
    "sensitivity_mv_per_unit": Usual(0.05, 500.0, "hammers 0.2 to 100, per N", {"V": 1e3, "mV per kN": 1e-3}),
}
_LIMITS = {
    "base_m_s2": Usual(0.02, 5_000.0, "shakers up to 1000", {"mm/s^2": 1e-3}),
    "velocity_m_s": Usual(1e-4, 25.0, "vibrometers up to 20", {"mm/s": 1e-3}),
    "travel_mm": Usual(0.02, 200.0, "shakers 5 to 50", {"m": 1e3, "um": 1e-3}),
    "drive_v": Usual(1e-3, 50.0, "amplifiers 1 to 10", {"mV": 1e-3}),
}
_MOUNTING = {"torque_n_m": Usual(0.05, 2_000.0, "bolts 1 to 200", {"N mm": 1e-3})}
_PLACES = ("hit_x_mm", "hit_y_mm", "response_x_mm", "response_y_mm")
LOWEST_BAND_HZ = 5.0
"""A bare plate that a hammer rings has its modes above."""


def question_experiment(experiment: Path, rig: Path, specimen: Path, *, insist: bool) -> None:
    """Ask about the three files of an experiment that read well. Raises `BadInput` in one line."""
    if insist:
        return
    question_specimen(specimen)
    _question(rig, rig_doubts)
    _question(experiment, experiment_doubts)


def rig_doubts(tables: dict[str, Any]) -> Iterator[str]:
    """Everything in a rig's tables that asks for a question; nothing for a usual one."""
    channels = tables.get("channels", {})
    for name in ("base", "response"):
        yield from outside(f"channels.{name}", channels.get(name), _ACCELEROMETER)
    yield from outside("channels.force", channels.get("force"), _HAMMER)
    yield from outside("limits", tables.get("limits"), _LIMITS)


def experiment_doubts(tables: dict[str, Any]) -> Iterator[str]:
    """Everything in an experiment's tables that asks for a question."""
    yield from outside("mounting", tables.get("mounting"), _MOUNTING)
    hammer = tables.get("hammer") or {}
    for key in _PLACES:
        if 0 < hammer.get(key, 0) < SPOT_MM:
            yield f"hammer.{key} = {hammer[key]:g} is nearer to the edge than a tip is wide: is it in m?"
    highest = max(hammer.get("band_hz", [LOWEST_BAND_HZ]))
    if highest < LOWEST_BAND_HZ:
        yield f"hammer.band_hz up to {highest:g} Hz, plates ring above {LOWEST_BAND_HZ:g}: is it in kHz?"


def _question(path: Path, doubts: Callable[[dict[str, Any]], Iterator[str]]) -> None:
    for doubt in doubts(read_tables(path)):
        raise BadInput(f"{path}: {doubt}; {INSIST}")
