"""Every effect the campaign can hide, at random severities that matter."""

from collections.abc import Callable

import numpy as np

from campaign.draws import either_sign, log_uniform

Severity = dict[str, float | str]
"""Of the plant's effects the fields of their class; of the channels' their own keys."""

PLACES: dict[str, str] = {
    "clamp_compliance": "clamp",
    "clamp_friction": "clamp",
    "base_rocking": "base",
    "fixture_resonance": "base",
    "spot_offset": "spot",
    "absolute_velocity": "velocity channel",
    "channel_delay": "velocity channel",
    "gain_error": "velocity channel",
    "level_error": "reference channel",
    "mains_hum": "cables",
    "added_mass": "mass",
    "air_added_mass": "mass",
    "temperature_drift": "core",
    "amplitude_softening": "core",
    "core_thickness": "core",
    "core_law": "core",
    "partial_debond": "core",
    "substrate_stiffness": "metal",
    "viscous_damping": "remaining damping",
}
"""Every effect, and where it sits."""
OF_THE_CHANNELS_ALONE = ("level_error", "mains_hum")
"""They leave no residual in velocity over acceleration, or none but outliers: not for pairs."""


def draw_severity(name: str, rng: np.random.Generator) -> Severity:
    """How strong an effect is. `core_law` has no number: its law is drawn with the material."""
    return _DRAWS[name](rng)


def _clamp(rng: np.random.Generator) -> Severity:
    along_x = log_uniform(rng, 1e13, 1e14)
    along_z = along_x * (1.0 if rng.random() < 0.5 else 2 ** float(rng.uniform(-1, 1)))
    return {"along_x_n_m3": along_x, "along_z_n_m3": along_z}


def _friction(rng: np.random.Generator) -> Severity:
    """The springs it acts in are part of it. Above 0.25 the plant's elements are no longer an even loss."""
    return {"loss_factor": float(rng.uniform(0.05, 0.25)), **_clamp(rng)}


def _mass(rng: np.random.Generator) -> Severity:
    return {
        "mass_kg": float(rng.uniform(0.002, 0.006)),
        "x_m": float(rng.uniform(0.15, 0.295)),
        "y_m": float(rng.uniform(0.01, 0.19)),
    }


def _drift(rng: np.random.Generator) -> Severity:
    sign = -1.0 if rng.random() < 0.25 else 1.0
    return {
        "kelvin": sign * float(rng.uniform(3, 7)),
        "time_constant_s": float(rng.uniform(200, 700)),
        "c1": float(rng.uniform(7, 11)),
        "c2_kelvin": float(rng.uniform(100, 130)),
    }


def _debond(rng: np.random.Generator) -> Severity:
    wide = float(rng.uniform(0.01, 0.04))
    if rng.random() < 0.5:
        begin = float(rng.uniform(0, 0.3002 - wide))
        return {"along": "x", "from_m": begin, "to_m": begin + wide}
    begin = float(rng.uniform(0, 0.0499 - wide)) + (0.15 if rng.random() < 0.5 else 0.0)
    return {"along": "y", "from_m": begin, "to_m": begin + wide}


def _viscous(rng: np.random.Generator) -> Severity:
    more = rng.random() < 0.6
    return {"scale": float(rng.uniform(1.5, 3.0) if more else rng.uniform(0.0, 0.5))}


def _fixture(rng: np.random.Generator) -> Severity:
    return {
        "frequency_hz": float(rng.uniform(60, 330)),
        "damping_ratio": log_uniform(rng, 0.008, 0.05),
        "gain_rad_m": either_sign(rng, 0.02, 0.1),
    }


_DRAWS: dict[str, Callable[[np.random.Generator], Severity]] = {
    "clamp_compliance": _clamp,
    "clamp_friction": _friction,
    "base_rocking": lambda rng: {"pitch_rad_m": either_sign(rng, 0.02, 0.2)},
    "fixture_resonance": _fixture,
    "spot_offset": lambda rng: {
        "dx_m": either_sign(rng, 0.002, 0.006),
        "dy_m": float(rng.uniform(-3e-3, 3e-3)),
    },
    "absolute_velocity": lambda rng: {},
    "channel_delay": lambda rng: {"delay_s": float(rng.uniform(20e-6, 200e-6))},
    "gain_error": lambda rng: {"factor": 1 + either_sign(rng, 0.01, 0.04)},
    "level_error": lambda rng: {"factor": 1 + either_sign(rng, 0.015, 0.05)},
    "mains_hum": lambda rng: {"noises": float(rng.uniform(6, 25))},
    "added_mass": _mass,
    "air_added_mass": lambda rng: {"density_kg_m3": float(rng.uniform(1.0, 1.3))},
    "temperature_drift": _drift,
    "amplitude_softening": lambda rng: {"k": float(rng.uniform(0.05, 0.2))},
    "core_thickness": lambda rng: {"scale": 1 + either_sign(rng, 0.04, 0.08)},
    "core_law": lambda rng: {},
    "partial_debond": _debond,
    "substrate_stiffness": lambda rng: {"scale": 1 + either_sign(rng, 0.02, 0.06)},
    "viscous_damping": _viscous,
}
