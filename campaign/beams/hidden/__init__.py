"""Effects that a beam may hide, a file for each place where they sit."""

from campaign.beams.hidden import attached, base_motion, clamp, core, layers
from campaign.beams.hidden.base import HiddenInBeam, Setting

_CLASSES: tuple[type[HiddenInBeam], ...] = (
    attached.HiddenAddedMass,
    attached.HiddenLoosePart,
    attached.HiddenTether,
    attached.HiddenAirAddedMass,
    attached.HiddenSpotOffset,
    clamp.HiddenClampCompliance,
    clamp.HiddenClampFriction,
    clamp.HiddenClampLine,
    clamp.HiddenTreatmentNotGripped,
    clamp.HiddenAxialStress,
    base_motion.HiddenBaseRocking,
    base_motion.HiddenFixtureResonance,
    core.HiddenGradedCore,
    core.HiddenPartialDebond,
    core.HiddenTemperatureDrift,
    core.HiddenAmplitudeSoftening,
    layers.HiddenCoreThickness,
    layers.HiddenSubstrateStiffness,
    layers.HiddenConstrainingStiffness,
    layers.HiddenConstrainingThickness,
    core.HiddenRoomCycles,
    core.HiddenRoomStep,
)
HIDDEN: dict[str, type[HiddenInBeam]] = {h.name: h for h in _CLASSES}
"""Every effect by its name."""
ON_REQUEST = tuple(h.name for h in _CLASSES if h.on_request)
"""What no rotation of kinds has."""

__all__ = ["HIDDEN", "ON_REQUEST", "HiddenInBeam", "Setting"]
