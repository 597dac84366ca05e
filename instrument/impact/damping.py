"""Natural frequencies and damping ratios from hits or FRFs: three methods side by side, one adopted."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from threadpoolctl import threadpool_limits

from fitting.arrays import Array
from fitting.modal.frf import DampingEstimate, Frf, Refusal
from fitting.modal.half_power import half_power, half_power_marks
from fitting.modal.lscf import lscf, lscf_poles
from fitting.modal.rational_fit import MOST_TERMS, RationalFit, rational_fit
from instrument.errors import BadInput
from instrument.impact.close_pairs import Pairs, pairs_among
from instrument.impact.hits_apart import told_apart
from instrument.impact.judge import Judged
from instrument.impact.mode import Mode
from instrument.impact.peaks import beyond, merged, peaks_of, without_a_pole
from instrument.impact.spectra import Estimator, Spectra, from_the_blow, rolloff_hz, spectra
from instrument.impact.turned import turned_alike

PADDING = 8
"""Half power is read on lines so many times finer."""
HALF_POWER_END = 0.01
"""Where its exponential window ends."""
DISAGREEMENT = 0.10
"""Relative, of two methods' ratios: well beyond what half power is off by in the tests (3 %). A choice."""
_SIGMAS = 3.0
"""Of their noise, that two ways of reading a ratio may differ: more has another reason."""
_UNDECAYED = 0.2
"""A record that ends at more than this share of a mode's start gives no half-power value."""
_CUT = 0.05
"""What of a mode may be left at the end before the record counts as cut off."""
_START_RATIO = 2e-3
"""Of critical damping, where half power gives no value: a bare metal plate's."""
_LSCF_LINES = 40
"""Either side of a mode, at least: its highest order has 25 coefficients."""
_LSCF_BANDWIDTHS = 15
"""Either side of a mode: its neighbours' poles are found too, and take their part."""
_OF_RATE = 0.45
"""Of the sampling rate, up to which modes are looked for: an anti-aliasing filter ends there."""


@dataclass(frozen=True)
class _ModeSurroundings:
    """A mode as it is known so far, beside its neighbours and in its record."""

    frequency_hz: float
    ratio: float
    """nan where it is not known."""
    bandwidths_to_next: float
    record_s: float

    @property
    def lines(self) -> float:
        """Lines of the record's spectrum in the mode's bandwidth."""
        return 2 * self.ratio * self.frequency_hz * self.record_s

    @property
    def remains(self) -> float:
        """Share of the mode's start that is left where the record ends."""
        return float(np.exp(-2 * np.pi * self.ratio * self.frequency_hz * self.record_s))


@dataclass(frozen=True)
class Damping:
    """The result of an impact test."""

    modes: tuple[Mode, ...]
    hits: tuple[Judged, ...]
    warnings: tuple[str, ...]
    plain: dict[str, Frf]
    """By channel, as the rational fit sees them."""
    fine: dict[str, Frf]
    """By channel, padded and windowed, as half power sees them."""
    coherence: dict[str, Array] | None
    band_hz: tuple[float, float]
    """Where modes were looked for."""


def damping_of_hits(
    hits: list[Judged],
    *,
    band_hz: tuple[float, float] | None = None,
    at_hz: tuple[float, ...] = (),
    estimator: Estimator = "h1",
    end_value: float | None = None,
) -> Damping:
    """Average the accepted hits and find their modes.

    `end_value` puts an exponential window on what the rational fit and LSCF see; half power always has one.
    Raises `BadInput` where no hit is left, and for a band that the sampling rate does not reach.
    """
    good = [j for j in hits if j.accepted]
    if not good:
        raise BadInput("no good hit: " + ("; ".join(f"{j.hit.source}: {j.why}" for j in hits) or "no record"))
    good = from_the_blow(good)
    rate = good[0].hit.sample_rate_hz
    alone = [spectra([hit], estimator=estimator, end_value=end_value) for hit in good]
    excited = min(min(rolloff_hz(one) for one in alone), _OF_RATE * rate)
    good, turned = turned_alike(good, [one.frfs for one in alone], (0.0, excited))
    if turned:
        alone = [spectra([hit], estimator=estimator, end_value=end_value) for hit in good]
    plain = spectra(good, estimator=estimator, end_value=end_value)
    fine = spectra(good, estimator=estimator, end_value=end_value or HALF_POWER_END, padding=PADDING)
    seconds = good[0].hit.seconds
    band = band_hz or (3 / seconds, min(rolloff_hz(plain), _OF_RATE * rate))
    if not at_hz and band[0] >= rate / 2:
        above = f"band {band[0]:g} to {band[1]:g} Hz lies above half the sampling rate"
        raise BadInput(f"{above}, expected below {rate / 2:g} Hz")
    single = [one.frfs for one in alone]
    modes = _modes(plain.frfs, fine.frfs, band, at_hz, seconds, single)
    modes, differ = told_apart(good, single, modes)
    said = [*(f"{j.hit.source}: {note}" for j in hits for note in j.notes), *turned, *differ]
    if not modes:
        said.append(
            f"no mode found between {band[0]:.3g} and {band[1]:.4g} Hz: name it with --at, or see --band"
        )
    said += [f"{j.hit.source} left out: {j.why}" for j in hits if not j.accepted]
    if len(good) == 1:
        said.append("one hit: coherence says nothing, and nothing is averaged")
    if not at_hz:
        said += without_a_pole(plain.frfs, fine.frfs, band, modes)
        said += beyond(plain.frfs, fine.frfs, band, _OF_RATE * rate) if band_hz is None else []
    said += _advice(modes, plain, seconds)
    return Damping(modes, tuple(hits), tuple(said), plain.frfs, fine.frfs, plain.coherence, band)


def damping_of_frfs(
    frfs: dict[str, Frf], *, band_hz: tuple[float, float] | None = None, at_hz: tuple[float, ...] = ()
) -> Damping:
    """Damping from FRFs of another instrument: nothing is padded, half power reads their own lines."""
    any_frf = next(iter(frfs.values()))
    f = any_frf.frequency_hz
    band = band_hz or (float(f[0]), float(f[-1]))
    modes = _modes(frfs, frfs, band, at_hz, 1 / float(np.median(np.diff(f))))
    said = without_a_pole(frfs, frfs, band, modes) if not at_hz else []
    return Damping(modes, (), tuple(said), frfs, frfs, None, band)


def _modes(
    plain: dict[str, Frf],
    fine: dict[str, Frf],
    band: tuple[float, float],
    at_hz: tuple[float, ...],
    seconds: float,
    alone: Sequence[Mapping[str, Frf]] = (),
) -> tuple[Mode, ...]:
    """Modes asked for by name are all reported; of those found, the ones a pole explains."""
    highest = min(float(frf.frequency_hz[-1]) for frf in plain.values())
    for f in at_hz:
        if f >= highest:
            raise BadInput(f"--at {f:g} Hz is beyond the data, expected less than {highest:g} Hz")
    pairs = Pairs(tuple(sorted(set(at_hz))))
    if not at_hz:
        pairs = pairs_among(_found(plain, fine, band, seconds), plain, alone, _START_RATIO)
    modes = []
    with threadpool_limits(1, "blas"):
        for f in pairs.centres:
            candidates = [_mode(name, plain[name], fine[name], f, pairs.centres, seconds) for name in plain]
            modes.append(pairs.judged(min(candidates, key=_doubt), f))
    return tuple(m for m in modes if at_hz or m.accepted)


def _found(
    plain: dict[str, Frf], fine: dict[str, Frf], band: tuple[float, float], seconds: float
) -> list[float]:
    """Peaks that a pole of their own explains. The others are noise, and no neighbours to reckon with."""
    explained = []
    with threadpool_limits(1, "blas"):
        for name, frf in fine.items():
            for f, prominence in peaks_of(plain[name], frf, band):
                start = half_power(frf, f)
                guess = max(start.ratio, 1e-4) if isinstance(start, DampingEstimate) else _START_RATIO
                fits = (rational_fit(plain[name], f, ratio) for ratio in (guess, _START_RATIO))
                if any(isinstance(fit, RationalFit) for fit in fits):
                    explained.append((f, prominence))
    return merged(explained, 2 / seconds)


def _doubt(mode: Mode) -> float:
    """The channel whose own error is smallest speaks for a mode."""
    if isinstance(mode.rational_fit, DampingEstimate):
        return mode.rational_fit.standard_error / mode.rational_fit.ratio
    return np.inf


def _mode(name: str, plain: Frf, fine: Frf, f: float, centres: Sequence[float], seconds: float) -> Mode:
    start = half_power(fine, f)
    guess = max(start.ratio, 1e-4) if isinstance(start, DampingEstimate) else _START_RATIO
    fit = rational_fit(plain, f, guess, tuple(c for c in centres if c != f), MOST_TERMS)
    rational = fit.estimate if isinstance(fit, RationalFit) else fit
    best = rational if isinstance(rational, DampingEstimate) else start
    f_n = best.frequency_hz if isinstance(best, DampingEstimate) else f
    ratio = best.ratio if isinstance(best, DampingEstimate) else float("nan")
    others = [abs(c - f) for c in centres if c != f]
    around = _ModeSurroundings(f_n, ratio, min(others, default=np.inf) / (2 * ratio * f_n), seconds)
    noise = fit.noise / np.sqrt(PADDING) if isinstance(fit, RationalFit) else 0.0
    half = _half_power(fine, f, around, noise)
    if isinstance(half, DampingEstimate) and isinstance(rational, DampingEstimate):
        half = no_surer_than_apart(half, rational)
    width = 2 * ratio * f_n if ratio == ratio else 2 / seconds
    reach = max(_LSCF_LINES / seconds, _LSCF_BANDWIDTHS * width)
    third = lscf(
        lscf_poles([plain.between(f_n - reach, f_n + reach)]),
        f_n,
        plain.added_decay_1_s,
        max(width, 2 / seconds),
    )
    accepted, why = _verdict(half, rational, third, around)
    return Mode(
        frequency_hz=f_n if accepted else f,
        damping_ratio=ratio if accepted else float("nan"),
        channel=name,
        half_power=half,
        rational_fit=rational,
        lscf=third,
        lines_in_bandwidth=around.lines,
        bandwidths_to_next=around.bandwidths_to_next,
        accepted=accepted,
        why=why,
        fit=fit if isinstance(fit, RationalFit) else None,
    )


def no_surer_than_apart(half: DampingEstimate, rational: DampingEstimate) -> DampingEstimate:
    """The estimate by half power, with its difference to the fit's where noise does not explain that.

    What a neighbour adds to a width is no noise: it is counted in as an error of the width.
    """
    off = abs(half.ratio - rational.ratio)
    noise = np.hypot(np.nan_to_num(half.standard_error), np.nan_to_num(rational.standard_error))
    return half if off <= _SIGMAS * noise else half.wider(off, 0.0)


def _half_power(fine: Frf, f: float, around: _ModeSurroundings, noise: float) -> DampingEstimate | Refusal:
    if around.ratio == around.ratio:
        if around.lines < 1:
            return Refusal(f"{around.lines:.1f} lines in its bandwidth, expected 1 or more")
        if around.remains > _UNDECAYED:
            return Refusal(
                f"the record ends at {100 * around.remains:.0f} % of the decay, "
                f"expected {100 * _UNDECAYED:.0f} % or less"
            )
        if around.bandwidths_to_next < 2:
            return Refusal(f"a neighbour {around.bandwidths_to_next:.1f} bandwidths away, expected 2 or more")
    return half_power(fine, f, noise, around.record_s)


def _verdict(
    half: DampingEstimate | Refusal,
    rational: DampingEstimate | Refusal,
    third: DampingEstimate | Refusal,
    around: _ModeSurroundings,
) -> tuple[bool, str]:
    lines, apart = around.lines, around.bandwidths_to_next
    said = []
    if isinstance(rational, Refusal):
        said.append(f"rational fit: {rational.why}")
    else:
        for name, other in (("half power", half), ("LSCF", third)):
            if isinstance(other, DampingEstimate) and abs(other.ratio / rational.ratio - 1) > DISAGREEMENT:
                said.append(f"{name} differs by {100 * (other.ratio / rational.ratio - 1):+.0f} %")
    if isinstance(half, Refusal):
        said.append(f"half power refused: {half.why}")
    if lines < 2:
        said.append(
            f"{lines:.1f} lines in its bandwidth: "
            f"record {around.record_s * 2 / max(lines, 0.05):.3g} s or more"
        )
    if apart < 5:
        said.append(f"a neighbour {apart:.1f} bandwidths away")
    return isinstance(rational, DampingEstimate), "; ".join(said)


def _advice(modes: tuple[Mode, ...], spectrum: Spectra, seconds: float) -> list[str]:
    """What to change in the next test: record length, window, tip."""
    said = []
    known = [m for m in modes if m.damping_ratio > 0]
    narrow = min(known, key=lambda m: m.lines_in_bandwidth, default=None)
    if narrow is not None and narrow.lines_in_bandwidth < 2:
        said.append(
            f"{narrow.frequency_hz:.2f} Hz has {narrow.lines_in_bandwidth:.1f} lines in its bandwidth: "
            f"record {_seconds_for(narrow, seconds):.3g} s instead of {seconds:.3g} s "
            "to read it by half power"
        )
    slow = max(known, key=lambda m: _remains(m, seconds), default=None)
    if slow is not None and _remains(slow, seconds) > _CUT:
        said.append(
            f"the record is cut off: {slow.frequency_hz:.2f} Hz still has "
            f"{100 * _remains(slow, seconds):.0f} % of its start at the end; "
            "the rational fit bears that, half power wants a longer record"
        )
    edge = rolloff_hz(spectrum)
    faint = [m for m in modes if m.frequency_hz > edge]
    if faint:
        said.append(
            f"the blow excites little above {edge:.0f} Hz: "
            f"use a harder tip for {faint[0].frequency_hz:.0f} Hz"
        )
    return said


def _remains(mode: Mode, seconds: float) -> float:
    return float(np.exp(-2 * np.pi * mode.damping_ratio * mode.frequency_hz * seconds))


def _seconds_for(mode: Mode, seconds: float) -> float:
    """Record length that puts two lines into the bandwidth."""
    return seconds * 2 / max(mode.lines_in_bandwidth, 0.05)


def marks(frf: Frf, mode: Mode) -> tuple[float, float, float] | None:
    """Half-power frequencies and peak for drawing; None where half power refused the mode."""
    if isinstance(mode.half_power, Refusal):
        return None
    found = half_power_marks(frf, mode.frequency_hz)
    return None if isinstance(found, Refusal) else found[:3]
