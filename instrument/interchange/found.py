"""What a foreign file holds once it is understood: sweeps, FRFs, hits, in SI units."""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array, Complex
from fitting.gravity import PUBLISHED_G_M_S2
from fitting.modal.frf import Frf, Motion
from fitting.mode_tables.as_read import Read
from fitting.specimen import Reading
from instrument.errors import BadInput
from instrument.files.impact_csv import MOTIONS
from instrument.files.units import DERIVATIVE, Quantity
from instrument.impact.record import Hit, ResponseChannel

Columns = dict[str, Array]
"""Of the sweep CSV, by their names."""

CARRIED = ("mass_kg", "mounting", "temperature_c")
"""Columns of ours that say of which plate, or at what temperature, a row is: whoever fits asks about them.
NaN where it is not known."""
EXPECTED = (
    "a frequency with a velocity or an FRF, a force with a response and times, or mode, frequency and loss "
    "factor; units in the names, as in velocity_mm_s, frf_mm_s_per_g or 'Force [N]'"
)
"""Of a table of named columns, for people."""
REFERENCE_M_S2 = PUBLISHED_G_M_S2
"""Base acceleration a ratio is stated at where its level is not known: it cancels in the fit."""
_CSV_NAMES = {motion: name for name, motion in MOTIONS.items()}


@dataclass(frozen=True)
class Ratio:
    """One signal over another on lines of frequency: an FRF as a foreign file has it, in SI units."""

    name: str
    frequency_hz: Array
    H: Complex
    quantity: Quantity
    per: Quantity
    level_m_s2: float | None = None
    """Base acceleration it was measured at."""
    place: tuple[int, int] | None = None
    """Sweep and segment, where the file says."""
    response: str = ""
    """Between which points: ratios of one name are passes, of several ones they are spots."""
    beside: Columns = field(default_factory=dict)
    """Columns of ours on the same lines, of a ratio over a base's motion."""


@dataclass(frozen=True)
class Modes:
    """A table of modes in the columns of ours."""

    columns: Columns
    read: Read | None = None
    """How the numbers were read, where it is known."""


@dataclass
class Found:
    """Everything a file gave."""

    sweeps: list[Columns] = field(default_factory=list)
    frfs: list[tuple[str, Frf, Array | None]] = field(default_factory=list)
    """Name, motion over force, coherence."""
    hits: list[Hit] = field(default_factory=list)
    modes: list[Modes] = field(default_factory=list)
    reads: Reading | None = None
    """What the laser of its sweeps sees, where the file says."""
    said: list[str] = field(default_factory=list)
    """What was found, and what was passed over and why: one line each."""
    lines: Sequence[int] = ()
    """Of a text, that of each row of its table."""
    _responses: list[tuple[str, Columns]] = field(default_factory=list)
    """Of the sweeps that are ratios."""

    def add_ratio(self, ratio: Ratio, coherence: Array | None = None) -> None:
        """To the sweeps where it is over a base's motion, to the FRFs where it is over a force.

        Shape (lines,).
        """
        f = ratio.frequency_hz
        good = (f > 0) & np.isfinite(ratio.H) & (ratio.H != 0)
        left = f"; left out at 0 Hz or without a value: {np.sum(~good)}" if not good.all() else ""
        if not good.any():
            self.said.append(f"passed over: {ratio.name}: no line with a value above 0 Hz")
            return
        what = f"{ratio.quantity} over {'base ' if ratio.per != 'force' else ''}{ratio.per}"
        band = f"{good.sum()} lines, {f[good].min():.5g} to {f[good].max():.5g} Hz"
        self.said.append(f"{ratio.name}: {what}, {band}{left}")
        if ratio.per == "force":
            self._add_frf(ratio, good, coherence)
        else:
            self._add_sweep(ratio.response, _columns(ratio, good))

    def lines_of(self, rows: int) -> Sequence[int]:
        """Of a table of so many rows, where it is all of the text's; else none."""
        return self.lines if len(self.lines) == rows else ()

    def place(self, row: int, rows: int) -> str:
        """Of a row, from 0, of a table of so many: a line where it is known."""
        lines = self.lines_of(rows)
        return f"line {lines[row]}" if lines else f"row {row + 1} of {rows}"

    @property
    def spots(self) -> list[str]:
        """Names of the responses by their numbers in the column `pickup`; empty for a single one."""
        names = list(dict.fromkeys(name for name, _ in self._responses))
        return names if len(names) > 1 else []

    def _add_sweep(self, response: str, columns: Columns) -> None:
        """Of several responses none is another's pass: each is a spot of its own."""
        self.sweeps.append(columns)
        self._responses.append((response, columns))
        spots = self.spots
        for name, theirs in self._responses if spots else ():
            theirs["pickup"] = np.full(len(theirs["frequency_hz"]), float(spots.index(name)))

    def _add_frf(self, ratio: Ratio, good: NDArray[np.bool_], coherence: Array | None) -> None:
        motion = motion_of(ratio.name, ratio.quantity)
        kept = coherence[good] if coherence is not None and len(coherence) == len(good) else None
        self.frfs.append((ratio.name, Frf(ratio.frequency_hz[good], ratio.H[good], motion), kept))

    def add_hit(
        self, source: str, rate_hz: float, force: Array, responses: list[tuple[Motion, Array]]
    ) -> None:
        """A blow and its responses. Shape (samples,) each. Raises `BadInput` for a rate that is none."""
        if not np.isfinite(rate_hz) or rate_hz <= 0:
            raise BadInput(f"{source}: sample rate {rate_hz:g} Hz, expected more than 0")
        channels = tuple(ResponseChannel(_CSV_NAMES[motion], motion, x) for motion, x in responses)
        self.hits.append(Hit(source, float(rate_hz), force, channels))
        motions = ", ".join(motion for motion, _ in responses)
        length = f"{len(force)} samples at {rate_hz:g} Hz ({len(force) / rate_hz:.3g} s)"
        self.said.append(f"{source}: force and {motions}, {length}")


def motion_of(name: str, quantity: Quantity) -> Motion:
    """A response has to be a motion. Raises `BadInput`."""
    if quantity == "force":
        raise BadInput(f"{name}: a force as response, expected displacement, velocity or acceleration")
    return quantity


def _columns(ratio: Ratio, good: NDArray[np.bool_]) -> Columns:
    """Velocity over acceleration, whatever motions the ratio is of: each derivative is i omega."""
    name = ratio.name
    f, H = ratio.frequency_hz[good], ratio.H[good]
    turns = 1 - DERIVATIVE[motion_of(name, ratio.quantity)] + DERIVATIVE[motion_of(name, ratio.per)] - 2
    base = ratio.level_m_s2 or REFERENCE_M_S2
    v = H * (2j * np.pi * f) ** turns * base
    columns = {
        "frequency_hz": f,
        "velocity_re_m_s": v.real,
        "velocity_im_m_s": v.imag,
        "base_accel_re_m_s2": np.full(len(f), base),
        "base_accel_im_m_s2": np.zeros(len(f)),
    } | {own: values[good] for own, values in ratio.beside.items()}
    if ratio.level_m_s2 is not None:
        columns["level_g"] = np.full(len(f), ratio.level_m_s2 / REFERENCE_M_S2)
    if ratio.place is not None:
        columns["sweep"], columns["segment"] = (np.full(len(f), float(n)) for n in ratio.place)
    return columns
