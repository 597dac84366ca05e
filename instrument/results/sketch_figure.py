"""A sketch of a structure as a figure for the report."""

from collections.abc import Sequence
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from instrument.results.drawing import DATA, MARK, MODEL, SECOND, WIDTH_IN
from instrument.results.sketch import Kind, MarkKind, View

_FILL: dict[Kind, tuple[str, str]] = {
    "face": ("#c9ced6", ""),
    "core": ("#7fb2da", ""),
    "bare": ("#f4f5f7", ""),
    "treated": ("#d5e5f2", ""),
    "held": ("#ffffff", "////"),
    "support": ("#ffffff", "...."),
    "mass": ("#dcdcdc", ""),
}
_MARKS: dict[MarkKind, tuple[str, str]] = {
    "spot": ("o", DATA),
    "force": ("v", MODEL),
    "mass": ("s", SECOND),
    "hit": ("v", MODEL),
    "sensor": ("D", MARK),
}
_EDGE = "#444444"
_ROOM = 0.08
_HEIGHT_IN = (1.3, 3.4)


def sketch_figure(views: Sequence[View]) -> Figure:
    """One below the other, each to its own scale."""
    heights = [_height_in(view) for view in views]
    figure = Figure(figsize=(0.75 * WIDTH_IN, sum(heights)), layout="constrained")
    rows = figure.subplots(len(views), 1, squeeze=False, gridspec_kw={"height_ratios": heights})
    for ax, view in zip(rows[:, 0], views, strict=True):
        _draw(ax, view)
    return figure


def _height_in(view: View) -> float:
    x0, y0, x1, y1 = view.bounds
    low, high = _HEIGHT_IN
    return min(max(0.6 * WIDTH_IN * (y1 - y0) / (x1 - x0) + 0.6, low), high)


def _draw(ax: Axes, view: View) -> None:
    x0, y0, x1, y1 = view.bounds
    for box in view.boxes:
        colour, hatch = _FILL[box.kind]
        at = (box.x, box.y)
        patch = Rectangle(at, box.width, box.height, facecolor=colour, edgecolor=_EDGE, hatch=hatch)
        patch.set_linewidth(0.6)
        ax.add_patch(patch)
    for arrow in view.arrows:
        end = (arrow.x + arrow.dx, arrow.y + arrow.dy)
        pointed = {"arrowstyle": "<->", "color": MODEL}
        ax.annotate("", xy=end, xytext=(arrow.x, arrow.y), arrowprops=pointed)
        ax.annotate(f" {arrow.name}", (arrow.x, arrow.y), fontsize=8, color=MODEL)
    for mark in view.marks:
        symbol, colour = _MARKS[mark.kind]
        ax.plot(mark.x, mark.y, symbol, color=colour, markersize=5)
        # A name that began right of a mark in the right half would run over the edge, or off the page.
        right = mark.x > (x0 + x1) / 2
        ax.annotate(
            mark.name if view.size_mm is None else f"{mark.name} {mark.x:g}, {mark.y:g}",
            (mark.x, mark.y),
            xytext=(-5 if right else 5, 4),
            textcoords="offset points",
            ha="right" if right else "left",
            fontsize=8,
        )
    if view.size_mm is not None:
        length, width = view.size_mm
        beside: dict[str, Any] = {
            "textcoords": "offset points",
            "fontsize": 8,
            "ha": "center",
            "va": "center",
        }
        ax.annotate(f"{length:g} mm", (length / 2, y0), xytext=(0, -8), **beside)
        ax.annotate(f"{width:g} mm", (x1, width / 2), xytext=(8, 0), rotation=90, **beside)
    room = _ROOM * max(x1 - x0, y1 - y0)
    ax.set_xlim(x0 - room, x1 + room)
    ax.set_ylim(y0 - room, y1 + room)
    ax.set_aspect("equal")
    ax.axis("off")
    ax.set_title(view.title, fontsize=9)
