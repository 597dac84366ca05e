"""Rows of the damping table, in words."""

from dataclasses import dataclass
from math import isnan

import numpy as np

from fitting.arrays import Array
from fitting.modal.frf import Refusal
from gui.pages.hammer.findings import ModesFound
from gui.widgets.tables import Cell, Row
from instrument.facts.damping import METHODS, DampingResult, Method, ModeFound, RatioFound
from instrument.impact.mode import Mode
from instrument.impact.scatter import Scatter
from instrument.results.error_words import ratio_error_words, ratio_words

_ADOPTED = 0
"""Of these."""
_SAME = 0.05
"""Relative distance beyond which an expected mode is another one."""
_AGREE = 1e-9
"""Relative: the same numbers, whatever JSON did to them."""

MODE_COLUMNS = {
    "f / Hz": "Natural frequency, undamped",
    "expected / Hz": "Of the bare plate by the specimen file, the accelerometer on it, in an ideal clamp",
    "rational fit / %": "Damping ratio by a pole fitted to the lines about the peak, ± one standard error: "
    "this one is adopted",
    "half power / %": "Damping ratio from the width of the peak at 1/√2 of its height, on a padded "
    "and windowed spectrum",
    "LSCF / %": "Damping ratio by poles that stay where they are at rising orders (least squares complex "
    "frequency)",
    "over hits / %": "Standard deviation of the rational fit's ratio from hit to hit, each hit alone",
    "lines": "Lines of the spectrum inside the half-power bandwidth: below 2 a longer record is wanted",
    "Flags": "What speaks against a mode's damping",
}


@dataclass(frozen=True)
class ModeRow:
    """One mode."""

    frequency_hz: float
    cells: Row


def mode_rows(
    result: DampingResult | None, modes: ModesFound | None, expected_hz: Array | None
) -> list[ModeRow]:
    """Of a result; what only the computation here knows is added where it has the same mode.

    `expected_hz` of shape (modes,).
    """
    found = result.modes if result is not None else ()
    return [_mode_row(k + 1, mode, modes, expected_hz) for k, mode in enumerate(found)]


def advice_of(result: DampingResult | None) -> str:
    """What the test teaches for the next one, and what was set right; the hit list has the rest."""
    if result is None:
        return ""
    told = {f"{hit.source} left out: {hit.why}" for hit in result.hits}
    return "; ".join(warning for warning in result.warnings if warning not in told)


def number_of(modes: ModesFound, frequency_hz: float) -> int | None:
    """Which of the modes computed here is the one at a frequency."""
    found = modes.found.modes if modes.found is not None else ()
    return near(np.array([m.frequency_hz for m in found]), frequency_hz)


def _mode_row(number: int, mode: ModeFound, modes: ModesFound | None, expected_hz: Array | None) -> ModeRow:
    f, lines, why = mode.frequency_hz, mode.lines_in_bandwidth, mode.why
    k = number_of(modes, f) if modes is not None else None
    found = modes.found.modes[k] if modes is not None and modes.found is not None and k is not None else None
    scatter = modes.scatter[k] if modes is not None and k is not None else None
    over_hits = "..." if modes is None else "–"
    if scatter is not None:
        over_hits = _narrow(ratio_error_words(mode.damping_ratio, scatter.ratio))
    return ModeRow(
        f,
        (
            Cell(f"{f:.3f}", f"mode {number} of those found", edge="fair" if why else None),
            Cell(_expected(f, expected_hz), _expected_tip(f, expected_hz)),
            *(
                Cell(
                    _percent(mode.by(method)), _method_tip(mode.by(method), method, found), bold=k == _ADOPTED
                )
                for k, method in enumerate(METHODS)
            ),
            Cell(over_hits, _scatter_tip(scatter)),
            Cell("–" if isnan(lines) else f"{lines:.1f}"),
            Cell(why, why.replace("; ", "\n"), left=True),
        ),
    )


def _scatter_tip(scatter: Scatter | None) -> str:
    if scatter is None:
        return "two hits or more have to give a value, each alone"
    ratio, hertz = f"± {100 * scatter.ratio:.1g} %", f"± {scatter.frequency_hz:.1g} Hz"
    return f"{scatter.hits} hits, each alone: ratio {ratio}, frequency {hertz} (standard deviations)"


def agree(recorded: DampingResult, computed: DampingResult) -> bool:
    """Whether two results of the same hits have the same adopted modes."""
    same = all(
        _close(a.frequency_hz, b.frequency_hz) and _close(a.damping_ratio, b.damping_ratio)
        for a, b in zip(recorded.modes, computed.modes, strict=False)
    )
    return len(recorded.modes) == len(computed.modes) and same


def near(frequencies_hz: Array, frequency_hz: float) -> int | None:
    """Which of these is the same mode; None where none is. Shape (n,)."""
    if len(frequencies_hz) == 0:
        return None
    k = int(np.argmin(np.abs(frequencies_hz - frequency_hz)))
    return k if abs(frequencies_hz[k] / frequency_hz - 1) < _SAME else None


def _close(x: float, y: float) -> bool:
    if isnan(x) or isnan(y):
        return isnan(x) and isnan(y)
    return abs(x - y) <= _AGREE * abs(y)


def _percent(estimate: RatioFound | None) -> str:
    if estimate is None:
        return "refused"
    return _narrow(ratio_words(estimate.ratio, estimate.standard_error, "±"))


def _narrow(words: str) -> str:
    """A column of numbers has no room for a word."""
    return words.replace("below ", "<")


def _method_tip(estimate: RatioFound | None, method: Method, found: Mode | None) -> str:
    if estimate is not None:
        error = estimate.standard_error
        known = ", no standard error" if isnan(error) else f" ± {100 * error:.2g}"
        return f"{100 * estimate.ratio:.6g}{known} % of critical damping"
    value = getattr(found, method) if found is not None else None
    return f"refused: {value.why}" if isinstance(value, Refusal) else "refused: see the flags"


def _expected(frequency_hz: float, expected_hz: Array | None) -> str:
    k = near(expected_hz, frequency_hz) if expected_hz is not None else None
    return "–" if k is None or expected_hz is None else f"{expected_hz[k]:.2f}"


def _expected_tip(frequency_hz: float, expected_hz: Array | None) -> str:
    k = near(expected_hz, frequency_hz) if expected_hz is not None else None
    if k is None or expected_hz is None:
        return "no mode of the specimen's bare plate is near"
    return (
        f"measured {100 * (frequency_hz / expected_hz[k] - 1):+.2f} % from the specimen file's mode {k + 1}"
    )
