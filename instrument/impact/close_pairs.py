"""Two modes under one peak: lines that two poles follow far better than one.

Half a bandwidth apart they look like one mode whose ratio is off by half. What only the mean of hits shows is
no pair: hits that differ make such peaks too.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from threadpoolctl import threadpool_limits

from fitting.modal.frf import DampingEstimate, Frf
from fitting.modal.rational_fit import Freer, RationalFit, freer_fits, rational_fit
from instrument.impact.mode import Mode

_SURELY = 30.0
"""Schwarz' cost that two poles must save over one: odds of a million to one."""
_EACH = 6.0
"""The same in one hit alone, which holds less: twenty to one."""
_LEAST_HEIGHT = 6.0
"""Of either resonance over the scatter of a line, as of any mode."""
_LEAST_SHARE = 0.15
"""Of the higher one: a real plate's peaks depart from one pole by a tenth, in every hit alike."""
_CALMER = 2.0
"""Times that the lines' scatter must fall with two poles: about such departures it falls by less."""
_ALIKE = 4.0
"""Times the other's ratio, at most: a far wider pole is a smooth remainder."""
_LARGEST_ERROR = 0.15
"""Of a ratio, as of any mode."""
_ABOUT = 3.0
"""Half bandwidths from the one pole, within which another fit's pole speaks of the same mode."""
_SAME_POLE = 0.5
"""Half bandwidths within which two channels show one pole."""
_SHOWS = 2.0
"""Standard errors by which two poles have another ratio, from which it is said."""
_NEAR = 4.0
"""Bandwidths apart, at most: of opposite sign two have one peak to 2.2, and a lower one hides to 4 in the
other's flank; the window reaches six."""


@dataclass(frozen=True)
class Doubt:
    """By how much one pole beside a straight line is off what follows its lines better."""

    ratio: float
    frequency_hz: float
    is_two: bool
    """Whether that is two poles, which are no pair; else one beside a curve."""


@dataclass(frozen=True)
class Pairs:
    """What was found about peaks."""

    centres: tuple[float, ...]
    """Frequencies of all modes, Hz."""
    doubts: Mapping[float, Doubt] = field(default_factory=dict)

    def judged(self, mode: Mode, centre: float) -> Mode:
        """The mode, its errors wider where one pole does not follow the lines."""
        doubt, found = self.doubts.get(centre), mode.rational_fit
        if doubt is None or not isinstance(found, DampingEstimate):
            return mode
        wider = found.wider(doubt.ratio, doubt.frequency_hz)
        shows = doubt.is_two and doubt.ratio > _SHOWS * found.standard_error
        said = "one pole does not follow its lines: a close pair, or hits that differ?" if shows else ""
        return replace(mode, rational_fit=wider, why="; ".join(part for part in (mode.why, said) if part))


def pairs_among(
    centres: Sequence[float], frfs: Mapping[str, Frf], alone: Sequence[Mapping[str, Frf]], start_ratio: float
) -> Pairs:
    """Every centre, split where it is two modes. `alone` are the FRFs of single hits, if there are any."""
    found, doubts = list[float](), dict[float, Doubt]()
    with threadpool_limits(1, "blas"):
        for centre in centres:
            others = tuple(c for c in centres if c != centre)
            pairs, doubt = list[RationalFit | None](), None
            for name, frf in frfs.items():
                fits = _fits(frf, centre, start_ratio, others)
                if fits is None:
                    pairs.append(None)
                    continue
                one, freer = fits
                curved, two = freer.curved, freer.two
                asks = _ask_for_two(one, freer, _SURELY)
                hits = [of[name] for of in alone]
                calmer = one.noise > _CALMER * two.noise
                shown = asks and calmer and _is_pair(two) and _in_each(hits, centre, start_ratio, others)
                pairs.append(two if shown else None)
                for other in (curved, two):
                    if one.cost - other.cost > _SURELY:
                        doubt = _larger(doubt, _doubt(one, other, is_two=asks and other is two))
            split = [two for two in pairs if two is not None]
            if split and len(split) == len(pairs) and _agree(split):
                found += min(split, key=lambda two: two.cost).frequencies_hz[:2].tolist()
                continue
            found.append(centre)
            if doubt is not None:
                doubts[centre] = doubt
    return Pairs(tuple(sorted(found)), doubts)


def _fits(
    frf: Frf, centre: float, start_ratio: float, others: tuple[float, ...]
) -> tuple[RationalFit, Freer] | None:
    """With one pole and more freely, over lines chosen by the ratio found."""
    first = rational_fit(frf, centre, start_ratio, others)
    if not isinstance(first, RationalFit):
        return None
    ratio = float(first.ratios[0])
    one, freer = (fit(frf, centre, ratio, others) for fit in (rational_fit, freer_fits))
    return (one, freer) if isinstance(one, RationalFit) and isinstance(freer, Freer) else None


def _ask_for_two(one: RationalFit, freer: Freer, by: float) -> bool:
    return min(one.cost, freer.curved.cost) - freer.two.cost > by


def _doubt(one: RationalFit, other: RationalFit, *, is_two: bool) -> Doubt | None:
    """None where no pole of the other is about there: it takes the lines' rest up."""
    own = one.poles[0]
    about = [k for k, pole in enumerate(other.poles[:2]) if abs(pole - own) < _ABOUT * abs(own.real)]
    if not about:
        return None
    k = max(about, key=lambda k: float(other.heights[k]))
    off = abs(float(other.ratios[k] - one.ratios[0]))
    return Doubt(off, abs(float(other.frequencies_hz[k] - one.frequencies_hz[0])), is_two)


def _larger(a: Doubt | None, b: Doubt | None) -> Doubt | None:
    return b if a is None or (b is not None and b.ratio > a.ratio) else a


def _is_pair(two: RationalFit) -> bool:
    """Whether both poles are modes, each known, and near one another."""
    ratios, heights, errors = two.ratios[:2], two.heights[:2], two.errors[:2]
    if not np.all(ratios > 0) or ratios.max() > _ALIKE * ratios.min():
        return False
    low, high = sorted(two.frequencies_hz[:2].tolist())
    return bool(
        np.all(errors < _LARGEST_ERROR * ratios)
        and heights.min() > max(_LEAST_HEIGHT * two.noise, _LEAST_SHARE * heights.max())
        and high - low < _NEAR * 2 * ratios.max() * high
    )


def _agree(split: Sequence[RationalFit]) -> bool:
    """Whether all channels show the same two: a mode has one pole, wherever it is read."""
    f = np.sort([two.frequencies_hz[:2] for two in split], axis=1)
    half = float(np.mean([two.ratios[:2] for two in split])) * float(f.mean())
    return bool(np.all(np.ptp(f, axis=0) < _SAME_POLE * half))


def _in_each(alone: Sequence[Frf], centre: float, start_ratio: float, others: tuple[float, ...]) -> bool:
    """Whether most single hits show it too; true where there are none."""
    fits = [_fits(frf, centre, start_ratio, others) for frf in alone]
    shown = sum(both is not None and _ask_for_two(*both, _EACH) for both in fits)
    return 2 * shown > len(alone) or not alone
