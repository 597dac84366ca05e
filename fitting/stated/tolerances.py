"""Every kind of stated number and its tolerance.

A tolerance is the standard deviation of a stated number about the truth: relative, in the number's
logarithm, or in its SI unit. Where a specimen names none, a careful laboratory's typical one stands
in (docs/specimen.md).
"""

from dataclasses import dataclass, replace
from math import pi, radians
from typing import Literal, NamedTuple

Unit = Literal["1", "m", "s", "rad", "1/K", "Pa"]
Scope = Literal["alike", "specimen", "mounting", "temperature", "file", "spot", "channel", "chain"]
"""What has a number of its own, however alike it is stated:

* `alike`: nothing; all that is stated alike is the same, as sheets that specimens are cut from.
* `specimen`: each specimen.
* `mounting`: each time that one is mounted.
* `temperature`: each file of one mounting, as what clamps pull goes with the temperature.
* `file`: each file; its spots share it.
* `spot`: each spot, but not again where the specimen stays and is read there once more.
* `channel`: each spot of each file, as channels are calibrated anew or drift.
* `chain`: each pair of accelerometer, or hammer, and laser: alike in all files that are driven alike.
"""


class Shown(NamedTuple):
    """How results show a number."""

    unit: str
    factor: float
    """From SI."""


PLAIN, PERCENT, PERCENT_K = Shown("1", 1.0), Shown("%", 1e2), Shown("%/K", 1e2)
MM, MM2, HZ = Shown("mm", 1e3), Shown("mm^2", 1e6), Shown("Hz", 1.0)
US, DEG = Shown("us", 1e6), Shown("deg", 180 / pi)
GPA, MPA = Shown("GPa", 1e-9), Shown("MPa", 1e-6)
KG_M3, GRAM, KG = Shown("kg/m^3", 1.0), Shown("g", 1e3), Shown("kg", 1.0)


class InFiles(NamedTuple):
    """How files and tables of tolerances say a standard deviation."""

    ending: str
    """Of the file's key."""
    unit: str
    """For people."""
    to_si: float

    @property
    def from_si(self) -> float:
        """Times what is kept, what files and tables say."""
        return 1 / self.to_si


IN_FILES: dict[Unit, InFiles] = {
    "1": InFiles("percent", "%", 1e-2),
    "m": InFiles("mm", "mm", 1e-3),
    "s": InFiles("us", "µs", 1e-6),
    "rad": InFiles("deg", "°", pi / 180),
    "1/K": InFiles("percent", "%/K", 1e-2),
    "Pa": InFiles("mpa", "MPa", 1e6),
}
"""By the unit that a tolerance is kept in."""


class StatedValue(NamedTuple):
    """What a specimen states of one number."""

    in_si: float
    factor: float
    """To the unit of results."""
    unit: str


@dataclass(frozen=True)
class StatedNumber:
    """One kind of stated number."""

    name: str
    unit: Unit
    """1 for a relative tolerance."""
    typical: float
    """Standard deviation of a careful laboratory."""
    why: str
    shown: Shown
    """In results."""
    field: str = ""
    """Where a specimen, or its layer, keeps it in SI; empty where that is a matter of several numbers."""
    unstated: float | None = None
    """In SI, what it is by itself: no specimen states it. None: one does."""
    scope: Scope = "alike"
    """What has one of its own."""
    layer: str = ""
    """Whose it is: `substrate`, `constraining`, `core`, `glue`; empty where it is no layer's."""
    quantity: str = ""
    """What of that layer: `young`, `young_y`."""

    def valued(self, in_si: float) -> "StatedValue":
        """With what a specimen states of it."""
        return StatedValue(in_si, self.shown.factor, self.shown.unit)


_OF_LAYERS: dict[str, tuple[Unit, Shown, str]] = {
    "young": ("1", GPA, "young_pa"),
    "thickness": ("1", MM, "thickness_m"),
    "density": ("1", KG_M3, "density_kg_m3"),
    "poisson": ("1", PLAIN, "poisson"),
    "young_y": ("1", GPA, "young_y_pa"),
    "shear": ("1", GPA, "shear_pa"),
    "angle": ("rad", DEG, "angle_rad"),
    "young_per_k": ("1/K", PERCENT_K, "taken_per_k"),
}
"""What is the same of every layer's: unit of the tolerance, how it is shown, where it is kept."""


def _of_layer(layer: str, quantity: str, typical: float, why: str) -> StatedNumber:
    unit, shown, field = _OF_LAYERS[quantity]
    return StatedNumber(
        f"{layer}_{quantity}", unit, typical, why, shown, field, layer=layer, quantity=quantity
    )


_STATED = (
    _of_layer("substrate", "young", 0.01, "rolled sheet from one data sheet to another"),
    _of_layer("substrate", "thickness", 0.005, "a micrometer at several places of a sheet"),
    _of_layer("substrate", "density", 0.005, "plate weighed, sides by caliper"),
    _of_layer("substrate", "poisson", 0.02, "data sheets of metals"),
    _of_layer("constraining", "young", 0.01, "as the substrate's"),
    _of_layer("constraining", "thickness", 0.015, "a foil: a micrometer's few micrometres"),
    _of_layer("constraining", "density", 0.005, "as the substrate's"),
    _of_layer("constraining", "poisson", 0.02, "as the substrate's"),
    _of_layer("core", "thickness", 0.03, "the difference of two thicknesses, or a data sheet"),
    _of_layer("core", "density", 0.02, "data sheets of polymers"),
    _of_layer("core", "poisson", 0.01, "rubbery: between 0.48 and 0.5"),
    StatedNumber("length", "m", 3e-4, "where the clamp's edge bites", MM, "length_m", scope="mounting"),
    StatedNumber("width", "m", 1e-4, "a caliper", MM, "width_m", scope="specimen"),
    StatedNumber(
        "pickup",
        "m",
        3e-4,
        "a laser's spot of half a millimetre, placed by a rule; each coordinate",
        MM,
        "pickup_m",
        scope="spot",
    ),
    StatedNumber(
        "force",
        "m",
        1e-3,
        "a hammer aimed by hand at a mark; each coordinate",
        MM,
        "force_m",
        scope="file",
    ),
    StatedNumber(
        "damping",
        "1",
        0.1,
        "a bare plate's ratios from one mounting to the next; each mode",
        PERCENT,
        scope="mounting",
    ),
    StatedNumber("gain", "1", 0.003, "two calibrated channels", PLAIN, unstated=1.0, scope="channel"),
    StatedNumber(
        "delay",
        "s",
        2e-6,
        "decoder against accelerometer, a known delay taken out",
        US,
        unstated=0.0,
        scope="channel",
    ),
    StatedNumber(
        "phase",
        "rad",
        radians(0.1),
        "decoder against accelerometer, what a delay leaves",
        DEG,
        unstated=0.0,
        scope="chain",
    ),
    StatedNumber(
        "mass", "1", 0.02, "what sits on the plate, on a letter balance", GRAM, "mass_kg", scope="specimen"
    ),
    StatedNumber(
        "place",
        "m",
        5e-4,
        "where a mass sits, by a rule from the free end; each coordinate",
        MM,
        scope="mounting",
    ),
    StatedNumber("area", "1", 0.01, "a disc's diameters by caliper", MM2, "area_m2"),
    StatedNumber(
        "axial",
        "Pa",
        2e6,
        "clamps on both sides pull it along: a kelvin against its frame, or a hundredth of a "
        "millimetre as they are tightened",
        MPA,
        "axial_pa",
        scope="temperature",
    ),
    _of_layer("substrate", "young_per_k", 2e-4, "from steel to aluminium; stated, half of it"),
    _of_layer("constraining", "young_per_k", 2e-4, "as the substrate's"),
    _of_layer("substrate", "young_y", 0.03, "a laminate's or a rolled sheet's second axis"),
    _of_layer("substrate", "shear", 0.05, "seldom measured"),
    _of_layer("substrate", "angle", radians(1.0), "a laminate cut by a square"),
    _of_layer("constraining", "young_y", 0.03, "as the substrate's"),
    _of_layer("constraining", "shear", 0.05, "as the substrate's"),
    _of_layer("constraining", "angle", radians(1.0), "as the substrate's"),
    _of_layer("glue", "thickness", 0.2, "a bond line: hardly ever measured"),
    # As its file has it: glue is a hundredth of what a face is.
    replace(_of_layer("glue", "shear", 0.2, "data sheets of adhesives"), shown=MPA),
    StatedNumber("patch", "m", 5e-4, "laid by a rule; each patch, along x and along y", MM),
    StatedNumber("cut", "m", 5e-4, "cut by a knife along a rule; each patch, along x and along y", MM),
)
STATED: dict[str, StatedNumber] = {s.name: s for s in _STATED}
"""Every kind of stated number by its name, in the order in which results list them."""
OF_THEORY = {
    "held_width": StatedNumber(
        "held_width", "m", 0.0, "what clamps do to a beam's width, as a shorter span", MM
    ),
    "core_stretch": StatedNumber(
        "core_stretch", "1", 0.0, "how far a beam's core lets its faces move apart", PLAIN, unstated=1.0
    ),
    "metal_loss": StatedNumber(
        "metal_loss", "1", 0.0, "what a beam's metal and its clamp lose by themselves", PLAIN, unstated=0.0
    ),
    "resonance": StatedNumber(
        "resonance", "1", 0.0, "where a narrow resonance lies, by the plate's theory", HZ
    ),
    "loss": StatedNumber(
        "loss", "1", 0.0, "the loss factor of a narrow resonance, by the plate's theory", PLAIN
    ),
    "theory": StatedNumber("theory", "1", 0.0, "how much of what exact elasticity says it is off", PLAIN),
    "free_edges": StatedNumber(
        "free_edges", "1", 0.0, "what free edges of a pair's discs take of G A/t", PLAIN, unstated=1.0
    ),
}
"""Numbers that a theory leaves open: nobody states them, and no file names them."""
NUMBERS = STATED | OF_THEORY
"""Every kind of either."""


def of_scope(*scopes: Scope) -> tuple[str, ...]:
    """Kinds of numbers that these have of their own, in the order of `NUMBERS`."""
    return tuple(name for name, number in NUMBERS.items() if number.scope in scopes)


OF_NARROW = ("resonance", "loss", "theory")
"""Those of narrow resonances (`fitting.nuisances.narrow`)."""
ADDED = ("gain", "metal_loss", "loss", "theory")
"""Numbers without a unit that are off by so much; the others are by a factor."""

OF_CHANNELS = ("gain", "delay", "phase")
"""Numbers of what reads it; amplitudes feel the first alone."""
OF_TEMPERATURE = ("substrate_young_per_k", "constraining_young_per_k")
"""Numbers that play a part where data are of several temperatures."""
STATED_PER_K = 0.5
"""Of the typical standard deviation of a metal's change for a kelvin, where the file states it."""
OF_OWN_AXES = (
    *("substrate_young_y", "substrate_shear", "substrate_angle"),
    *("constraining_young_y", "constraining_shear", "constraining_angle"),
)
"""Those of orthotropic faces alone."""
OF_FEW = (*OF_OWN_AXES, "glue_thickness", "glue_shear", "patch", "cut")
"""Numbers that only orthotropic faces, glue and patches have."""
PLATE = (
    *("substrate_young", "substrate_thickness", "substrate_density", "substrate_poisson"),
    *("constraining_young", "constraining_thickness", "constraining_density", "constraining_poisson"),
    *("core_thickness", "core_density", "core_poisson", "length", "width"),
    *OF_FEW,
    "axial",
)
"""Those that change a plate's matrices."""
