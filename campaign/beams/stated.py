"""What the specimen file says of a beam: drawn about the truth as a careful lab knows it, all at once."""

import tomllib
from dataclasses import replace

import numpy as np

from campaign.beams.geometry import TrueBeam
from campaign.plates.stated import (
    CAREFUL,
    CampaignTolerances,
    digits,
    law_lines,
    layer_lines,
    stated_core,
    stated_metal,
)
from fitting.structures import Beam
from instrument.files.beam_file import BeamDocument

FORCE_M = 1e-3
"""A hammer aimed by hand at a mark."""
AXIAL_PA = 2e6
"""A kelvin between a beam and what clamps it, or bolts that are tightened."""


def draw_stated(
    rng: np.random.Generator, true: TrueBeam, tolerances: CampaignTolerances = CAREFUL
) -> TrueBeam:
    """The beam as it is believed to be."""
    t = tolerances

    def off(std: float) -> float:
        return std * float(rng.standard_normal())

    length, width, spot = true.length_m + off(t.length_m), true.width_m + off(t.width_m), off(t.pickup_m)
    substrate = stated_metal(rng, true.substrate, t.substrate_thickness, t)
    core, c = stated_core(rng, true.core, t), true.constraining
    constraining = stated_metal(rng, c, t.constraining_thickness, t) if c is not None else None
    force = None if true.force_m is None else true.force_m + off(FORCE_M)
    believed = replace(
        true, length_m=length, width_m=width, substrate=substrate, core=core, constraining=constraining
    )
    return replace(believed, spot_m=min(true.spot_m + spot, believed.span_m), force_m=force)


def toml(
    beam: TrueBeam, tolerances: CampaignTolerances | None, middle_hz: float, *, held_width: bool = False
) -> str:
    """The text of the specimen's file.

    No tolerances: all is exact. The law is where a fit starts, not the answer. `held_width`: that clamps hold
    the width is said, as they do.
    """
    lines = [
        "[beam]",
        f"length_mm = {digits(1e3 * beam.length_m)}",
        f"width_mm = {digits(1e3 * beam.width_m)}",
    ]
    lines += [f'boundary = "{beam.ends}"', *(["both_sides = true"] if beam.both_sides else [])]
    lines += ["held_width = true", ""] if held_width and beam.clamped else [""]
    layers = {"substrate": beam.substrate, "constraining": beam.constraining, "core": beam.core}
    for name, layer in layers.items():
        lines += layer_lines(name, layer) if layer is not None else []
    lines += law_lines(middle_hz, beam.stiffer)
    lines += ["[pickup]", f"x_mm = {digits(1e3 * beam.spot_m)}", f'reads = "{beam.reads}"', ""]
    if beam.force_m is not None:
        lines += ["[excitation]", 'kind = "force"', f"x_mm = {digits(1e3 * beam.force_m)}", ""]
    return "\n".join([*lines, *_tolerance_lines(beam, tolerances)]) + "\n"


def _tolerance_lines(beam: TrueBeam, tolerances: CampaignTolerances | None) -> list[str]:
    """Those of numbers that a beam has."""
    if tolerances is None:
        return ["[tolerances]", "exact = true"]
    absent = ["width", "damping", "substrate_poisson", "constraining_poisson", "core_poisson"]
    absent += ["constraining"] if beam.constraining is None else []
    said = [line for line in tolerances.lines() if not line.startswith(tuple(absent))]
    force = [f"force_mm = {1e3 * FORCE_M:g}"] if beam.force_m is not None else []
    axial = [f"axial_mpa = {1e-6 * AXIAL_PA:g}"] if beam.ends == "clamped-clamped" else []
    return ["[tolerances]", *said, *force, *axial]


def beam_from(text: str) -> Beam:
    """What `viscorig` makes of the file."""
    return BeamDocument.model_validate(tomllib.loads(text)).specimen()
