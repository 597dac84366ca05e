"""A free layer adds little stiffness to its metal: where that is hardly told, G'' is better known than G'.

G' is what is left of a frequency when the metal's part is taken off, so its own error is that of the metal
(0.5 % of a thickness is 1.5 % of a stiffness), alike for all modes and normal in G', not in its logarithm.
The loss that is measured is the layer's alone, in proportion to G''. So eta = G''/G' is as wrong as G' is,
the other way, and not by as much up as down: its interval is looked for by profile likelihood.
"""

from collections.abc import Callable, Sequence

import numpy as np

from fitting.arrays import Array
from fitting.depth.profile import profile
from fitting.depth.quantities import Quantities
from fitting.digits import two_digits
from fitting.laws import CoreLaw
from fitting.structures import AnySpecimen, ShearPair

_HARDLY = 0.15
"""Relative error of G' from which eta two errors off is a third and more larger, against a fifth smaller."""
_BETTER = 0.5
"""Of that error, the most that G'' may have for it to be said that it is better known. A choice."""
_POINTS = 41


def remark_on_free_layers(
    specimens: Sequence[AnySpecimen],
    law: CoreLaw,
    covariance: Array,
    band_hz: tuple[float, float],
    quantities: Callable[[Array], Quantities],
) -> tuple[str, ...]:
    """Between what the loss factor lies, where G' of a free layer is hardly known.

    `covariance` of the law's log parameters, shape (names, names); `quantities` of the fit at frequencies in
    Hz. Empty for other specimens.
    """
    if not all(_is_free(s) for s in specimens) or not np.isfinite(covariance).all():
        return ()
    f = np.geomspace(*band_hz, _POINTS)
    G, eta = law.storage_and_loss(2 * np.pi * f)
    by_log = law.jacobian(2 * np.pi * f) * law.values[:, None]
    with np.errstate(all="ignore"):
        storage, loss = _error(by_log.real / G, covariance), _error(by_log.imag / (eta * G), covariance)
    k = int(np.argmax(np.where(loss < _BETTER * storage, storage, 0.0)))
    if not (storage[k] > _HARDLY and loss[k] < _BETTER * storage[k]):
        return ()
    low, high = profile(quantities(f[k : k + 1]), only=[-1]).bounds[95][-1]
    return (
        f"G' of a free layer is hardly known: at {f[k]:.3g} Hz to {two_digits(100 * storage[k])} %, G'' to "
        f"{two_digits(100 * loss[k])} %. G'' is what was measured, so the loss factor's error is no normal "
        f"one: it is {two_digits(eta[k])} there, with 95 % {_between(low, high)} by profile likelihood "
        "(--uncertainty profile says it of others). What tells more: a thicker layer, thinner metal, or the "
        "metal's stiffness measured bare, stated with its tolerance",
    )


def _between(low: float, high: float) -> str:
    """Open where chi-square does not rise far enough to set a bound."""
    if np.isnan(high):
        return "without an upper bound" if np.isnan(low) else f"above {two_digits(low)}"
    return f"below {two_digits(high)}" if np.isnan(low) else f"{two_digits(low)} to {two_digits(high)}"


def _is_free(specimen: AnySpecimen) -> bool:
    return not isinstance(specimen, ShearPair) and specimen.core is not None and specimen.constraining is None


def _error(by_log: Array, covariance: Array) -> Array:
    """Standard error of a logarithm. `by_log` of shape (names, frequencies)."""
    return np.sqrt(np.maximum(np.einsum("if,ij,jf->f", by_log, covariance, by_log), 0.0))
