"""Figures of a diagnosis: residual before and after, evidence, law. Drawn from its result alone."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from fitting.arrays import Array
from fitting.digits import two_digits
from fitting.numerics.chances import Z_95
from fitting.sweep import segments_by_gap
from instrument.facts.diagnosis import DiagnosisResult, PointLeft, StageName
from instrument.facts.result import Result
from instrument.results.diagnosis_words import log_odds, probability_words, segment_place, with_verdict
from instrument.results.drawing import (
    DATA,
    MARK,
    MODEL,
    SECOND,
    TWO_STD,
    WIDTH_IN,
    label,
    legend_above,
    mark_set_aside,
)
from instrument.results.saved_figures import save_figures
from instrument.results.standing import (
    Standing,
    is_one_of_several,
    laws_apart,
    one_fit_words,
    stages_apart,
    standing,
)

_MOST_BARS = 12
_PARTS = (
    ("re_percent", "real part", DATA, "o"),
    ("im_percent", "imaginary part", SECOND, "s"),
    ("amplitude_percent", "amplitude", DATA, "o"),
)
_MOST_SEGMENTS = 5
_OTHER = "#9bb8d3"
_BAR_COLOURS: dict[Standing, str] = {"found": MARK, "equal": MODEL, "none": "#444444", "other": _OTHER}
_BAR_NAMES = {MARK: "found", MODEL: "not to be told apart", _OTHER: "others"}


def save_diagnosis_figures(found: DiagnosisResult, folder: Path) -> list[Path]:
    """Three PNG. Raises `BadInput` where the folder cannot be written."""
    drawn = {
        "diagnosis-residual.png": residual_figure(found),
        "diagnosis-evidence.png": evidence_figure(found),
        "diagnosis-law.png": law_figure(found),
    }
    return save_figures(drawn, folder, 110)


def residual_figure(found: DiagnosisResult) -> Figure:
    """What is left over frequency: a row a segment, before on the left, after on the right where it differs.

    Each has a scale of its own: on the other's, what the effects leave would be a line.
    """
    points = found.points
    every = sorted({p.segment for p in points})
    numbers = every[:_MOST_SEGMENTS]
    rows = len(numbers)
    figure = Figure(figsize=(WIDTH_IN, 1.2 + 1.75 * rows), layout="constrained")
    stages = stages_apart(found)
    axes = figure.subplots(rows, len(stages), squeeze=False, sharex="row")
    for number, pair in zip(numbers, axes, strict=True):
        mine = _together([p for p in points if p.segment == number])
        aside = [p.frequency_hz for p in found.points_set_aside if p.segment == number]
        for ax, stage in zip(pair, stages, strict=True):
            _draw_residual(ax, mine, stage, aside)
            rms = found.stage(stage).rms_percent
            named = stage if len(stages) > 1 else "without any effect"
            first = (
                f"{named}: {two_digits(rms)} % rms in amplitude, own scale" if number == numbers[0] else ""
            )
            label(ax, title=first, x="Frequency / Hz" if number == numbers[-1] else "")
        place = segment_place(found, number)
        label(pair[0], y="\n".join(part for part in (f"Segment {number}", place, "residual / %") if part))
    if len(every) > len(numbers):
        said = f"the first {len(numbers)} of {len(every)} segments"
        axes[-1, 0].annotate(said, (0.0, -0.42), xycoords="axes fraction", fontsize=8)
    legend_above(figure, *axes[:, 0])
    return figure


def _together(points: Sequence[PointLeft]) -> list[PointLeft]:
    """Ascending in frequency, without a sentinel far off: it would leave no room for the others."""
    points = sorted(points, key=lambda p: p.frequency_hz)
    cluster = segments_by_gap(_column(points, "frequency_hz"))
    largest = np.bincount(cluster).argmax()
    return [p for p, c in zip(points, cluster, strict=True) if c == largest]


def _draw_residual(
    ax: Axes, points: Sequence[PointLeft], stage: StageName, aside_hz: Sequence[float]
) -> None:
    # A band for each pass and level: between them the noise jumps.
    for k, alike in enumerate(sorted({(p.sweep, p.level_m_s2) for p in points})):
        mine = [p for p in points if (p.sweep, p.level_m_s2) == alike]
        band = TWO_STD * _column(mine, "noise_percent")
        if np.isfinite(band).all():
            name = "noise alone, ± 2 std (chi² counts the model error too)" if k == 0 else None
            f = _column(mine, "frequency_hz")
            ax.fill_between(f, -band, band, color="#888888", alpha=0.2, linewidth=0, label=name)
    ax.axhline(0, color="#888888", linewidth=0.8)
    left = [p.stage(stage) for p in points]
    f, has_phase = _column(points, "frequency_hz"), left[0].has_phase
    mark_set_aside(ax, np.array(aside_hz))
    for key, name, colour, marker in _PARTS:
        if (key == "amplitude_percent") != has_phase:
            ax.plot(f, _column(left, key), marker, color=colour, markersize=3, label=name)


def evidence_figure(found: DiagnosisResult) -> Figure:
    """How far each of the best candidates stands above the fit without any effect."""
    candidates = found.candidates
    shown = candidates[:_MOST_BARS]
    shown += tuple(c for c in candidates[_MOST_BARS:] if c.name == "none")
    odds = dict(zip((c.name for c in candidates), log_odds(found), strict=True))
    gain = np.array([odds[c.name] for c in shown], dtype=float)
    colours = [_BAR_COLOURS[standing(c.name, found)] for c in shown]
    figure = Figure(figsize=(WIDTH_IN, 1.4 + 0.3 * len(shown)), layout="constrained")
    ax = figure.subplots()
    ax.barh(np.arange(len(shown)), gain, color=colours)
    ax.axvline(0, color="#444444", linewidth=1)
    # What is far worse than no effect at all needs no scale.
    best = float(gain.max())
    lowest = max(1.1 * float(gain.min()), -max(best, 10.0))
    ax.set_xlim(lowest, max(1.3 * best, 0.5 * abs(lowest), 5.0))
    for k, c in enumerate(shown):
        chi2 = "" if c.chi2_per_dof is None else f", chi² {c.chi2_per_dof:.3g}"
        said = probability_words(c, found)
        place = (max(float(gain[k]), 0.0), k)
        ax.annotate(said + chi2, place, (4, 0), textcoords="offset points", va="center", fontsize=8)
    ax.set_yticks(np.arange(len(shown)), [c.name for c in shown])
    ax.invert_yaxis()
    label(
        ax,
        x="times as likely as no effect, in powers of e: 3 is 20 times "
        "(labels: probability, chi² per degree of freedom)",
    )
    names = _BAR_NAMES | ({MARK: "the likeliest"} if is_one_of_several(found) else {})
    handles = [Patch(color=colour, label=name) for colour, name in names.items() if colour in colours]
    figure.legend(handles=handles, loc="outside upper center", ncols=4, fontsize=8, frameon=False)
    return figure


def law_figure(found: DiagnosisResult) -> Figure:
    """G' and eta before and after with 95 % bands; one law where no effect is accepted."""
    figure = Figure(figsize=(WIDTH_IN, 4.2), layout="constrained")
    left, right = figure.subplots(1, 2)
    stages: list[tuple[StageName, str, str]] = [("before", MODEL, "--"), ("after", DATA, "-")]
    apart = laws_apart(found)
    for stage, colour, style in (one for one in stages if one[0] in apart):
        law = found.stage(stage).law
        f = _column(law, "frequency_hz")
        for ax, key, error, scale in (
            (left, "storage_modulus_pa", "storage_modulus_standard_error_pa", 1e-6),
            (right, "loss_factor", "loss_factor_standard_error", 1.0),
        ):
            value, spread = scale * _column(law, key), Z_95 * scale * _column(law, error)
            name = stage if len(apart) > 1 else one_fit_words(found)
            ax.plot(f, value, style if len(apart) > 1 else "-", color=colour, label=name)
            if np.isfinite(spread).all():
                ax.fill_between(f, value - spread, value + spread, color=colour, alpha=0.2, linewidth=0)
    for ax, y in ((left, "Storage modulus G' / MPa"), (right, "Loss factor η")):
        label(ax, x="Frequency / Hz", y=y)
        ax.set_ylim(bottom=min(0.0, ax.get_ylim()[0]))
    which = " before and after the diagnosis" if len(apart) > 1 else ""
    title = with_verdict(f"The core's law{which}, 95 % bands", found)
    left.set_title(title, fontsize=10, loc="left")
    left.legend(fontsize=8, frameon=False)
    return figure


def _column(rows: Sequence[Result], key: str) -> Array:
    return np.array([getattr(row, key) for row in rows], dtype=float)
