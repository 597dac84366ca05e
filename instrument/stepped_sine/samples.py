"""Samples of one step, in a row from the moment its last command took effect."""

import numpy as np

from fitting.arrays import Array


class Samples:
    """Blocks of whatever length in, readings of a wanted length out. Units are the channels'."""

    def __init__(self, channels: int) -> None:
        self._channels = channels
        self._parts: list[Array] = []
        self.first: int | None = None
        """Index of the first sample kept; None before any."""
        self.count = 0

    @property
    def end(self) -> int:
        """Index after the last one."""
        return (self.first or 0) + self.count

    def add(self, first_sample: int, x: Array, begin: int) -> None:
        """Keep the part of x (channels, samples) at or after sample `begin`."""
        skip = max(0, begin - first_sample)
        if skip >= x.shape[1]:
            return
        if self.first is None:
            self.first = first_sample + skip
        self._parts.append(x[:, skip:])
        self.count += x.shape[1] - skip

    def take(self, count: int) -> tuple[int, Array]:
        """Remove and give the first `count` samples: their first index and (channels, count)."""
        assert self.first is not None
        assert self.count >= count
        whole = np.concatenate(self._parts, axis=1) if len(self._parts) > 1 else self._parts[0]
        first, self.first, self.count = self.first, self.first + count, self.count - count
        self._parts = [whole[:, count:]] if self.count else []
        return first, whole[:, :count]

    def clear(self) -> None:
        """Forget everything: a new command makes what came before worthless."""
        self._parts, self.first, self.count = [], None, 0
