"""Catching blows: a stream of force samples in, records out. The level is learnt from what was seen."""

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array

LEARN_S = 0.25
"""Of quiet, before the first blow: it gives the force channel's offset and noise."""
_OVER_NOISE = 30.0
"""The first blow stands so many standard deviations above the quiet."""
_SHARE = 0.1
"""Of the median blow so far; a trigger far below it catches handling, far above it misses blows."""


class Trigger:
    """Finds records of a fixed length around blows."""

    def __init__(self, sample_rate_hz: float, record_s: float, pre_trigger_s: float) -> None:
        self._learn = round(LEARN_S * sample_rate_hz)
        self._length = round(record_s * sample_rate_hz)
        self._before = round(pre_trigger_s * sample_rate_hz)
        self._rows: Array | None = None
        self._overload = np.zeros((0, 0), dtype=bool)
        self._first = 0
        self._armed_at = 0
        self._quiet: tuple[float, float] | None = None
        self._peaks: list[float] = []

    @property
    def level(self) -> float | None:
        """Force above its offset that counts as a blow, in the force channel's unit; None while learning."""
        if self._quiet is None:
            return None
        noise = _OVER_NOISE * self._quiet[1]
        return max(noise, _SHARE * float(np.median(self._peaks))) if self._peaks else noise

    @property
    def peaks(self) -> tuple[float, ...]:
        """Of the blows so far."""
        return tuple(self._peaks)

    @property
    def wanted(self) -> int:
        """Samples until a pending record is whole, or a small number while nothing is pending."""
        start = self._pending()
        have = 0 if self._rows is None else self._rows.shape[1]
        return max(1, start + self._length - have) if start is not None else self._learn

    def feed(
        self, first_sample: int, rows: Array, overload: NDArray[np.bool_]
    ) -> list[tuple[int, Array, NDArray[np.bool_]]]:
        """Take samples (channels, n), force first; give whole records: first sample, rows, overload flags."""
        flags = np.repeat(overload[:, None], rows.shape[1], axis=1)
        if self._rows is None:
            self._rows, self._overload, self._first = rows, flags, first_sample
            self._armed_at = first_sample + self._learn
        else:
            self._rows = np.concatenate([self._rows, rows], axis=1)
            self._overload = np.concatenate([self._overload, flags], axis=1)
        if self._quiet is None and self._rows.shape[1] >= self._learn:
            force = self._rows[0, : self._learn]
            self._quiet = float(np.mean(force)), max(float(np.std(force)), 1e-12)
        found = []
        while (record := self._next()) is not None:
            found.append(record)
        return found

    def _next(self) -> tuple[int, Array, NDArray[np.bool_]] | None:
        start = self._pending()
        assert self._rows is not None
        if start is None:
            if self._quiet is not None:
                self._forget(self._rows.shape[1] - self._before - 1)
            return None
        if start + self._length > self._rows.shape[1]:
            return None
        part = slice(start, start + self._length)
        rows, flags = self._rows[:, part], np.asarray(self._overload[:, part].any(axis=1))
        first = self._first + start
        self._peaks.append(float(np.abs(rows[0] - self._offset).max()))
        self._armed_at = first + self._length
        self._forget(start + self._length)
        return first, rows, flags

    def _pending(self) -> int | None:
        """Where the record of the next blow begins, counted from the first sample kept."""
        level = self.level
        if level is None or self._rows is None:
            return None
        armed = max(0, self._armed_at - self._first)
        above = np.flatnonzero(np.abs(self._rows[0, armed:] - self._offset) > level)
        return max(0, armed + int(above[0]) - self._before) if above.size else None

    @property
    def _offset(self) -> float:
        return self._quiet[0] if self._quiet is not None else 0.0

    def _forget(self, count: int) -> None:
        assert self._rows is not None
        if count > 0:
            self._rows, self._overload = self._rows[:, count:], self._overload[:, count:]
            self._first += count
