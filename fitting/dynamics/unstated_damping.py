"""Ratios that nobody states: a bare plate rings for all that, and the core's loss is what is left beside it.

Taken as none at all they would be counted as the core's own loss: 4 % of the loss factor of a core of 0.6,
half of it where the whole plate has 0.004.
"""

from dataclasses import replace

import numpy as np

from fitting.specimen import PlateSpecimen

RATIO = 1e-3
"""Of critical: aluminium and steel plates in clamps have 0.03 to 0.4 % (the published one 0.04 to 0.29)."""
TOLERANCE = 1.0
"""Relative, in its logarithm: a factor of e either way."""
MODES = 8
"""As many as a file states."""


def with_unstated_damping(specimen: PlateSpecimen, stated: PlateSpecimen | None = None) -> PlateSpecimen:
    """The specimen with such a ratio, and so wide a tolerance, for each mode of which nothing is known.

    `stated` is the file's where a hammer test has given ratios since: what the test did not read is not known
    either. A file that states ratios, zero among them, says all there is; so does one that is exact.
    """
    stated = stated or specimen
    if specimen.exact or specimen.core is None or stated.modal_ratios:
        return specimen
    ratios = np.zeros(max(MODES, len(specimen.modal_ratios)))
    ratios[: len(specimen.modal_ratios)] = specimen.modal_ratios
    unknown = ratios <= 0
    wide = {f"damping_{k + 1}": TOLERANCE for k in np.flatnonzero(unknown).tolist()}
    return replace(
        specimen,
        modal_ratios=tuple(np.where(unknown, RATIO, ratios).tolist()),
        tolerances={**specimen.tolerances, **wide},
    )
