"""The core's law is another: not a fractional Zener, or whatever the specimen names."""

from collections.abc import Mapping

import numpy as np

from fitting.effects.base import Effect, Points
from fitting.laws import CoreLaw
from fitting.laws.generalised_maxwell import GeneralisedMaxwell
from fitting.laws.ghm import GollaHughesMcTavish
from fitting.laws.smooth import Smooth

_STORAGE_PA, _LOSS = (1e3, 1e10), (1e-3, 5.0)
"""Where another law may begin."""


class OtherCoreLaw(Effect):
    """The law is replaced: by relaxing or oscillating series, or by one that is only smooth."""

    name = "core_law"
    enters = "core law"
    source = "Ferry (generalised Maxwell); Golla, Hughes and McTavish; natural splines of ln G' and ln eta"
    replaces_law = True
    chance = 0.03
    discriminating_test = (
        "a second specimen of another thickness: the law is the same, errors of the plate are not"
    )

    def laws(self, stated: CoreLaw, points: Points) -> list[CoreLaw]:
        """Near the stated one; smooth ones with as many knots as the clusters of points can fix."""
        f = np.unique(points.omega) / (2 * np.pi)
        low, high = float(f[0]), float(f[-1])
        G = np.clip(stated.storage_and_loss(2 * np.pi * np.array([low, high]))[0], *_STORAGE_PA)
        rest, rise = float(0.8 * G[0]), float(max(G[1] - G[0], 0.1 * G[0]))
        tau = [1 / (2 * np.pi * x) for x in (high, np.sqrt(low * high), low)]
        series: list[CoreLaw] = [
            GeneralisedMaxwell(rest, (2 * rise,), (tau[0],)),
            GeneralisedMaxwell(rest, (2 * rise, 0.3 * rise), (tau[0], tau[1])),
            GeneralisedMaxwell(rest, (2 * rise, 0.3 * rise, 0.1 * rise), (tau[0], tau[1], tau[2])),
            GollaHughesMcTavish(rest, (2 * rise / rest,), (1.0,), (2 / tau[0],)),
        ]
        knots = [float(np.exp(q)) for q in np.quantile(np.log(f), np.linspace(0, 1, 6))]
        return [
            *series,
            *(
                _smooth(stated, sorted({knots[k] for k in some}))
                for some in ((0, 3, 5), (0, 1, 3, 5), (0, 1, 2, 3, 4, 5))
            ),
        ]

    def story(self, u: Mapping[str, float]) -> str:
        return "the core follows another law than the stated one"


def _smooth(law: CoreLaw, knots_hz: list[float]) -> Smooth:
    """Through a law at the knots, where that is a material: a fit that went astray may have made it none."""
    G, eta = law.storage_and_loss(2 * np.pi * np.array(knots_hz))
    return Smooth(
        tuple(knots_hz),
        tuple(float(g) for g in np.clip(G, *_STORAGE_PA)),
        tuple(float(e) for e in np.clip(eta, *_LOSS)),
    )
