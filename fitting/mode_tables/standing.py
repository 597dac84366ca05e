"""The effects that have a meaning on a specimen whose modes are known."""

from fitting.effects import CATALOGUE
from fitting.effects.base import Effect
from fitting.structures import AnySpecimen


def standing(specimen: AnySpecimen) -> list[Effect]:
    """The forms that effects have on it."""
    return [form for e in CATALOGUE.values() if (form := e.standing_on(specimen)) is not None]
