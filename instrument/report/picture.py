"""Figures into the page: SVG in a data URI, on a white card, the same bytes for the same session."""

import base64
import io

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.figure import Figure

_MOST_NAMED = 6
"""Of the names in a legend: a list that is read aloud is short."""


def in_words(figure: Figure) -> str:
    """What a figure shows, for who does not see it: every panel's axes, how far they go, what is drawn.

    Panels that look alike are said once.
    """
    panels = dict.fromkeys(filter(None, (_panel(ax) for ax in figure.axes)))
    drawn = dict.fromkeys(name for ax in figure.axes for name in _names(ax))
    drawn |= dict.fromkeys(text.get_text() for legend in figure.legends for text in legend.get_texts())
    names = list(drawn)
    more = f" and {len(names) - _MOST_NAMED} more" if len(names) > _MOST_NAMED else ""
    said = f"{'Drawn' if panels else 'A drawing with'}: {', '.join(names[:_MOST_NAMED])}{more}"
    return ". ".join((*panels, said) if names else panels) or "A drawing"


def _panel(ax: Axes) -> str:
    if not ax.axison or not ax.get_visible():
        return ""
    x, y = _axis(ax.get_xlabel(), ax.get_xlim()), _axis(ax.get_ylabel(), ax.get_ylim())
    return ": ".join(filter(None, (ax.get_title(), " over ".join(filter(None, (y, x))))))


def _axis(name: str, limits: tuple[float, float]) -> str:
    return f"{name} from {limits[0]:.3g} to {limits[1]:.3g}" if name else ""


def _names(ax: Axes) -> list[str]:
    """As the legend has them, of a drawing as they are written; matplotlib's own begin with an underscore."""
    written = [] if ax.axison else [" ".join(text.get_text().split()) for text in ax.texts]
    return [n for n in (*ax.get_legend_handles_labels()[1], *written) if n and not n.startswith("_")]


def as_svg(figure: Figure) -> str:
    """A figure as a data URI."""
    svg = io.BytesIO()
    with mpl.rc_context({"svg.hashsalt": "viscorig"}):
        figure.savefig(svg, format="svg", metadata={"Date": None}, facecolor="white")
    return "data:image/svg+xml;base64," + base64.b64encode(svg.getvalue()).decode()
