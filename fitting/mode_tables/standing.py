"""The effects that have a meaning on specimens whose modes are known."""

from collections.abc import Sequence

from fitting.effects import CATALOGUE
from fitting.effects.base import Effect
from fitting.mode_tables.build import tapped
from fitting.specimen import PlateSpecimen
from fitting.structures import AnySpecimen


def standing(specimens: Sequence[AnySpecimen]) -> list[Effect]:
    """The forms that effects have on all of some specimens, which are of one kind.

    Whatever drives a plate elsewhere, its table has no base.
    """
    struck = [tapped(s) if isinstance(s, PlateSpecimen) else s for s in specimens]
    forms = (e.form_on(struck) for e in CATALOGUE.values())
    return [f for f in forms if f is not None and all(f.needs <= s.offers for s in struck)]
