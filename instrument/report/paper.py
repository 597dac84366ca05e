"""Sheets of A4 that are filled from above: text, rules, boxes and figures, where there is still room."""

from collections.abc import Sequence
from functools import lru_cache

import matplotlib as mpl
from matplotlib.backend_bases import RendererBase
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties
from matplotlib.lines import Line2D
from matplotlib.patches import Rectangle
from matplotlib.text import Text
from matplotlib.textpath import text_to_path

WIDTH_MM, HEIGHT_MM = 210.0, 297.0
MARGIN_MM = 18.0
INSIDE_MM = WIDTH_MM - 2 * MARGIN_MM
_FOOT_MM = 16.0
_MM_PT = 25.4 / 72
_MM_IN = 1 / 25.4
LINE = 1.35
"""Of a line, in heights of its type."""
_DENSER = 0.72
"""Type and lines of a figure made for a wide screen."""
_LEGEND = 1.3
"""Room that a legend has, in heights of it: it keeps off the edge above."""
_RULE, _INK, _SOFT = "#bbbbbb", "#000000", "#444444"


class Sheet(Figure):
    """One page; figures laid on it are drawn with it, as they are: in lines and letters."""

    def __init__(self) -> None:
        super().__init__(figsize=(WIDTH_MM * _MM_IN, HEIGHT_MM * _MM_IN))
        self._laid: list[Figure] = []

    def lay(self, figure: Figure, top_mm: float, height_mm: float) -> None:
        """A figure over the whole width, its panels and type arranged anew for it."""
        figure.set_size_inches(*self.get_size_inches())
        figure.patch.set_alpha(0.0)
        _make_denser(figure)
        left, wide = MARGIN_MM / WIDTH_MM, INSIDE_MM / WIDTH_MM
        low, high = 1 - (top_mm + height_mm) / HEIGHT_MM, height_mm / HEIGHT_MM
        above = 0.0
        for legend in figure.legends:
            # One that stands above all panels: above these, not on the edge of the sheet, where the layout
            # would leave room for it.
            legend.set_bbox_to_anchor((left, low, wide, high), transform=figure.transSubfigure)
            above = max(above, _LEGEND * legend.get_window_extent().height / figure.bbox.height)
        figure.set_layout_engine("constrained", rect=(left, low, wide, high - above))
        self._laid.append(figure)

    def draw(self, renderer: RendererBase) -> None:
        """The page and what lies on it."""
        super().draw(renderer)
        for figure in self._laid:
            figure.set_dpi(self.get_dpi())
            figure.draw(renderer)


class Sheets:
    """All pages of a document; `y_mm` is how far down the present one is filled."""

    def __init__(self) -> None:
        self.pages: list[Sheet] = []
        self.y_mm = 0.0
        self.turn()

    def turn(self) -> None:
        """To a new page."""
        self._page = Sheet()
        self.pages.append(self._page)
        self.y_mm = MARGIN_MM

    def need(self, height_mm: float) -> bool:
        """Turn where there is not so much room any more; whether it did."""
        if self.y_mm + height_mm <= HEIGHT_MM - _FOOT_MM or self.y_mm == MARGIN_MM:
            return False
        self.turn()
        return True

    def gap(self, height_mm: float) -> None:
        """Nothing."""
        self.y_mm += height_mm

    def text(
        self,
        x_mm: float,
        text: str,
        size_pt: float,
        *,
        bold: bool = False,
        soft: bool = False,
        right: bool = False,
    ) -> None:
        """One line at this height; `right` ends at x instead of beginning there."""
        self._page.add_artist(
            Text(
                x_mm / WIDTH_MM, 1 - (self.y_mm + size_pt * _MM_PT) / HEIGHT_MM, shown(text),
                fontproperties=_font(size_pt, bold), color=_SOFT if soft else _INK,
                horizontalalignment="right" if right else "left", verticalalignment="baseline",
                transform=self._page.transSubfigure, parse_math=False, figure=self._page,
            )
        )  # fmt: skip

    def rule(self, x_mm: float = MARGIN_MM, width_mm: float = INSIDE_MM, color: str = _RULE) -> None:
        """A thin line across."""
        y = 1 - self.y_mm / HEIGHT_MM
        x = [x_mm / WIDTH_MM, (x_mm + width_mm) / WIDTH_MM]
        self._page.add_artist(
            Line2D(x, [y, y], color=color, linewidth=0.5, transform=self._page.transSubfigure)
        )

    def box(self, x_mm: float, width_mm: float, height_mm: float, color: str, *, filled: bool = True) -> None:
        """From here downwards."""
        corner = x_mm / WIDTH_MM, 1 - (self.y_mm + height_mm) / HEIGHT_MM
        size = width_mm / WIDTH_MM, height_mm / HEIGHT_MM
        look = {"facecolor": color, "edgecolor": "none"} if filled else {"fill": False, "edgecolor": color}
        self._page.add_artist(
            Rectangle(corner, *size, linewidth=0.5, transform=self._page.transSubfigure, zorder=0, **look)
        )

    def figure(self, figure: Figure) -> None:
        """Over the whole width, as high as it was made for it."""
        wide, high = figure.get_size_inches()
        height_mm = INSIDE_MM * float(high / wide)
        self.need(height_mm)
        self._page.lay(figure, self.y_mm, height_mm)
        self.y_mm += height_mm

    def foot(self, title: str) -> None:
        """Title and number under every page, once all are there."""
        self.y_mm = HEIGHT_MM - _FOOT_MM + 6.0
        for number, page in enumerate(self.pages, start=1):
            self._page = page
            said = f"page {number} of {len(self.pages)}"
            (cut, *_) = broken(title, INSIDE_MM - 2 * width_mm(said, 7.0), 7.0)
            self.text(MARGIN_MM, cut, 7.0, soft=True)
            self.text(WIDTH_MM - MARGIN_MM, said, 7.0, soft=True, right=True)


def line_mm(size_pt: float) -> float:
    """Height of a line."""
    return LINE * size_pt * _MM_PT


def shown(text: str) -> str:
    """Without what has no shape on paper."""
    return "".join(c if c.isprintable() else " " for c in text)


@lru_cache(maxsize=20_000)
def width_mm(text: str, size_pt: float, bold: bool = False) -> float:
    """Of a line of type."""
    wide, _, _ = text_to_path.get_text_width_height_descent(shown(text), _font(size_pt, bold), ismath=False)
    return float(wide) * _MM_PT


def broken(text: str, within_mm: float, size_pt: float, bold: bool = False) -> list[str]:
    """Into lines, between words; within a word where it is longer than a line."""
    lines, line = [], ""
    for word in text.split():
        longer = f"{line} {word}" if line else word
        if width_mm(longer, size_pt, bold) <= within_mm:
            line = longer
            continue
        if line:
            lines.append(line)
        while width_mm(word, size_pt, bold) > within_mm and len(word) > 1:
            fits = next(
                (k for k in range(len(word) - 1, 1, -1) if width_mm(word[:k], size_pt, bold) <= within_mm), 1
            )
            lines.append(word[:fits])
            word = word[fits:]
        line = word
    return [*lines, line]


def _make_denser(figure: Figure) -> None:
    for ax in figure.axes:
        ax.tick_params(labelsize=_DENSER * 8, which="both", length=2.5, width=0.5)
        for spine in ax.spines.values():
            spine.set_linewidth(0.5)
        for line in ax.lines:
            line.set_linewidth(_DENSER * line.get_linewidth())
            line.set_markersize(_DENSER * line.get_markersize())
    for text in figure.findobj(Text):
        text.set_fontsize(_DENSER * float(text.get_fontsize()))


@lru_cache(maxsize=64)
def _font(size_pt: float, bold: bool) -> FontProperties:
    family: Sequence[str] = mpl.rcParamsDefault["font.family"]
    return FontProperties(family=family, size=size_pt, weight="bold" if bold else "normal")
