"""A whole experiment on the simulated rig: the published plate, hammer test, sweep of three resonances."""

import re
from pathlib import Path
from random import Random

from instrument.errors import BadInput, system_words
from instrument.files.replaceable import refuse_another_file
from instrument.files.text import read_text

FILES = ("experiment.toml", "rig.toml", "specimen.toml")
_CHOSEN = re.compile(r"seed = \d+$|effects\.\w+ = ")
"""Lines of a rig that a demonstration chooses."""

EFFECTS = {
    "clamp_compliance": "along_x_n_m3 = 3e13, along_z_n_m3 = 3e13",
    "clamp_friction": "loss_factor = 0.1",
    "spot_offset": "dx_m = 0.004, dy_m = 0.0",
    "added_mass": "mass_kg = 0.008, x_m = 0.25, y_m = 0.1",
    "air_added_mass": "density_kg_m3 = 1.2",
    "temperature_drift": "kelvin = 3.0, time_constant_s = 60.0",
    "partial_debond": 'along = "x", from_m = 0.26, to_m = 0.3',
    "amplitude_softening": "k = 0.1",
    "viscous_damping": "scale = 2.5",
    "base_rocking": "pitch_rad_m = 0.1",
    "fixture_resonance": "frequency_hz = 105.0, damping_ratio = 0.02, gain_rad_m = 0.05",
    "core_thickness": "scale = 1.06",
    "substrate_stiffness": "scale = 1.03",
    "gain_error": "factor = 1.02",
    "channel_delay": "delay_s = 1e-4",
    "level_error": "factor = 1.03",
    "mains_hum": "amplitude_v = 0.1",
}
"""What a demonstration may hide, at a severity that shows. Keys as in `[simulation.effects]`.

The vibrometer's calibration in place takes `gain_error` and `channel_delay` off before they reach a point.
"""

DEFAULT_EFFECT = "clamp_compliance"


def chosen_effect(name: str, seed: int) -> str | None:
    """The effect to hide; `none` for none, `random` for one that the seed picks. Raises `BadInput`."""
    if name == "none":
        return None
    if name == "random":
        return Random(seed).choice(sorted(EFFECTS))
    if name not in EFFECTS:
        raise BadInput(f"effect {name!r}, expected none, random or one of {', '.join(sorted(EFFECTS))}")
    return name


def case_file(name: str) -> Path:
    """Path of one of `FILES`."""
    return Path(__file__).parent / name


def write_case(folder: Path, *, seed: int = 1, effect: str | None = None) -> Path:
    """The case as files to run and to edit, over any that are there; the experiment's path.

    Raises `BadInput`.
    """
    if effect is not None and effect not in EFFECTS:
        raise BadInput(f"effect {effect!r}, expected one of {', '.join(sorted(EFFECTS))}")
    hidden = f"effects.{effect} = {{ {EFFECTS[effect]} }}\n" if effect is not None else ""
    try:
        texts = {name: read_text(case_file(name)) for name in FILES}
        texts["rig.toml"] = texts["rig.toml"].replace("seed = 1\n", f"seed = {seed}\n{hidden}")
        for name, text in texts.items():
            (folder / name).write_text(text, encoding="utf-8")
    except OSError as error:
        raise BadInput(f"{folder}: {system_words(error)}") from None
    return folder / "experiment.toml"


def refuse_edited(folder: Path) -> None:
    """Raise `BadInput` where a file that `write_case` would write has been edited, or is another."""
    for name in FILES:
        there = folder / name
        if there.is_file() and _as_given(read_text(there)) != _as_given(read_text(case_file(name))):
            refuse_another_file(there)


def _as_given(text: str) -> str:
    """Without what a seed and a hidden effect make of it."""
    return "".join(line for line in text.splitlines(keepends=True) if not _CHOSEN.match(line))
