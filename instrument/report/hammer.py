"""The hammer test: hits, modes by three methods, FRF."""

from collections.abc import Sequence
from math import isnan

import numpy as np
from matplotlib.figure import Figure

from instrument.errors import BadInput
from instrument.facts.damping import METHODS, DampingResult, RatioFound
from instrument.impact.damping import Damping, damping_of_hits
from instrument.impact.figures import highest_hz
from instrument.impact.result import damping_from
from instrument.report.blocks import Block, FigureBlock, ReportSection, Sentence, TableBlock
from instrument.results.drawing import DATA, MARK, label, panels
from instrument.results.error_words import ratio_words
from instrument.results.numbers import format_number
from instrument.session.contents import Contents, RecordedHit

_WITHOUT_MODES_HZ = 1250.0
"""Up to here an FRF without modes is drawn."""


def hammer_section(contents: Contents) -> ReportSection:
    """Computed again from the hits as they were recorded."""
    kind = contents.specimen.kind
    # A pair is never struck.
    title = "Hammer test" if kind == "shear-pair" else f"Hammer test of the bare {kind}"
    if not contents.hits:
        return ReportSection(title, (Sentence("There is no hammer test in this session.", "note"),))
    blocks: list[Block] = [hits_table(contents.hits)]
    try:
        found = damping_of_hits([h.judged() for h in contents.hits], band_hz=_band_hz(contents))
    except BadInput as error:
        return ReportSection(title, (*blocks, Sentence(f"No damping: {error}.", "warning")))
    result = damping_from(found)
    blocks += [_modes(result), _agreement(contents, result), _frf(contents, found)]
    blocks += [Sentence(warning, "note") for warning in found.warnings]
    return ReportSection(title, tuple(blocks))


def _band_hz(contents: Contents) -> tuple[float, float] | None:
    hammer = contents.configuration.experiment.hammer
    return (hammer.band_hz[0], hammer.band_hz[1]) if hammer is not None else None


def hits_table(hits: Sequence[RecordedHit]) -> TableBlock:
    """A row each, with why those were left out that were."""
    rows = tuple(
        (
            str(h.number),
            format_number(h.peak_n),
            f"{h.record.seconds:.3g}",
            "accepted" if h.accepted else "left out",
            h.why or ("" if h.accepted else "by the operator"),
        )
        for h in hits
    )
    return TableBlock("Hits", ("hit", "peak / N", "record / s", "verdict", "why"), rows)


def _modes(result: DampingResult) -> TableBlock:
    rows = tuple(
        (
            f"{m.frequency_hz:.3f}",
            *(_percent(m.by(method)) for method in METHODS),
            format_number(m.lines_in_bandwidth, 2),
            m.why,
        )
        for m in result.modes
    )
    columns = ("f / Hz", "rational fit / %", "half power / %", "LSCF / %", "lines in bandwidth", "remarks")
    return TableBlock(
        "Damping ratios by three methods, ± one standard error by these hits' noise, half power's with what "
        "it is off the fit (another mounting is not in it); the rational fit is adopted",
        columns,
        rows,
    )


def _percent(e: RatioFound | None) -> str:
    return ratio_words(e.ratio, e.standard_error, "±") if e else "refused"


def _agreement(contents: Contents, result: DampingResult) -> Sentence:
    """What the run itself had found from the same hits."""
    if contents.damping is None:
        return Sentence(
            "The run itself kept no result of this test: the table was computed for this page.", "note"
        )
    recorded = [m.damping_ratio for m in contents.damping.result.modes]
    now = [m.damping_ratio for m in result.modes]
    same = len(recorded) == len(now) and all(
        isnan(a) or abs(a - b) <= 1e-9 * abs(b) for a, b in zip(recorded, now, strict=True)
    )
    if same:
        return Sentence("The run itself had found the same from these hits.")
    return Sentence(
        "The run itself had found other values: another version, or hits judged differently.", "warning"
    )


def _frf(contents: Contents, found: Damping) -> Block:
    good = len(contents.good_hits)
    coherence = f", with the coherence of {good} hits" if good > 1 else "; one hit has no coherence"
    return FigureBlock(
        _figure(found, _band_hz(contents)), f"Accelerance of the bare plate, its modes marked{coherence}"
    )


def _figure(found: Damping, band_hz: tuple[float, float] | None) -> Figure:
    """Magnitude over the band, and coherence below it where there are several hits."""
    (name, frf), *_ = found.plain.items()
    low, high = band_hz or (frf.frequency_hz[1], highest_hz(found) or _WITHOUT_MODES_HZ)
    inside = (frf.frequency_hz >= low) & (frf.frequency_hz <= high)
    with_coherence = found.coherence is not None and sum(j.accepted for j in found.hits) > 1
    figure, rows = panels(2 if with_coherence else 1, 1, 5.0 if with_coherence else 3.6)
    above = rows[0][0]
    above.semilogy(frf.frequency_hz[inside], np.abs(frf.H[inside]), color=DATA, linewidth=0.9)
    for mode in found.modes:
        above.axvline(mode.frequency_hz, color=MARK, linewidth=0.8, alpha=0.6)
    label(above, y="Accelerance / (m/s²/N)")
    if with_coherence and found.coherence is not None:
        below = rows[1][0]
        below.plot(frf.frequency_hz[inside], found.coherence[name][inside], color=DATA, linewidth=0.8)
        below.set_ylim(0, 1.05)
        label(below, y="Coherence")
    label(rows[-1][0], x="Frequency / Hz")
    return figure
