"""Figures all drawn alike: panels, labels with units, legends."""

from collections.abc import Sequence
from typing import Any, TypeVar

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, NullLocator
from numpy.typing import NDArray

from fitting.arrays import Array
from instrument.results.set_aside import NAME

T = TypeVar("T")

DATA, MODEL, MARK, SECOND = "#0b63a5", "#c2571a", "#5b8c2a", "#7a4fa3"
WIDTH_IN = 11.0
_SET_ASIDE: dict[str, Any] = {"marker": "v", "color": "#b3261e", "mfc": "none", "ms": 6, "ls": "none"}
_FOOT = 0.04
"""Of an axis's height: where what has no place on its scale is marked."""
_COLUMNS_AT_MOST = 4
TWO_STD = 2.0
"""Standard deviations of a reading either side: what is usually drawn as its noise."""


def in_rows(items: Sequence[T]) -> list[Sequence[T]]:
    """Shared out evenly over figures of few enough panels to be read."""
    figures = -(-len(items) // _COLUMNS_AT_MOST)
    width = -(-len(items) // max(1, figures))
    return [items[k : k + width] for k in range(0, len(items), width)] if items else []


def panels(rows: int, columns: int, height_in: float) -> tuple[Figure, list[list[Axes]]]:
    """A figure of panels, rows of axes that share the x axis by column."""
    figure = Figure(figsize=(WIDTH_IN, height_in), layout="constrained")
    return figure, figure.subplots(rows, columns, squeeze=False, sharex="col").tolist()


def label(ax: Axes, *, x: str = "", y: str = "", title: str = "") -> None:
    """Names and units on the axes, and a grid that stays behind."""
    if title:
        ax.set_title(title, fontsize=10)
    if x:
        ax.set_xlabel(x, fontsize=9)
    if y:
        ax.set_ylabel(y, fontsize=9)
    ax.tick_params(labelsize=8, which="both")
    ax.grid(visible=True, alpha=0.3)
    ax.set_axisbelow(True)


def from_zero(ax: Axes, values: NDArray[Any]) -> None:
    """The y axis from zero, with room above the highest of some values, of any shape."""
    highest = float(np.nanmax(values, initial=0.0))
    if highest > 0:
        ax.set_ylim(0, 1.08 * highest)


def frequency_in_octaves(ax: Axes) -> None:
    """A logarithmic x axis in plain numbers, as bands are wide in octaves."""
    ax.set_xscale("log")
    ax.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    ax.xaxis.set_minor_locator(NullLocator())
    ax.xaxis.set_major_formatter(FuncFormatter(lambda f, _: f"{f:g}"))


def mark_set_aside(ax: Axes, x: Array, y: Array | None = None) -> None:
    """Readings that take no part; at the foot of the axis without `y`. Shape (readings,)."""
    if not len(x):
        return
    if y is None:
        at_foot = np.full(len(x), _FOOT)
        ax.plot(x, at_foot, label=NAME, transform=ax.get_xaxis_transform(), **_SET_ASIDE)
    else:
        ax.plot(x, y, label=NAME, **_SET_ASIDE)


def legend(ax: Axes) -> None:
    """Where there is something to tell apart."""
    if ax.get_legend_handles_labels()[0]:
        ax.legend(fontsize=8, frameon=False)


def legend_above(figure: Figure, *axes: Axes) -> None:
    """One for all panels, off the data: what any of some axes has, each name once."""
    of_name = {name: h for ax in axes for h, name in zip(*ax.get_legend_handles_labels(), strict=True)}
    names = list(of_name)
    figure.legend(
        of_name.values(), names, loc="outside upper center", ncols=len(names), fontsize=8, frameon=False
    )
