"""The core's law is another: not a fractional Zener, or whatever the specimen names."""

from collections.abc import Mapping

import numpy as np

from fitting.effects.base import EVERY_STRUCTURE, Effect
from fitting.effects.given import Points
from fitting.laws import LAWS, CoreLaw
from fitting.laws.bent_law import BentLaw
from fitting.laws.vicinity import Vicinity


class OtherCoreLawEffect(Effect):
    """The law is replaced: by relaxing or oscillating series, or by one that is only smooth."""

    name = "core_law"
    enters = "core law"
    source = "Ferry (generalised Maxwell); Golla, Hughes and McTavish; natural splines of ln G' and ln eta"
    structures = EVERY_STRUCTURE
    replaces_law = True
    chance = 0.03
    discriminating_test = (
        "a second specimen of another thickness: the law is the same, errors of the specimen are not"
    )

    def laws(self, stated: CoreLaw, points: Points) -> list[CoreLaw]:
        """Near the stated one, of every kind that offers itself (`CoreLaw.alternatives`)."""
        near = Vicinity(np.unique(points.omega) / (2 * np.pi), stated.storage_and_loss)
        return [one for law in LAWS.values() for one in law.alternatives(near)]

    def following(self, found: CoreLaw, stated: CoreLaw, points: Points) -> list[CoreLaw]:
        """Laws with a formula beside one that is only smooth; they may bend where the stated one may."""
        frequency_hz = np.unique(points.omega) / (2 * np.pi)
        curve = Vicinity(frequency_hz, found.storage_and_loss)
        laws = [one for law in LAWS.values() for one in law.following(curve)]
        return [BentLaw.over(one, frequency_hz) for one in laws] if stated.bend_count else laws

    def story(self, u: Mapping[str, float]) -> str:
        return "the core follows another law than the stated one"
