"""Figures of a plan: the errors it leaves with its steps, and the map of spots, from its result alone."""

from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from fitting.digits import two_digits
from instrument.facts.plan import PlanResult
from instrument.results.drawing import (
    DATA,
    MARK,
    MODEL,
    SECOND,
    WIDTH_IN,
    frequency_in_octaves,
    label,
    legend,
)
from instrument.results.saved_figures import save_figures


def save_plan_figures(found: PlanResult, folder: Path) -> list[Path]:
    """One or two PNG. Raises `BadInput` where the folder cannot be written."""
    drawn = {"plan-errors.png": errors_figure(found)}
    if found.spots:
        drawn["plan-spots.png"] = spots_figure(found)
    return save_figures(drawn, folder, 110)


def errors_figure(found: PlanResult) -> Figure:
    """Predicted standard errors over the band, the steps as ticks below."""
    figure = Figure(figsize=(WIDTH_IN, 4.0), layout="constrained")
    ax = figure.subplots()
    f = [row.frequency_hz for row in found.law]
    ax.plot(f, [row.storage_modulus_percent for row in found.law], color=DATA, label="G'")
    ax.plot(f, [row.loss_factor_percent for row in found.law], color=MODEL, label="loss factor")
    ax.axhline(found.target_percent, color=MARK, ls="--", lw=1, label="target")
    for what, color in (("law", DATA), ("causes", SECOND)):
        at = [s.frequency_hz for s in found.steps if s.teaches == what]
        said = "steps for the law" if what == "law" else "steps that separate causes"
        ax.plot(at, np.zeros(len(at)), "|", color=color, ms=14, label=said)
    ax.set_ylim(bottom=0)
    frequency_in_octaves(ax)
    label(ax, x="frequency in Hz", y="standard error in %", title="Predicted, to first order")
    legend(ax)
    return figure


def spots_figure(found: PlanResult) -> Figure:
    """What the plan's rig time would leave at each spot; the clamp on the left."""
    figure = Figure(figsize=(WIDTH_IN, 4.0), layout="constrained")
    ax = figure.subplots()
    grid = [s for s in found.spots if not s.stated]
    drawn = ax.scatter(
        [s.x_mm for s in grid],
        [s.y_mm for s in grid],
        c=[s.worst_percent for s in grid],
        s=260,
        cmap="viridis_r",
        norm="log",
    )
    for s in grid:
        ax.annotate(two_digits(s.worst_percent), (s.x_mm, s.y_mm), ha="center", va="center", fontsize=7)
    stated = [s for s in found.spots if s.stated]
    ax.plot([s.x_mm for s in stated], [s.y_mm for s in stated], "x", color=MODEL, ms=12, label="stated spot")
    figure.colorbar(drawn, ax=ax, label="largest standard error in %")
    ax.set_xlim(left=0)
    label(ax, x="x from the clamp in mm", y="y in mm", title="In the plan's rig time")
    legend(ax)
    return figure
