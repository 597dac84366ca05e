"""How well a law is known as a whole: the covariance of its curve, not of its points one by one."""

from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any

import numpy as np
from pydantic import ValidationError

from fitting.arrays import Array
from fitting.errors import FittingError
from fitting.laws import LAWS, CoreLaw
from instrument.errors import BadInput
from instrument.results.fit_file import FoundLaw


@dataclass(frozen=True)
class LawPosterior:
    """The fit's own covariance of a law's parameters and bend."""

    law: CoreLaw
    covariance_of_logs: Array
    by_stated: Array | None = None
    """What a stated number's tolerance gives each of them, shape (law's numbers, stated numbers).

    None where it is not known.
    """

    def curve(self, frequency_hz: Array) -> Array:
        """Covariance of ln G' at the frequencies, then of eta. Shape (2 frequencies, 2 frequencies)."""
        return self._of_curve(frequency_hz, self.covariance_of_logs)

    def curve_of_another_measurement(self, frequency_hz: Array) -> Array:
        """How far curves scatter that are measured of one law: the same, less what its bend's prior leaves.

        A fit draws its bend towards none, in two measurements of one law by as much. With F what data say and
        L what is known beforehand C = (F + L)^-1, and estimates scatter by C F C = C - C L C. Shape (2
        frequencies, 2 frequencies).
        """
        C, bend = self.covariance_of_logs, self.law.bend_count
        # Of unit width, the last ones.
        known = C[:, len(C) - bend :]
        return self._of_curve(frequency_hz, C - known @ known.T)

    def stated_part(self, frequency_hz: Array) -> Array | None:
        """The part of the errors of ln G', then of eta, that stated numbers make. Shape (2 frequencies,)."""
        if self.by_stated is None:
            return None
        return np.asarray(np.linalg.norm(self._slopes(frequency_hz).T @ self.by_stated, axis=1))

    def _of_curve(self, frequency_hz: Array, C: Array) -> Array:
        J = self._slopes(frequency_hz)
        return np.asarray(J.T @ C @ J)

    def _slopes(self, frequency_hz: Array) -> Array:
        """Of ln G', then of eta, to the logarithms. Shape (law's numbers, 2 frequencies)."""
        omega = 2 * np.pi * frequency_hz
        storage, eta = self.law.storage_and_loss(omega)
        by = self.law.jacobian(omega) * self.law.values[:, None]
        return np.concatenate([by.real / storage, (by.imag - eta * by.real) / storage], axis=1)


def posterior_of(facts: Any) -> LawPosterior | None:
    """Of the JSON of `identify`; None where it does not hold enough of it."""
    try:
        found = FoundLaw.model_validate(facts)
        law = found.law(formula(found.law_kind, found.parameters))
    except (ValidationError, BadInput, FittingError, KeyError, ValueError, TypeError):
        return None
    if found.posterior is not None and set(law.names) <= set(found.posterior.names):
        n, stated = len(law.names), [one.name for one in found.adjusted]
        C = found.posterior.covariance([*law.names, *stated])
        # A tolerance is a row of the fit like a reading, of slope 1 to its own number: what such a row passes
        # on to another number is the covariance of both.
        return LawPosterior(law, C[:n, :n], C[:n, n:])
    plain = found.covariance(law.plain.names)
    return LawPosterior(law.plain, plain) if found.bend is None and np.isfinite(plain).all() else None


def formula(kind: str, parameters: Mapping[str, float]) -> CoreLaw:
    """A law of the kind with these parameters, no bend in it.

    Raises `KeyError` for a kind that needs more than those.
    """
    cls = LAWS[kind]
    if set(cls.file_fields()) - set(cls.quantities()):
        raise KeyError(f"{kind} has numbers that are not parameters")
    return cls(**{f.name: _values(parameters, f.name) for f in fields(cls) if f.name in cls.quantities()})


def _values(parameters: Mapping[str, float], name: str) -> float | tuple[float, ...]:
    """A parameter, or a list's items in their order: g_pa from g_1_pa, g_2_pa, ..."""
    if name in parameters:
        return parameters[name]
    stem, _, unit = name.partition("_")
    items: list[float] = []
    while (key := f"{stem}_{len(items) + 1}" + (f"_{unit}" if unit else "")) in parameters:
        items.append(parameters[key])
    if not items:
        raise KeyError(name)
    return tuple(items)
