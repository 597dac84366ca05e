"""Draws the response of what is seen into plots: foreseen, measured, fitted, and that of other files."""

from dataclasses import replace

import numpy as np

from fitting.arrays import Array
from gui.pages.sweep.curve import STANDARD_ERRORS, CurveStretch, joined
from gui.pages.sweep.panes import CHOSEN, Pointed, beside_look
from gui.pages.sweep.predicted import Predicted
from gui.pages.sweep.seen import PaneContents
from gui.plots import Axis
from gui.style.theme import Role

FREQUENCY = Axis("Frequency", "Hz", symbol="f")
FORESEEN = "foreseen"
EXPLAINED_ROLE: Role = "second"
"""Of what a diagnosis says with its effects."""


def draw_amplitude(plot: Pointed, seen: PaneContents) -> None:
    """Over frequency, with the model's band."""
    way = seen.way
    plot.show_axes(replace(FREQUENCY, log=way.log_frequency), Axis(way.label, way.unit, way.log_amplitude))
    names = _foreseen_amplitude(plot, seen) + _model_amplitude(plot, seen) + _explained_amplitude(plot, seen)
    for group in seen.points.groups(seen.wanted):
        plot.show_points(group, seen.points.frequency_hz[group.index], np.abs(seen.shown[group.index]))
        names.append(group.name)
    for k, one in enumerate(seen.beside):
        mine = one.inside(seen.band_hz)
        size = np.abs(one.over_base_s[mine]) * way.factor(one.level_m_s2[mine])
        plot.points(one.name, one.frequency_hz[mine], size, **beside_look(k))
        names.append(one.name)
    plot.keep((*names, CHOSEN))
    at = seen.chosen_here
    plot.point_out(
        float(seen.points.frequency_hz[at]) if at is not None else None,
        float(np.abs(seen.shown[at])) if at is not None else None,
    )
    plot.frame(seen.band_hz)
    plot.place_legend()


def draw_phase(plot: Pointed, seen: PaneContents) -> None:
    """Over frequency, with the model's band."""
    plot.show_axes(replace(FREQUENCY, log=seen.way.log_frequency), plot.y)
    names = []
    if stretches := seen.stretches(seen.foreseen):
        _phase_line(plot, FORESEEN, stretches, seen, foreseen=True)
        names.append(FORESEEN)
    if stretches := seen.stretches(seen.curve):
        _phase_line(plot, _model_name(seen), stretches, seen)
        names.append(_model_name(seen))
        for number, s in _with_band(stretches):
            phase, half = s.phase_deg(seen.points), STANDARD_ERRORS * s.phase_std_deg
            plot.band(f"band {number}", s.frequency_hz, phase - half, phase + half)
            names.append(f"band {number}")
    names += _explained_phase(plot, seen)
    p = seen.points
    for group in p.groups(seen.wanted):
        plot.show_points(group, p.frequency_hz[group.index], p.phase_deg[group.index])
        names.append(group.name)
    for k, one in enumerate(seen.beside):
        if not one.has_phase:
            continue
        mine = one.inside(seen.band_hz)
        phase = np.unwrap(np.degrees(np.angle(one.over_base_s[mine])), period=360.0)
        plot.points(one.name, one.frequency_hz[mine], phase, **beside_look(k))
        names.append(one.name)
    plot.keep((*names, CHOSEN))
    at = seen.chosen_here
    plot.point_out(
        float(p.frequency_hz[at]) if at is not None else None,
        float(p.phase_deg[at]) if at is not None else None,
    )
    plot.frame(seen.band_hz)


def _explained_name(seen: PaneContents) -> str:
    return f"{seen.explained.name}, at points"


def _model_name(seen: PaneContents) -> str:
    return f"model, {seen.fit_name}, \u00b1{STANDARD_ERRORS:g} s.e.{seen.whose}"


def _with_band(stretches: list[CurveStretch]) -> list[tuple[int, CurveStretch]]:
    known = (s for s in stretches if np.isfinite(s.amplitude_std_s).all())
    return list(enumerate(known, start=1))


def _phase_line(
    plot: Pointed, name: str, stretches: list[CurveStretch], seen: PaneContents, *, foreseen: bool = False
) -> None:
    plot.line(
        name,
        joined([s.frequency_hz for s in stretches]),
        joined([s.phase_deg(seen.points) for s in stretches]),
        "faint" if foreseen else "model",
        dashed=foreseen,
    )


def _foreseen_amplitude(plot: Pointed, seen: PaneContents) -> list[str]:
    stretches = seen.stretches(seen.foreseen)
    if not stretches:
        return []
    drawn = [(s, f) for s in stretches for f in seen.way.factor(seen.levels(s.segment))]
    plot.line(
        FORESEEN,
        joined([s.frequency_hz for s, _ in drawn]),
        joined([f * np.abs(s.over_base_s) for s, f in drawn]),
        "faint",
        dashed=True,
    )
    return [FORESEEN]


def _model_amplitude(plot: Pointed, seen: PaneContents) -> list[str]:
    """The curve of the specimen file's spot; of others what the fit says at the points. Names it."""
    here = _predicted_amplitude(plot, seen, "") if seen.curve is None else _curve_amplitude(plot, seen)
    return here + [name for p in seen.points.places if p for name in _predicted_amplitude(plot, seen, p)]


def _curve_amplitude(plot: Pointed, seen: PaneContents) -> list[str]:
    stretches = seen.stretches(seen.curve)
    if not stretches:
        return []
    name = _model_name(seen)
    names = [name]
    drawn = [(s, f) for s in stretches for f in seen.way.factor(seen.levels(s.segment))]
    for number, (s, factor) in enumerate(drawn, start=1):
        if not np.isfinite(s.amplitude_std_s).all():
            continue
        names.append(f"band {number}")
        size, half = np.abs(s.over_base_s), STANDARD_ERRORS * s.amplitude_std_s
        low = np.maximum(size - half, 1e-3 * size)
        plot.band(names[-1], s.frequency_hz, factor * low, factor * (size + half))
    plot.line(
        name,
        joined([s.frequency_hz for s, _ in drawn]),
        joined([f * np.abs(s.over_base_s) for s, f in drawn]),
    )
    return names


def _predicted_amplitude(plot: Pointed, seen: PaneContents, place: str) -> list[str]:
    """Of one place, until there is a curve: what the fit itself says, at the points it took."""
    name = f"model at the points, {seen.fit_name}{f', {place}' if place else ''}"
    return _at_points(plot, name, seen, seen.predicted, _amplitude(seen, seen.predicted), place=place)


def _explained_amplitude(plot: Pointed, seen: PaneContents) -> list[str]:
    """What the diagnosis says with its effects, at every point it took."""
    return _at_points(
        plot, _explained_name(seen), seen, seen.explained, _amplitude(seen, seen.explained), EXPLAINED_ROLE
    )


def _explained_phase(plot: Pointed, seen: PaneContents) -> list[str]:
    phase = seen.points.phase_deg[seen.explained.index] + seen.explained.turn_deg
    return _at_points(plot, _explained_name(seen), seen, seen.explained, phase, EXPLAINED_ROLE)


def _amplitude(seen: PaneContents, predicted: Predicted) -> Array:
    """In the unit of the way chosen. Shape (taken,)."""
    level = seen.points.level_m_s2[predicted.index]
    return predicted.amplitude_m_s / level * seen.way.factor(level)


def _at_points(
    plot: Pointed,
    name: str,
    seen: PaneContents,
    predicted: Predicted,
    values: Array,
    role: Role = "model",
    *,
    place: str | None = None,
) -> list[str]:
    """A line through the points of each segment, pass, level and place; of all places where none is said.

    `values` are of the points taken, shape (taken,). What is drawn, by name: nothing where none is wanted.
    """
    p = seen.points
    mine = seen.wanted & ~p.sentinel
    if place is not None:
        mine &= p.read_at(place)
    taken = mine[predicted.index] & np.isfinite(values)
    if not taken.any():
        return []
    k, y = predicted.index[taken], values[taken]
    f = p.frequency_hz[k]
    line = np.stack([p.segment[k], p.number_of_pass[k]])
    order = np.lexsort((f, line[1], line[0]))
    f, y, line = f[order], y[order], line[:, order]
    gaps = np.flatnonzero(np.diff(line).any(axis=0)) + 1
    plot.line(name, joined(np.split(f, gaps)), joined(np.split(y, gaps)), role)
    return [name]
