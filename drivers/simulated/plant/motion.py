"""Exact response of a linear system to pieces of sine of linear amplitude, at any uniform times.

On each piece the response is a particular solution in closed form, (alpha + beta t) e^{i w t}, and
c_j e^{p_j t} of every pole p_j, with c_j such that the state goes on where the piece before left it.
"""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from drivers.arrays import Array, Complex
from drivers.simulated.drive import DrivePiece
from drivers.simulated.plant.diagonal import Diagonal

NEGLIGIBLE = 1e-15
"""Of the response's scale; a decaying term below it is left out."""
BLOCK = 256
"""Samples that share their powers of e^{p step}."""


@dataclass(frozen=True)
class Tone:
    """(amplitude + slope t) sin(omega t + phase), t from the beginning of its stretch."""

    amplitude: float
    slope: float
    omega: float
    phase: float


def tones_of(piece: DrivePiece, harmonics: tuple[float, ...] = ()) -> tuple[Tone, ...]:
    """The piece, and multiples of its frequency (2, 3, ...) with fractions of its amplitude."""
    omega = 2 * np.pi * piece.frequency_hz
    parts = ((k, f) for k, f in enumerate((1.0, *harmonics), start=1) if f)
    return tuple(
        Tone(f * piece.amplitude_v, f * piece.slope_v_s, k * omega, k * piece.phase_rad) for k, f in parts
    )


class EvenStretch:
    """A time from `begin_s` on during which neither the tones nor the system change."""

    def __init__(self, begin_s: float, system: Diagonal, tones: tuple[Tone, ...], state: Array) -> None:
        self.begin_s, self.system, self.tones = begin_s, system, tones
        self.transient = system.to_modal @ state - self._particular(0.0)
        half = system.poles.imag >= 0
        weight = np.where(system.poles.imag[half] > 0, 2.0, 1.0)
        self._poles = system.poles[half]
        self._coefficients = weight * system.C[:, half] * self.transient[half]
        self._forced = [self._response(tone) for tone in tones]
        scale = np.abs(self._coefficients).sum(axis=1) + sum(np.abs(a) for a, _ in self._forced)
        relative = np.abs(self._coefficients) / np.maximum(scale, 1e-300)[:, None]
        self._size = relative.max(axis=0, initial=0.0)
        self._powers: dict[float, Complex] = {}

    def _particular(self, t: float) -> Complex:
        """Modal states of the particular solution."""
        x = np.zeros(len(self.system.poles), complex)
        for tone in self.tones:
            for s, sign in ((1j * tone.omega, 1), (-1j * tone.omega, -1)):
                beta = tone.slope * self.system.b / (s - self.system.poles)
                alpha = (tone.amplitude * self.system.b - beta) / (s - self.system.poles)
                x += sign * (alpha + beta * t) * np.exp(s * t + sign * 1j * tone.phase) / 2j
        return x

    def _response(self, tone: Tone) -> tuple[Complex, Complex]:
        """Outputs are Re((a + b t) e^{i w t}) to a tone."""
        H, dH = self.system.transfer(1j * tone.omega), self.system.transfer_rate(1j * tone.omega)
        turn = -1j * np.exp(1j * tone.phase)
        return turn * (tone.amplitude * H + tone.slope * dH), turn * tone.slope * H

    def state(self, time_s: float) -> Array:
        """Physical state. Shape (n,)."""
        t = time_s - self.begin_s
        modal = self.transient * np.exp(self.system.poles * t) + self._particular(t)
        return np.asarray((self.system.from_modal @ modal).real)

    def outputs(self, first_s: float, step_s: float, count: int, rows: list[int]) -> Array:
        """Outputs at uniform times. Shape (rows, count)."""
        length = min(BLOCK, count)
        blocks = -(-count // length)
        t = first_s - self.begin_s + step_s * length * np.arange(blocks)
        live = self._size * np.exp(self._poles.real * t[0]) > NEGLIGIBLE
        fast, starts = [self._steps(step_s)[:length, live]], []
        c = self._coefficients[np.ix_(np.array(rows), np.flatnonzero(live))]
        starts.append(c.T[:, None, :] * np.exp(np.outer(self._poles[live], t))[:, :, None])
        n = np.arange(length)[:, None]
        for tone, (a, b) in zip(self.tones, self._forced, strict=True):
            turns = np.exp(1j * tone.omega * step_s * n)
            at = np.exp(1j * tone.omega * t)[:, None]
            fast.append(turns)
            starts.append(((a[rows] + np.outer(t, b[rows])) * at)[None])
            if tone.slope:
                fast.append(n * turns)
                starts.append((step_s * b[rows] * at)[None])
        E, Z = np.hstack(fast), np.concatenate(starts).reshape(-1, blocks * len(rows))
        y = np.hstack([E.real, -E.imag]) @ np.vstack([Z.real, Z.imag])
        return np.asarray(
            y.reshape(length, blocks, len(rows)).transpose(2, 1, 0).reshape(len(rows), -1)[:, :count]
        )

    def _steps(self, step_s: float) -> Complex:
        """e^{p step n} of a block."""
        if step_s not in self._powers:
            self._powers = {step_s: np.exp(np.outer(step_s * np.arange(BLOCK), self._poles))}
        return self._powers[step_s]


class Motion:
    """A system in motion, from rest at time zero. Times in s, on the sample clock."""

    def __init__(self, system: Diagonal, harmonics: tuple[float, ...] = (), memory_s: float = 1.0) -> None:
        self._harmonics, self._memory_s = harmonics, memory_s
        self._seen_s = 0.0
        self._stretches = [EvenStretch(0.0, system, (), np.zeros(len(system.poles)))]

    @property
    def system(self) -> Diagonal:
        """The system that moves now."""
        return self._stretches[-1].system

    def drive(self, piece: DrivePiece) -> None:
        """The drive from `piece.begin_s` on. A time before the last change is refused (ValueError)."""
        self.excite(piece.begin_s, tones_of(piece, self._harmonics))

    def excite(self, begin_s: float, tones: tuple[Tone, ...]) -> None:
        """Any sum of tones from `begin_s` on, as `drive` does; none is silence."""
        self._begin(begin_s, self.system, tones)

    def retune(self, time_s: float, system: Diagonal) -> None:
        """Another system with the same physical states from a time on; state and drive go on."""
        last = self._stretches[-1]
        t = time_s - last.begin_s
        tones = tuple(
            Tone(k.amplitude + k.slope * t, k.slope, k.omega, (k.phase + k.omega * t) % (2 * np.pi))
            for k in last.tones
        )
        self._begin(time_s, system, tones)

    def _begin(self, begin_s: float, system: Diagonal, tones: tuple[Tone, ...]) -> None:
        last = self._stretches[-1]
        if begin_s < last.begin_s:
            raise ValueError(
                f"a change at {begin_s:.6f} s comes before the last, {last.begin_s:.6f} s: give them in order"
            )
        self._stretches.append(EvenStretch(begin_s, system, tones, last.state(begin_s)))

    def take_back(self, from_s: float) -> None:
        """Forget changes planned for `from_s` and later. Refused (ValueError) where that was read."""
        if from_s < self._seen_s:
            raise ValueError(
                f"a change at {from_s:.6f} s comes before {self._seen_s:.6f} s, already read: give it sooner"
            )
        while len(self._stretches) > 1 and self._stretches[-1].begin_s >= from_s:
            del self._stretches[-1]

    def _forget(self, now_s: float) -> None:
        self._seen_s = max(self._seen_s, now_s)
        oldest = self._seen_s - self._memory_s
        while len(self._stretches) > 1 and self._stretches[1].begin_s < oldest:
            del self._stretches[0]

    def state(self, time_s: float) -> Array:
        """Physical state at a time not before the memory. Shape (n,)."""
        return self._at_or_before(time_s).state(time_s)

    def _at_or_before(self, time_s: float) -> EvenStretch:
        for stretch in reversed(self._stretches):
            if stretch.begin_s <= time_s:
                return stretch
        if self._stretches[0].begin_s == 0.0:
            return self._stretches[0]
        raise ValueError(
            f"{time_s:.6f} s lies before {self._stretches[0].begin_s:.6f} s, where the memory "
            f"of {self._memory_s} s begins: ask sooner or keep more"
        )

    def at(self, first_time_s: float, step_s: float, count: int, outputs: tuple[str, ...]) -> Array:
        """Outputs at `count` times. Shape (outputs, count). Before time zero all is at rest."""
        rows = [self.system.names.index(name) for name in outputs]
        out = np.zeros((len(rows), count))
        last_s = first_time_s + step_s * (count - 1)
        if count:
            self._at_or_before(first_time_s)
        begins = [stretch.begin_s for stretch in self._stretches]
        edges = [min(max(int(np.ceil((b - first_time_s) / step_s - 1e-9)), 0), count) for b in begins]
        for stretch, (low, high) in zip(self._stretches, pairwise([*edges, count]), strict=True):
            if high > low:
                out[:, low:high] = stretch.outputs(first_time_s + step_s * low, step_s, high - low, rows)
        self._forget(last_s)
        return out
