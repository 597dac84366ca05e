"""Figures into the page: SVG in a data URI, on a white card, the same bytes for the same session."""

import base64
import io

import matplotlib as mpl
from matplotlib.figure import Figure

from instrument.report.blocks import Picture


def picture(figure: Figure, title: str) -> Picture:
    """A figure as it stands in the page."""
    svg = io.BytesIO()
    with mpl.rc_context({"svg.hashsalt": "viscorig"}):
        figure.savefig(svg, format="svg", metadata={"Date": None}, facecolor="white")
    return Picture("data:image/svg+xml;base64," + base64.b64encode(svg.getvalue()).decode(), title)
