"""Names of the parts whose sums a plate's matrices are (`fitting.plate.parts`), in their order."""

from dataclasses import dataclass

from fitting.plate.mesh import is_turned
from fitting.plate.part_counts import PartCounts
from fitting.specimen import PlateSpecimen
from fitting.stated.patches import shifts_of

MEMBRANE = ("11", "22", "12", "66 yy", "66 xx", "66 xy")
_BENDING = ("11", "22", "12", "66")
STIFFNESS = (
    *(f"stretch b {t}" for t in MEMBRANE),
    *(f"stretch c {t}" for t in MEMBRANE),
    *(f"bend {t}" for t in _BENDING),
)
CORE = ("slip x", "slip y", "slip bend x", "slip bend y", "bend x", "bend y", "stretch")
MASS = ("w", "u b", "u c", "core u", "core u bend x", "core u bend y", "core bend x", "core bend y")
TURNED = ("16 y", "16 x", "26 y", "26 x")
_BENDING_TURNED = ("16", "26")
OFF_AXIS = (
    *(f"stretch b {t}" for t in TURNED),
    *(f"stretch c {t}" for t in TURNED),
    *(f"bend {t}" for t in _BENDING_TURNED),
)
"""Of faces whose own axes are not the plate's, behind `STIFFNESS`."""
PATCHED = tuple(f"bend c {t}" for t in _BENDING)
PATCHED_OFF_AXIS = tuple(f"bend c {t}" for t in _BENDING_TURNED)
"""Where not all of the plate is treated: `bend` is then the substrate's alone."""
W_TREATED, GLUE = "w treated", "glue"
"""Behind those: inertia of the treatment up and down; the slip beside the core, of glue or of faces that
shear, in inertia the glue's alone."""
SHEARED = (
    *(f"turn {t}" for t in ("11", "22", "12 x", "12 y", "66 x", "66 y")),
    *(f"section {t}" for t in MEMBRANE),
)
"""Of faces that the core shears, behind `GLUE`: curvatures times the slip's derivatives, then these alone."""
PULLED = {"x": "pull x", "y": "pull y"}
"""Along clamps on opposite edges."""


@dataclass(frozen=True)
class Names:
    """Names of the parts of one plate, in their order."""

    K_0: tuple[str, ...]
    K_1: tuple[str, ...]
    M: tuple[str, ...]

    @property
    def counts(self) -> PartCounts:
        """How many of each."""
        return PartCounts(len(self.K_0), len(self.K_1), len(self.M))


def names_of(specimen: PlateSpecimen) -> Names:
    """Names of all parts in order: the common ones, then those for turned axes, patches, slip, pull, shifts.

    No shape.
    """
    K_0: tuple[str, ...] = STIFFNESS
    M: tuple[str, ...] = MASS
    turned = is_turned(specimen)
    if turned:
        K_0 += OFF_AXIS
    if specimen.patches:
        K_0 += PATCHED + (PATCHED_OFF_AXIS if turned else ())
        M += (W_TREATED,)
    if specimen.slips:
        K_0 += (GLUE, *SHEARED) if specimen.faces_shear else (GLUE,)
        M += (GLUE,)
    K_0 += tuple(PULLED[a] for a in specimen.pulled_along)
    shifts = tuple(shift.name for shift in shifts_of(specimen))
    return Names(K_0 + shifts, CORE + shifts, M + shifts)
