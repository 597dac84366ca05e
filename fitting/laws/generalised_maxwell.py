"""Generalised Maxwell (Wiechert) model: a spring beside a row of relaxing elements."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from fitting.arrays import Array, Complex
from fitting.errors import OutsideModel
from fitting.laws.base import CoreLaw, quantity
from fitting.laws.prony import series_of
from fitting.laws.vicinity import Vicinity

_TERMS = 3
"""With a bend of a few percent, three follow any material over the two decades of a sweep."""


@dataclass(frozen=True)
class GeneralisedMaxwell(CoreLaw):
    """G* = G_inf + sum_k G_k i omega tau_k / (1 + i omega tau_k), G_inf the long-time modulus."""

    kind: ClassVar[str] = "generalised-maxwell"
    source: ClassVar[str] = "Ferry, Viscoelastic Properties of Polymers"

    g_inf_pa: float = quantity("g_inf_mpa", to_si=1e6, lower=1e2, upper=1e11, search=(1e4, 1e7))
    g_pa: tuple[float, ...] = quantity("g_mpa", to_si=1e6, lower=1e1, upper=1e11, search=(1e4, 1e7))
    tau_s: tuple[float, ...] = quantity("tau_s", lower=1e-10, upper=1e4, search=(1e-5, 1e-1))

    def __post_init__(self) -> None:
        super().__post_init__()
        if len(self.g_pa) != len(self.tau_s) or not self.g_pa:
            raise OutsideModel(
                f"core law {self.kind}: {len(self.g_pa)} g_mpa and {len(self.tau_s)} tau_s, "
                "expected as many of one as of the other, at least one"
            )

    @classmethod
    def alternatives(cls, near: Vicinity) -> list[CoreLaw]:
        (rest, rise), tau = near.rest_and_rise_pa, near.times_s
        return [
            cls(rest, (2 * rise,), (tau[0],)),
            cls(rest, (2 * rise, 0.3 * rise), (tau[0], tau[1])),
            cls(rest, (2 * rise, 0.3 * rise, 0.1 * rise), (tau[0], tau[1], tau[2])),
        ]

    @classmethod
    def following(cls, curve: Vicinity) -> list[CoreLaw]:
        def modulus(omega: Array) -> Complex:
            storage, loss = curve.storage_and_loss(omega)
            return np.asarray(storage * (1 + 1j * loss))

        series = series_of(modulus, *curve.ends_hz, _TERMS)
        least = cls.quantities()["g_inf_pa"].lower
        return [
            cls(max(series.g_inf_pa, least), tuple(map(float, series.g_pa)), tuple(map(float, series.tau_s)))
        ]

    def modulus(self, omega: Array) -> Complex:
        s = 1j * np.multiply.outer(np.array(self.tau_s), omega)
        return np.asarray(self.g_inf_pa + np.tensordot(np.array(self.g_pa) + 0j, s / (1 + s), axes=1))

    def jacobian(self, omega: Array) -> Complex:
        one = np.ones((1, *np.shape(omega)), dtype=complex)
        s = 1j * np.multiply.outer(np.array(self.tau_s), omega)
        scale = (np.array(self.g_pa) / np.array(self.tau_s))[:, None]
        return np.concatenate([one, s / (1 + s), scale * s / (1 + s) ** 2])
