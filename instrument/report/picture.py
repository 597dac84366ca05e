"""Figures into the page: SVG in a data URI, on a white card, the same bytes for the same session."""

import base64
import io

import matplotlib as mpl
from matplotlib.figure import Figure


def as_svg(figure: Figure) -> str:
    """A figure as a data URI."""
    svg = io.BytesIO()
    with mpl.rc_context({"svg.hashsalt": "viscorig"}):
        figure.savefig(svg, format="svg", metadata={"Date": None}, facecolor="white")
    return "data:image/svg+xml;base64," + base64.b64encode(svg.getvalue()).decode()
