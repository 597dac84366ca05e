"""What is stated is not known: every kind of stated number with its tolerance.

A tolerance is the standard deviation of a stated number about the truth: relative, in the number's
logarithm, or in its SI unit. Where a specimen names none, a careful laboratory's typical one stands
in (docs/specimen.md).
"""

from dataclasses import dataclass
from math import radians
from typing import Literal

Unit = Literal["1", "m", "s", "rad", "1/K", "Pa"]


@dataclass(frozen=True)
class StatedNumber:
    """One kind of stated number."""

    name: str
    unit: Unit
    """1 for a relative tolerance."""
    typical: float
    """Standard deviation of a careful laboratory."""
    why: str


_STATED = (
    StatedNumber("substrate_young", "1", 0.01, "rolled sheet from one data sheet to another"),
    StatedNumber("substrate_thickness", "1", 0.005, "a micrometer at several places of a sheet"),
    StatedNumber("substrate_density", "1", 0.005, "plate weighed, sides by caliper"),
    StatedNumber("substrate_poisson", "1", 0.02, "data sheets of metals"),
    StatedNumber("constraining_young", "1", 0.01, "as the substrate's"),
    StatedNumber("constraining_thickness", "1", 0.015, "a foil: a micrometer's few micrometres"),
    StatedNumber("constraining_density", "1", 0.005, "as the substrate's"),
    StatedNumber("constraining_poisson", "1", 0.02, "as the substrate's"),
    StatedNumber("core_thickness", "1", 0.03, "the difference of two thicknesses, or a data sheet"),
    StatedNumber("core_density", "1", 0.02, "data sheets of polymers"),
    StatedNumber("core_poisson", "1", 0.01, "rubbery: between 0.48 and 0.5"),
    StatedNumber("length", "m", 3e-4, "where the clamp's edge bites"),
    StatedNumber("width", "m", 1e-4, "a caliper"),
    StatedNumber(
        "pickup", "m", 3e-4, "a laser's spot of half a millimetre, placed by a rule; each coordinate"
    ),
    StatedNumber("force", "m", 1e-3, "a hammer aimed by hand at a mark; each coordinate"),
    StatedNumber("damping", "1", 0.1, "a bare plate's ratios from one mounting to the next; each mode"),
    StatedNumber("gain", "1", 0.003, "two calibrated channels"),
    StatedNumber("delay", "s", 2e-6, "decoder against accelerometer, a known delay taken out"),
    StatedNumber("phase", "rad", radians(0.1), "decoder against accelerometer, what a delay leaves"),
    StatedNumber("mass", "1", 0.02, "what sits on the plate, on a letter balance"),
    StatedNumber("place", "m", 5e-4, "where a mass sits, by a rule from the free end; each coordinate"),
    StatedNumber("area", "1", 0.01, "a disc's diameters by caliper"),
    StatedNumber(
        "axial",
        "Pa",
        2e6,
        "clamps on both sides pull it along: a kelvin against its frame, or a hundredth of a "
        "millimetre as they are tightened",
    ),
    StatedNumber("substrate_young_per_k", "1/K", 2e-4, "from steel to aluminium; stated, half of it"),
    StatedNumber("constraining_young_per_k", "1/K", 2e-4, "as the substrate's"),
    StatedNumber("substrate_young_y", "1", 0.03, "a laminate's or a rolled sheet's second axis"),
    StatedNumber("substrate_shear", "1", 0.05, "seldom measured"),
    StatedNumber("substrate_angle", "rad", radians(1.0), "a laminate cut by a square"),
    StatedNumber("constraining_young_y", "1", 0.03, "as the substrate's"),
    StatedNumber("constraining_shear", "1", 0.05, "as the substrate's"),
    StatedNumber("constraining_angle", "rad", radians(1.0), "as the substrate's"),
    StatedNumber("glue_thickness", "1", 0.2, "a bond line: hardly ever measured"),
    StatedNumber("glue_shear", "1", 0.2, "data sheets of adhesives"),
    StatedNumber("patch", "m", 5e-4, "laid by a rule; each patch, along x and along y"),
    StatedNumber("cut", "m", 5e-4, "cut by a knife along a rule; each patch, along x and along y"),
)
STATED: dict[str, StatedNumber] = {s.name: s for s in _STATED}
"""Every kind of stated number by its name, in the order in which results list them."""
OF_THEORY = {
    "held_width": StatedNumber("held_width", "m", 0.0, "what clamps do to a beam's width, as a shorter span"),
    "core_stretch": StatedNumber("core_stretch", "1", 0.0, "how far a beam's core lets its faces move apart"),
    "metal_loss": StatedNumber(
        "metal_loss", "1", 0.0, "what a beam's metal and its clamp lose by themselves"
    ),
    "resonance": StatedNumber("resonance", "1", 0.0, "where a narrow resonance lies, by the plate's theory"),
    "loss": StatedNumber("loss", "1", 0.0, "the loss factor of a narrow resonance, by the plate's theory"),
    "theory": StatedNumber("theory", "1", 0.0, "how much of what exact elasticity says it is off"),
    "free_edges": StatedNumber("free_edges", "1", 0.0, "what free edges of a pair's discs take of G A/t"),
}
"""Numbers that a theory leaves open: nobody states them, and no file names them."""
OF_NARROW = ("resonance", "loss", "theory")
"""Those of narrow resonances (`fitting.narrow`)."""
ADDED = ("gain", "metal_loss", "loss", "theory")
"""Numbers without a unit that are off by so much; the others are by a factor."""

OF_CHANNELS = ("gain", "delay", "phase")
"""Numbers of what reads it; amplitudes feel the first alone."""
OF_TEMPERATURE = ("substrate_young_per_k", "constraining_young_per_k")
"""Numbers that play a part where data are of several temperatures."""
STATED_PER_K = 0.5
"""Of the typical standard deviation of a metal's change for a kelvin, where the file states it."""
OF_FEW = (
    *("substrate_young_y", "substrate_shear", "substrate_angle"),
    *("constraining_young_y", "constraining_shear", "constraining_angle"),
    *("glue_thickness", "glue_shear", "patch", "cut"),
)
"""Numbers that only orthotropic faces, glue and patches have."""
PLATE = (
    *("substrate_young", "substrate_thickness", "substrate_density", "substrate_poisson"),
    *("constraining_young", "constraining_thickness", "constraining_density", "constraining_poisson"),
    *("core_thickness", "core_density", "core_poisson", "length", "width"),
    *OF_FEW,
    "axial",
)
"""Those that change a plate's matrices."""


def kind_of(name: str) -> str:
    """The kind that one number is of: `pickup` of `pickup_x`. Raises `ValueError`."""
    # Of several files each may have its own: `gain [2]`.
    name = name.split(" [")[0]
    kind, _, number = name.partition("_")
    known = name if name in (STATED | OF_THEORY) else kind
    if known not in (STATED | OF_THEORY) or (kind == "damping" and not number.isdecimal()):
        raise ValueError(f"no stated number is called {name!r}")
    return known
