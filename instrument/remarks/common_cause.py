"""Whether a cause that several files have in common leaves their law less well known."""

import numpy as np

from fitting.arrays import Array
from fitting.diagnosis.several.of_files import ALIKE, FILE
from fitting.diagnosis.verdict.result import Diagnosis
from fitting.digits import two_digits
from fitting.identification.result import LawBand

_WIDER = 1.5
"""Times as wide as without the cause: below it nobody would measure otherwise. A choice."""


def remarks_on_common_causes(result: Diagnosis, files: int) -> tuple[str, ...]:
    """Of several files: where what is found in every one of them makes the band of the law wider.

    `files`: how many there are; one has nothing in common with another. Only what is certain: beside other
    explanations the band is wide because these disagree.
    """
    if files < 2 or result.verdict != "effect":
        return ()
    common = [e.name for e in result.effects if FILE in e.parameters and e.parameters[FILE].value == ALIKE]
    if not common:
        return ()
    wider = {
        name: float(np.median(after / before))
        for (name, before), after in zip(
            _errors(result.before.band).items(), _errors(result.after.band).values(), strict=True
        )
        if np.all(before > 0)
    }
    said = [f"{two_digits(times)} times as wide in {name}" for name, times in wider.items() if times > _WIDER]
    if not said:
        return ()
    causes, sizes = " and ".join(common), " and ".join(said)
    return (
        f"with {causes} in every file the law's band is {sizes} as without: "
        "what all files have is what they tell from the law least; a file without it, or a measurement of it "
        "by itself, would narrow the band",
    )


def _errors(band: LawBand) -> dict[str, Array]:
    """Relative of G', as it is of the loss factor. Shape (frequencies,) each."""
    return {
        "G'": band.storage_modulus_standard_error_pa / band.storage_modulus_pa,
        "the loss factor": band.loss_factor_standard_error,
    }
