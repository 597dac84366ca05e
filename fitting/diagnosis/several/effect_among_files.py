"""What an effect is among several files or spots: common to all, of one of them, or between them."""

from collections.abc import Sequence

from fitting.diagnosis.several.between_files import BetweenFiles
from fitting.diagnosis.several.of_files import OfFiles
from fitting.effects.base import Effect

_OF_A_SPOT = ("observation", "channel")
"""Entries of effects that may be in the readings at one spot alone: each spot is read by itself."""
_OF_THE_PLATE = ("stiffness", "damping", "core law")
"""Entries of effects of the plate itself: one plate has them alike in all its files, however it is driven."""
_STAYS = ("mass", "load")
"""Entries of effects that are on the plate or of its rig: of files of one plate seldom one alone has them."""


def among(
    effect: Effect,
    files: int,
    spots: Sequence[int],
    *,
    one_plate: bool = False,
    mounted: Sequence[int] = (),
) -> Effect:
    """An effect among so many files, of which some have several spots.

    Of `one_plate`, measured again in every file, what is of the plate itself is of all of them, and what is
    on it, or of the rig, seldom of one alone. `mounted` as `OfFiles` has it.
    """
    if effect.between_files:
        # One plate has one core: there it does not stand.
        able = files > 1 and not (one_plate and effect.enters in _OF_THE_PLATE)
        return BetweenFiles(effect, files) if able else effect
    if files == 1 and not (spots and effect.enters in _OF_A_SPOT):
        return effect
    by_spot = tuple(spots) if effect.enters in _OF_A_SPOT else ()
    apart = not (one_plate and effect.enters in _OF_THE_PLATE)
    stays = one_plate and effect.enters in _STAYS
    return OfFiles(effect, files, spots=by_spot, apart=apart, stays=stays, mounted=tuple(mounted))
