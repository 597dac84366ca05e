"""Effects that a case may hide, a file for each place where they sit."""

import numpy as np

from campaign.draws import two_apart
from campaign.plates.hidden import attached, base_motion, channels, clamp, core, layers, strange
from campaign.plates.hidden.base import Hidden, Setting

_CLASSES: tuple[type[Hidden], ...] = (
    clamp.HiddenClampCompliance,
    clamp.HiddenClampLine,
    clamp.HiddenTreatmentNotGripped,
    clamp.HiddenUnevenClamp,
    layers.HiddenConstrainingStiffness,
    layers.HiddenConstrainingThickness,
    layers.HiddenSubstrateStiffness,
    layers.HiddenOrthotropicSubstrate,
    layers.HiddenCoreThickness,
    core.HiddenGradedCore,
    core.HiddenPartialDebond,
    core.HiddenTemperatureDrift,
    core.HiddenAmplitudeSoftening,
    attached.HiddenAddedMass,
    attached.HiddenAirAddedMass,
    attached.HiddenTether,
    base_motion.HiddenBaseRocking,
    base_motion.HiddenBaseRoll,
    base_motion.HiddenFixtureResonance,
    channels.HiddenSpotOffset,
    channels.HiddenAbsoluteVelocity,
    channels.HiddenChannelDelay,
    channels.HiddenGainError,
    channels.HiddenSensorLowpass,
    channels.HiddenAcCoupling,
    channels.HiddenPhaseScale,
    channels.HiddenViscousDamping,
    attached.HiddenAddedMasses,
    attached.HiddenLoosePart,
    layers.HiddenMissingPiece,
    attached.HiddenTipMagnet,
    strange.HiddenCrackedSubstrate,
    strange.HiddenWrinkledConstraining,
    strange.HiddenStiffener,
    strange.HiddenBlister,
    core.HiddenRoomCycles,
    core.HiddenRoomStep,
)
HIDDEN: dict[str, type[Hidden]] = {h.name: h for h in _CLASSES}
"""Every effect by its name; those of the diagnosis's catalogue first."""
STRANGE = tuple(h.name for h in _CLASSES if not h.in_catalogue)
"""What no catalogue has."""
ON_REQUEST = tuple(h.name for h in _CLASSES if h.on_request)
"""What no rotation of kinds has."""


def names_of(kind: str, rng: np.random.Generator) -> tuple[str, ...]:
    """Names of the effects of a kind of case."""
    if kind == "none":
        return ()
    if kind != "pair":
        return (kind,)
    return two_apart(rng, {h.name: h.place for h in _CLASSES if h.in_catalogue})


def draw_hidden(names: tuple[str, ...], rng: np.random.Generator, at: Setting) -> tuple[Hidden, ...]:
    """An effect of each name."""
    return tuple(HIDDEN[name].draw(rng, at) for name in names)
