"""From accepted hits to frequency response functions and coherence."""

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from fitting.arrays import Array, Complex
from fitting.modal.frf import Frf
from fitting.numerics.robust import robust_scatter
from instrument.impact.judge import Judged

Estimator = Literal["h1", "h2", "hv"]

_LEAD_S = 0.02
"""Kept before the blow: it rises within a millisecond or two."""
_SHORT_WAIT = 0.03
"""Of the record, before the blow: it changes nothing that shows."""
_TAPER = 0.5
"""The force window closes over this share of its own length, a half cosine."""
_STANDS_OUT, _LEAST_BLOW = 7.0, 2e-3
"""Scatters of the force, and share of the blow, above which a sample of it is a blow and not noise: of a
million samples of noise none."""
_PULLS = 2.0
"""Times the deepest pull that a blow must push."""
_DROP_DB = 20.0
"""Below the low end of its spectrum a blow no longer excites: a tenth of the force. A choice."""
_PULSES = 4
"""The force is kept for so many lengths of the blow after its end."""


@dataclass(frozen=True)
class Spectra:
    """Averages over hits, one FRF and coherence a response channel."""

    frfs: dict[str, Frf]
    coherence: dict[str, Array] | None
    """None for one hit: it is one by definition."""
    force: Array
    """Mean magnitude of the force spectrum, N s. Shape (lines,)."""
    frequency_hz: Array


def from_the_blow(hits: list[Judged]) -> list[Judged]:
    """Hits without a long wait before the blow, all of one length still.

    What a record cuts off of a decay is smooth over its lines where it begins with the blow; later by t_0 it
    turns from line to line by exp(i omega t_0), and no fit about a mode follows that.
    """
    lead = round(_LEAD_S * hits[0].hit.sample_rate_hz)
    starts = [max(0, j.pulse.start - lead) for j in hits]
    length = len(hits[0].hit.force_n)
    if max(starts) <= _SHORT_WAIT * length:
        return hits
    kept = length - max(starts)
    return [_cut(j, start, start + kept) for j, start in zip(hits, starts, strict=True)]


def _cut(judged: Judged, start: int, stop: int) -> Judged:
    hit, pulse = judged.hit, judged.pulse
    responses = tuple(replace(c, samples=c.samples[start:stop]) for c in hit.responses)
    shorter = replace(hit, force_n=hit.force_n[start:stop], responses=responses)
    return replace(judged, hit=shorter, pulse=slice(pulse.start - start, pulse.stop - start))


def spectra(
    hits: list[Judged], *, estimator: Estimator = "h1", end_value: float | None = None, padding: int = 1
) -> Spectra:
    """Average hits of one length and rate.

    `end_value` is where an exponential window, the same on force and response, ends; None for none.
    The window starts with the record; what it adds to each mode's decay is kept in the `Frf`.
    """
    first = hits[0].hit
    n, rate = len(first.force_n), first.sample_rate_hz
    t = np.arange(n) / rate
    decay = -np.log(end_value) / first.seconds if end_value else 0.0
    w = np.exp(-decay * t)
    F = np.array([np.fft.rfft(force_window(j) * j.hit.force_n * w, n * padding) for j in hits]) / rate
    f = np.asarray(np.fft.rfftfreq(n * padding, 1 / rate), dtype=np.float64)
    S_ff = (np.abs(F) ** 2).mean(axis=0)
    frfs, coherence = {}, {}
    for k, channel in enumerate(first.responses):
        X = np.array([np.fft.rfft(j.hit.responses[k].samples * w, n * padding) for j in hits]) / rate
        S_xx, S_xf = (np.abs(X) ** 2).mean(axis=0), (X * F.conj()).mean(axis=0)
        frfs[channel.name] = Frf(f, frf_of(S_ff, S_xx, S_xf, estimator), channel.motion, decay)
        coherence[channel.name] = np.abs(S_xf) ** 2 / np.maximum(S_ff * S_xx, 1e-300)
    return Spectra(frfs, coherence if len(hits) > 1 else None, np.sqrt(S_ff), f)


def frf_of(S_ff: Array, S_xx: Array, S_xf: Complex, estimator: Estimator) -> Complex:
    """H1 (noise on the response), H2 (on the force) or Hv, their geometric mean in size with H1's phase.

    Shape (lines,).
    """
    h1 = S_xf / np.maximum(S_ff, 1e-300)
    if estimator == "h1":
        return np.asarray(h1)
    h2 = S_xx / np.where(np.abs(S_xf) > 0, S_xf.conj(), 1e-300)
    return np.asarray(
        h2 if estimator == "h2" else np.sqrt(np.abs(h1) * np.abs(h2)) * np.exp(1j * np.angle(h1))
    )


def force_window(judged: Judged) -> Array:
    """One over the blow and a little after it, then a half cosine to zero: the rest of the force is noise.

    One too about whatever else stands out of that: a second blow of 3 % that the force's window hides is 3 %
    of another mode's phase. Shape (samples,).
    """
    n, pulse = len(judged.hit.force_n), judged.pulse
    width = pulse.stop - pulse.start
    stop = min(n, pulse.stop + _PULSES * width)
    taper = max(1, int(_TAPER * (stop - pulse.start)))
    w = np.zeros(n)
    w[:stop] = 1.0
    end = min(n, stop + taper)
    w[stop:end] = 0.5 * (1 + np.cos(np.pi * (np.arange(end - stop) + 1) / (taper + 1)))
    rest = judged.hit.force_n[end:]
    if len(rest):
        least = max(
            _STANDS_OUT * robust_scatter(rest),
            _LEAST_BLOW * float(judged.hit.force_n.max()),
            # No blow pulls: what goes down as far is the hammer's own ringing.
            -_PULLS * float(rest.min()),
        )
        for at in end + np.flatnonzero(rest > least):
            w[max(0, at - width) : at + width + 1] = 1.0
    return w


def rolloff_hz(spectrum: Spectra) -> float:
    """Where the force spectrum first falls by `_DROP_DB` from its low end, in Hz."""
    low = float(np.median(spectrum.force[1 : max(3, len(spectrum.force) // 100)]))
    below = np.flatnonzero(spectrum.force < low * 10 ** (-_DROP_DB / 20))
    return float(spectrum.frequency_hz[below[0]] if below.size else spectrum.frequency_hz[-1])
