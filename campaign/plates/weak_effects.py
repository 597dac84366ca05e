"""Cases of which one sweep leaves a group: a weak effect on a plate whose numbers are well known."""

from dataclasses import fields, replace

import numpy as np
from numpy.typing import NDArray

from campaign.draws import either_sign, log_uniform
from campaign.plates.cases import draw_case, measured
from campaign.plates.channel import ChannelError
from campaign.plates.geometry import TruePlate
from campaign.plates.hidden.attached import HiddenAirAddedMass
from campaign.plates.hidden.base import Hidden
from campaign.plates.hidden.channels import HiddenGainError, HiddenSpotOffset
from campaign.plates.hidden.clamp import (
    BETWEEN,
    BOLTS,
    REACH,
    HiddenClampCompliance,
    HiddenClampFriction,
)
from campaign.plates.hidden.core import HiddenAmplitudeSoftening
from campaign.plates.hidden.layers import HiddenSubstrateStiffness
from campaign.plates.hidden.sizes import ACROSS, AIR_KG_M3, FRICTION_LOSS
from campaign.plates.judged import models_of
from campaign.plates.remeasured import RemeasuredPlate
from campaign.plates.stated import CAREFUL, CampaignTolerances, draw_stated, specimen_from, toml
from campaign.schedule import Schedule
from fitting.gravity import PUBLISHED_G_M_S2
from instrument.models.files import File

WEAK = (
    "substrate_stiffness",
    "gain_error",
    "air_added_mass",
    "clamp_compliance",
    "spot_offset",
    "clamp_friction",
    "amplitude_softening",
)
"""Kinds of successive cases."""
PLATES = ("P2", "P3")
"""Two of the campaign's ten: models of further spots are made once a plate."""
POINTS = 40
"""Of a segment, at most: a diagnosis takes half the time of one of all points."""
SHARE = 0.3
"""Of a careful laboratory's tolerances: of what these allow one sweep names little, and no group is left."""
_AS_CAREFUL = ("pickup_m", "damping")
MEASURED_WELL = CampaignTolerances(
    **{f.name: (1.0 if f.name in _AS_CAREFUL else SHARE) * getattr(CAREFUL, f.name) for f in fields(CAREFUL)}
)

_SIZES = {
    "substrate_stiffness": (0.03, 0.06),
    "gain_error": (0.007, 0.014),
    "amplitude_softening": (0.012, 0.04),
    "spot_offset": (1.6e-3, 3e-3),
    "clamp_compliance": (2e-3, 8e-3),
}
"""Of stiffness, gain and modulus, in m, and of a root's softness: one sweep may leave a group of each."""


def weak(kind: str, rng: np.random.Generator, plate: TruePlate) -> Hidden:
    """An effect of a size that one sweep may not tell from others. Raises `KeyError` for another kind."""
    if kind == "substrate_stiffness":
        return HiddenSubstrateStiffness(scale=1 + either_sign(rng, *_SIZES["substrate_stiffness"]))
    if kind == "gain_error":
        return HiddenGainError(factor=1 + either_sign(rng, *_SIZES["gain_error"]))
    if kind == "air_added_mass":
        return HiddenAirAddedMass(density_kg_m3=float(rng.uniform(*AIR_KG_M3)))
    if kind == "amplitude_softening":
        return HiddenAmplitudeSoftening(k=log_uniform(rng, *_SIZES["amplitude_softening"]), most=0.5)
    if kind == "spot_offset":
        size, angle = rng.uniform(*_SIZES["spot_offset"]), rng.uniform(0, 2 * np.pi)
        return HiddenSpotOffset(dx_m=float(size * np.cos(angle)), dy_m=float(size * np.sin(angle)))
    if kind == "clamp_friction":
        held = _clamp(rng, plate)
        return HiddenClampFriction(**held.facts, loss=float(rng.uniform(*FRICTION_LOSS)))
    if kind == "clamp_compliance":
        return _clamp(rng, plate)
    raise KeyError(kind)


def _clamp(rng: np.random.Generator, plate: TruePlate) -> HiddenClampCompliance:
    along_x = plate.substrate.young_pa / (log_uniform(rng, *_SIZES["clamp_compliance"]) * plate.length_m)
    bolts = int(rng.integers(*BOLTS))
    reach = float(rng.uniform(*REACH)) * plate.width_m / bolts
    along_z = along_x * float(rng.uniform(*ACROSS))
    return HiddenClampCompliance(along_x, along_z, bolts, reach, float(rng.uniform(*BETWEEN)))


def draw_weak(kind: str, seed: int) -> RemeasuredPlate:
    """A rig with one sweep at 1 g of a plate with an effect of one of `WEAK`."""
    plate = PLATES[seed % len(PLATES)]
    clean = draw_case("none", seed, plate=plate)
    sweep = clean.sweep.take(_thinned(clean.sweep.segment, clean.sweep.commanded_m_s2))
    rng = np.random.default_rng([seed, *kind.encode()])
    true = clean.truth.plate
    off = *rng.standard_normal(2), np.random.default_rng([seed, *b"phase"]).standard_normal()
    channel = ChannelError.within(MEASURED_WELL, off)
    truth = replace(clean.truth, effects=(weak(kind, rng, true),), channel=channel)
    text = toml(draw_stated(rng, true, MEASURED_WELL), MEASURED_WELL, clean.truth.resonances_hz[1])
    assert sweep.time_s is not None
    level_g = sweep.commanded_m_s2 / PUBLISHED_G_M_S2
    schedule = Schedule(sweep.frequency_hz, sweep.segment, sweep.sweep, level_g, sweep.time_s)
    file = File(sweep, specimen_from(text), like=models_of(plate))
    rig = RemeasuredPlate(truth, schedule, (file,), None, float(np.ptp(sweep.time_s)))
    return replace(rig, files=(replace(file, sweep=measured(truth, rig.plate, schedule, rng)),))


def _thinned(segment: NDArray[np.intp], commanded_m_s2: NDArray[np.float64]) -> NDArray[np.intp]:
    """Places of `POINTS` of each segment, at the highest level."""
    highest = commanded_m_s2 > 0.999 * commanded_m_s2.max()
    every = [np.flatnonzero(highest & (segment == k)) for k in np.unique(segment)]
    return np.sort(
        np.concatenate(
            [
                its[np.unique(np.linspace(0, len(its) - 1, min(POINTS, len(its))).round().astype(int))]
                for its in every
            ]
        )
    )
