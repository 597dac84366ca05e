"""Natural frequencies and damping ratios of the bare plate, from hits or FRFs."""

from collections.abc import Sequence
from dataclasses import KW_ONLY, dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray
from pydantic import ValidationError

from fitting.errors import TooFewPoints
from instrument.errors import BadInput
from instrument.facts.damping import METHODS, DampingResult, ModeFound
from instrument.files.hammer_file import HammerModes, hammer_modes, read_hammer
from instrument.files.impact_csv import MOTIONS
from instrument.files.records import Named, read_records
from instrument.files.toml import one_line
from instrument.impact.damping import damping_of_frfs, damping_of_hits
from instrument.impact.judge import judge
from instrument.impact.record import Hit as Record
from instrument.impact.record import ResponseChannel
from instrument.impact.result import damping_from
from instrument.impact.spectra import Estimator
from instrument.results.law_words import aligned
from instrument.results.numbers import with_error
from viscorig.checked import numbers
from viscorig.facts import Facts
from viscorig.shown import Columns

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Array = NDArray[np.float64]

_SAME_RATE = 1e-4
"""Relative: hits of one test have one sample rate but for rounding."""
_NAMES = {"rational_fit": "rational fit", "half_power": "half power", "lscf": "LSCF"}


@dataclass(frozen=True, eq=False, repr=False)
class Hit:
    """One blow: force and at least one motion that it caused, on one clock. Shape (samples,) each."""

    force_n: ArrayLike
    sample_rate_hz: float
    _: KW_ONLY
    acceleration_m_s2: ArrayLike | None = None
    velocity_m_s: ArrayLike | None = None
    displacement_m: ArrayLike | None = None
    name: str = "hit"

    def __repr__(self) -> str:
        motions = [name for name in MOTIONS if getattr(self, name) is not None]
        count, with_ = np.size(self.force_n), ", ".join(motions) or "no motion"
        return f"<Hit: {self.name}, {count} samples at {self.sample_rate_hz:g} Hz, {with_}>"

    def record(self) -> Record:
        """A record as files have them. Raises `BadInput` without a motion, or where lengths differ."""
        force = numbers(f"{self.name}: force_n", self.force_n, float)
        channels = tuple(
            ResponseChannel(column, motion, numbers(f"{self.name}: {column}", samples, float, len(force)))
            for column, motion in MOTIONS.items()
            if (samples := getattr(self, column)) is not None
        )
        if not channels:
            raise BadInput(f"{self.name}: force alone, expected one of {', '.join(MOTIONS)} beside it")
        (rate,) = numbers(f"{self.name}: sample_rate_hz", self.sample_rate_hz, float, 1, above_zero=True)
        return Record(self.name, float(rate), force, channels)


@dataclass(frozen=True, repr=False)
class Damping(Facts[DampingResult]):
    """Modes of a hammer test by three methods, one adopted: the JSON of `viscorig damping`."""

    @property
    def frequency_hz(self) -> Array:
        """Natural frequencies of the accepted modes. Shape (modes,)."""
        return np.array([m.frequency_hz for m in self.result.accepted], dtype=float)

    @property
    def damping_ratio(self) -> Array:
        """Adopted ratios of the accepted modes, fractions of critical. Shape (modes,)."""
        return np.array([m.damping_ratio for m in self.result.accepted], dtype=float)

    def to_numpy(self) -> Columns:
        """The modes as a table, accepted or not, a row each; what a method does not give is NaN."""
        modes = self.result.modes
        found: Columns = {
            "frequency_hz": np.array([m.frequency_hz for m in modes], dtype=float),
            "damping_ratio": np.array([m.damping_ratio for m in modes], dtype=float),
        }
        for method in METHODS:
            said = [m.by(method) for m in modes]
            found[f"{method}_ratio"] = np.array([e.ratio if e else np.nan for e in said], dtype=float)
            errors = [e.standard_error if e else np.nan for e in said]
            found[f"{method}_standard_error"] = np.array(errors, dtype=float)
        return {
            **found,
            "accepted": np.array([m.accepted for m in modes], dtype=bool),
            "why": np.array([m.why for m in modes], dtype=str),
        }

    def lines(self) -> list[str]:
        """How many modes were accepted, and the warnings."""
        return [f"{len(self.result.accepted)} modes of {len(self.result.modes)} accepted", *self.warnings]

    def printed(self) -> list[str]:
        """Frequencies and adopted ratios of the accepted modes, with their standard errors."""
        rows = []
        for mode in self.result.accepted:
            adopted = next((found for method in METHODS if (found := mode.by(method))), None)
            error = adopted.standard_error if adopted else None
            f = with_error(mode.frequency_hz, mode.frequency_standard_error_hz)
            rows.append([f, with_error(mode.damping_ratio, error, 100)])
        return aligned(["frequency/Hz", "damping ratio/%"], rows) if rows else []

    def plot(self, ax: "Axes | None" = None) -> "Axes":
        """Ratios by the three methods over frequency, with one standard error; the axes."""
        from viscorig.plots import plot_ratios

        return plot_ratios(ax, self.to_numpy(), _NAMES)


def damping(
    records: str | Path | Hit | Sequence[str | Path | Hit],
    *,
    band_hz: tuple[float, float] | None = None,
    at_hz: Sequence[float] = (),
    estimator: Estimator = "h1",
    exponential_percent: float | None = None,
) -> Damping:
    """Natural frequencies and damping ratios of hits, averaged, or of the FRFs of one file.

    `records` are files (.csv, .lvm, .uff, .unv, .mat) or `Hit`s. `at_hz` names modes instead of looking for
    them in `band_hz`; `exponential_percent` is where an exponential window ends, its damping taken off
    again. The same numbers as `viscorig damping`. Raises `BadInput`.
    """
    given = [records] if isinstance(records, str | Path | Hit) else list(records)
    read = [[r.record()] if isinstance(r, Hit) else read_records(Path(r), Named()) for r in given]
    band, at = band_hz, tuple(at_hz)
    frfs = [r for r in read if isinstance(r, dict)]
    if frfs and len(read) > 1:
        raise BadInput("FRFs are read one file at a time, and not beside records")
    if frfs:
        return Damping(damping_from(damping_of_frfs(frfs[0], band_hz=band, at_hz=at)))
    hits = [hit for one in read for hit in one if isinstance(hit, Record)]
    _refuse_unlike(hits)
    judged, end = [judge(h) for h in hits], exponential_percent / 100 if exponential_percent else None
    found = damping_of_hits(judged, band_hz=band, at_hz=at, estimator=estimator, end_value=end)
    return Damping(damping_from(found))


HammerTest = Damping | str | Path | tuple[ArrayLike, ArrayLike]
"""A result of `damping`, the JSON of `viscorig damping`, or natural frequencies in Hz and ratios."""


def hammer_modes_of(hammer: HammerTest | None) -> HammerModes | None:
    """What a fit takes of a hammer test. Raises `BadInput`."""
    if hammer is None:
        return None
    if isinstance(hammer, str | Path):
        return read_hammer(Path(hammer))
    try:
        return hammer_modes(hammer.result if isinstance(hammer, Damping) else _given_modes(*hammer))
    except ValidationError as error:
        raise BadInput(one_line(error, prefix="hammer test: ")) from None
    except TooFewPoints as error:
        raise BadInput(f"hammer test: {error}") from None


def _given_modes(frequency_hz: ArrayLike, damping_ratio: ArrayLike) -> DampingResult:
    f, ratio = np.atleast_1d(frequency_hz), np.atleast_1d(damping_ratio)
    if f.shape != ratio.shape:
        raise BadInput(f"hammer test: {f.size} frequencies and {ratio.size} ratios, expected as many")
    pairs = zip(f.tolist(), ratio.tolist(), strict=True)
    return DampingResult(modes=tuple(ModeFound(frequency_hz=a, damping_ratio=b) for a, b in pairs))


def _refuse_unlike(hits: list[Record]) -> None:
    """Only hits of one length, rate and set of channels can be averaged."""
    for hit in hits[1:]:
        first, now = _kind(hits[0]), _kind(hit)
        if now[1:] != first[1:] or abs(now[0] / first[0] - 1) > _SAME_RATE:
            raise BadInput(
                f"{hit.source}: {now[1]} samples of {now[2]} at {now[0]:g}/s, expected {first[1]} of "
                f"{first[2]} at {first[0]:g}/s as in {hits[0].source}"
            )


def _kind(hit: Record) -> tuple[float, int, str]:
    return hit.sample_rate_hz, len(hit.force_n), ", ".join(c.name for c in hit.responses)
