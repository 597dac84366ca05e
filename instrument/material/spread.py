"""Between specimens: each one's law around a common one, the spread told from what is not known of each.

    y_i = mu + d_i + e_i,   d_i ~ N(0, tau^2),   e_i ~ N(0, s_i^2)

y_i is ln G' or ln eta of specimen i at one frequency, s_i its own standard error: no form of the spread over
frequency is asked for. tau is found by restricted maximum likelihood (Patterson and Thompson, Biometrika 58,
1971), its interval by the profile.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from fitting.arrays import Array, Mask
from fitting.digits import tail, two_digits
from instrument.errors import BadInput
from instrument.material.alike import alike_in
from instrument.material.apart import LEVEL_APART, means_of_others, p_values
from instrument.material.comparing import RESOLUTION, covariance_of
from instrument.material.found_law import MaterialLaw
from instrument.material.mean_error import mean_error

Between = Literal["specimens", "mounts"]
"""What the laws are of: several specimens, or one that was mounted several times."""
FEWEST = 3
"""Laws: of two nothing but their difference is seen."""
_CALLED: dict[Between, str] = {"specimens": "spread between", "mounts": "repeatability over"}
FREQUENCIES = 7
"""Of the common band, each by itself."""
_SIZES = np.geomspace(3e-4, 2.0, 121)
"""Relative standard deviations looked at: from below the models' own resolution to beyond any batch."""
_RISE = 3.841459
"""Of twice the log likelihood at the ends of a 95 % interval."""


@dataclass(frozen=True)
class Curves:
    """Laws of several specimens at the same frequencies, and what is not known of each."""

    names: tuple[str, ...]
    """Names of the specimens."""
    frequency_hz: Array
    """Shape (frequencies,)."""
    logs: Array
    """Of G' at the frequencies, then of eta. Shape (specimens, 2 frequencies)."""
    errors: Array
    """Standard errors of `logs`."""
    stated: Array
    """The part of them that stated numbers make; the whole where it is not known."""
    same: tuple[str | None, ...]
    """Which numbers each specimen states; None shares them with no other."""
    alike: Array
    """Errors besides `errors` that all have alike, being of one specimen; zero between specimens."""

    def those(self, of_them: Mask) -> "Curves":
        """Some of the specimens. Shape (specimens,)."""
        k = np.flatnonzero(of_them)
        return Curves(
            tuple(self.names[i] for i in k),
            self.frequency_hz,
            self.logs[k],
            self.errors[k],
            self.stated[k],
            tuple(self.same[i] for i in k),
            self.alike[k],
        )


@dataclass(frozen=True)
class Size:
    """A spread, relative standard deviation, and its 95 % interval; zero where none is needed."""

    value: float
    lower: float
    upper: float


@dataclass(frozen=True)
class Apart:
    """A specimen that is not like the others: it less their mean, relative, at the band's middle."""

    name: str
    p_value: float
    storage: float
    loss: float

    def words(self, others: int, called: str, at_hz: float) -> str:
        """One line; `called` are the others."""
        return (
            f"{self.name} is apart from the {others} other {called}: G' {100 * self.storage:+.2g} %, "
            f"loss factor {100 * self.loss:+.2g} % at {at_hz:.4g} Hz (p {tail(self.p_value)})"
        )


@dataclass(frozen=True)
class Spread:
    """Of several specimens over their common band. Arrays have shape (frequencies,)."""

    names: tuple[str, ...]
    """Names of the specimens."""
    frequency_hz: Array
    storage_modulus_pa: Array
    """Storage modulus of the common law."""
    loss_factor: Array
    storage_error: Array
    """Of the common law, relative: how well the mean of all such specimens is known."""
    loss_factor_error: Array
    storage: tuple[Size, ...]
    loss: tuple[Size, ...]
    """Of G' and of eta at every frequency."""
    p_values: Array
    """Chance that any of an honest group lies as far off as each specimen does, shape (specimens,).

    NaN where they are too few to tell.
    """
    apart: tuple[Apart, ...] = ()
    """Specimens that are not like the others."""
    without: "Spread | None" = None
    """The others among themselves; None where none is apart, or too few are left."""
    between: Between = "specimens"

    @property
    def middle(self) -> int:
        """Which of its frequencies lines are of."""
        return len(self.frequency_hz) // 2

    @property
    def words(self) -> str:
        """One line that a data sheet could have, of the band's middle."""
        k = self.middle
        said = [
            "{} {} % (95 %: {} to {} %)".format(
                what, *(two_digits(100 * x) for x in (s.value, s.lower, s.upper))
            )
            for what, s in (("G'", self.storage[k]), ("loss factor", self.loss[k]))
        ]
        return (
            f"{_CALLED[self.between]} {len(self.names)} {self.between} at {self.frequency_hz[k]:.4g} Hz, "
            f"standard deviation: {', '.join(said)}"
        )

    @property
    def lines(self) -> list[str]:
        """The spread, each specimen that is apart, and the spread without those."""
        return self.lines_of(self.between)

    def lines_of(self, called: str) -> list[str]:
        """What `lines` says, where specimens are called something else."""

        def of(spread: Spread) -> str:
            return spread.words.replace(f" {self.between} at", f" {called} at", 1)

        at, others = float(self.frequency_hz[self.middle]), len(self.names) - len(self.apart)
        said = [of(self), *(one.words(others, called, at) for one in self.apart)]
        if self.without is not None:
            said.append(f"without {'it' if len(self.apart) == 1 else 'them'}: {of(self.without)}")
        return said


def spread_of(laws: Sequence[MaterialLaw], between: Between = "specimens") -> Spread:
    """The spread of laws beyond their errors, by restricted maximum likelihood.

    Raises `BadInput`, also for two laws of one mount. Laws whose verdict is `unknown`, or whose fit says so
    itself, are left out: they may be biased by more than any spread.
    """
    if between == "mounts":
        _check_mounts(laws)
    laws, all_of_them = [law for law in laws if law.verdict != "unknown" and not law.is_doubted], len(laws)
    if len(laws) < FEWEST:
        left = (
            f", {all_of_them - len(laws)} more of verdict unknown or in doubt"
            if len(laws) < all_of_them
            else ""
        )
        raise BadInput(f"{len(laws)} laws{left}, expected {FEWEST} or more to tell a spread from")
    _check_repeats(laws)
    low, high = max(law.band_hz[0] for law in laws), min(law.band_hz[1] for law in laws)
    if not low < high:
        raise BadInput("the laws have no band in common, expected sweeps that overlap")
    f = np.geomspace(low, high, FREQUENCIES)
    names = alike_in(laws) if between == "mounts" else ()
    curves, each, stated, alike = [], [], [], []
    for law in laws:
        G = law.modulus(2 * np.pi * f)
        eta = G.imag / G.real
        if np.any(eta <= 0):
            raise BadInput(f"{law.source}: loss factor {eta.min():.3g}, expected above zero")
        size = np.concatenate([np.ones(len(f)), 1 / eta])
        known = law.known.at(f) if law.known is not None else None
        of_all = np.zeros(2 * len(f))
        if known is not None and names:
            of_all = np.linalg.norm(known.passed_on(names), axis=1)
        variance = np.maximum(np.diag(covariance_of(law, f)) - of_all**2, 0.0)
        error = np.hypot(np.sqrt(variance) * size, RESOLUTION)
        if not np.all(np.isfinite(error)):
            raise BadInput(f"{law.source}: no standard errors, expected a law that says how well it is known")
        curves.append(np.concatenate([np.log(G.real), np.log(eta)]))
        each.append(error)
        stated.append(error if known is None else known.stated_part * size)
        alike.append(of_all * size)
    same = tuple(None if names else law.same for law in laws)
    logs, errors, parts, together = (np.array(rows) for rows in (curves, each, stated, alike))
    found = spread_of_curves(
        Curves(tuple(law.source for law in laws), f, logs, errors, parts, same, together)
    )
    without = replace(found.without, between=between) if found.without is not None else None
    return replace(found, between=between, without=without)


def _check_repeats(laws: Sequence[MaterialLaw]) -> None:
    """No two measurements give one law to the last digit: a copy would make a spread look smaller."""
    seen: dict[bytes, str] = {}
    for law in laws:
        key = b"".join(c.tobytes() for c in (law.frequency_hz, law.storage_modulus_pa, law.loss_factor))
        if key in seen:
            raise BadInput(
                f"{seen[key]} and {law.source}: the same law to the last digit, expected a measurement each"
            )
        seen[key] = law.source


def _check_mounts(laws: Sequence[MaterialLaw]) -> None:
    """Sessions say which mount they were; one that counts twice would make the rig look better than it is."""
    seen: dict[int, str] = {}
    for law in laws:
        if law.remount is None:
            continue
        if law.remount in seen:
            raise BadInput(
                f"{seen[law.remount]} and {law.source}: both remount = {law.remount}, expected a mount each"
            )
        seen[law.remount] = law.source
    stated = {law.specimen for law in laws if law.remount is not None}
    if len(stated) > 1:
        raise BadInput(f"mounts of {' and '.join(sorted(stated))}, expected one specimen")


def spread_of_curves(curves: Curves) -> Spread:
    """By restricted maximum likelihood, and who is apart."""
    chances = p_values(curves.logs, curves.errors)
    whole = replace(_spread(curves), p_values=chances)
    far = np.nan_to_num(chances, nan=1.0) < LEVEL_APART
    if not np.any(far):
        return whole
    whole = replace(whole, apart=_apart(whole, curves, far))
    return replace(whole, without=_spread(curves.those(~far))) if np.sum(~far) >= FEWEST else whole


def _apart(found: Spread, curves: Curves, far: Mask) -> tuple[Apart, ...]:
    """What is said of those that are far off, at the band's middle: of shape (specimens,)."""
    k, n = found.middle, len(found.frequency_hz)
    sizes = np.array([size.value for size in (*found.storage, *found.loss)])
    off = np.expm1(curves.logs - means_of_others(curves.logs, curves.errors, sizes))
    return tuple(
        Apart(found.names[i], float(found.p_values[i]), float(off[i, k]), float(off[i, n + k]))
        for i in np.flatnonzero(far)
    )


def _spread(curves: Curves) -> Spread:
    stated = np.minimum(curves.stated, curves.errors)
    columns = zip(curves.logs.T, curves.errors.T, stated.T, curves.alike.T, strict=True)
    found = [_one(y, e, part, curves.same, alike) for y, e, part, alike in columns]
    n = len(curves.frequency_hz)
    mean, known = (np.array([one[k] for one in found], dtype=float) for k in (1, 2))
    sizes = tuple(one[0] for one in found)
    return Spread(
        curves.names,
        curves.frequency_hz,
        np.exp(mean[:n]),
        np.exp(mean[n:]),
        known[:n],
        known[n:],
        sizes[:n],
        sizes[n:],
        np.full(len(curves.names), np.nan),
    )


def _one(
    y: Array, error: Array, stated: Array, same: Sequence[str | None], alike: Array
) -> tuple[Size, float, float]:
    """The spread of one quantity at one frequency; the common value and its standard error."""
    profile = np.array([_restricted(y, error, tau)[0] for tau in _SIZES])
    size = _size(profile)
    _, mean = _restricted(y, error, size.value)
    return size, mean, float(np.hypot(mean_error(y, error, stated, same, size.value), np.mean(alike)))


def _restricted(y: Array, error: Array, tau: float) -> tuple[float, float]:
    """Twice the restricted log likelihood, and the common value."""
    w = 1 / (error**2 + tau**2)
    mean = float(np.sum(w * y) / np.sum(w))
    twice = float(np.sum(np.log(w)) - np.log(np.sum(w)) - np.sum(w * (y - mean) ** 2))
    return twice, mean


def _size(profile: Array) -> Size:
    """The best size and where the profile has fallen to the interval's ends."""
    best = int(np.argmax(profile))
    logs = np.log(_SIZES)
    value = 0.0
    if best > 0:
        value = float(_SIZES[best])
        if best < len(_SIZES) - 1:
            below, at, above = profile[best - 1 : best + 2]
            curvature = below - 2 * at + above
            if curvature < 0:
                value = float(np.exp(logs[best] + (logs[1] - logs[0]) * (below - above) / (2 * curvature)))
    inside = np.flatnonzero(profile >= profile.max() - _RISE)
    first, last = int(inside[0]), int(inside[-1])
    level = profile.max() - _RISE
    lower = 0.0
    if first > 0:
        lower = float(np.exp(np.interp(level, profile[first - 1 : first + 1], logs[first - 1 : first + 1])))
    upper = float(_SIZES[-1])
    if last < len(_SIZES) - 1:
        upper = float(np.exp(np.interp(level, profile[last : last + 2][::-1], logs[last : last + 2][::-1])))
    return Size(value, lower, upper)
