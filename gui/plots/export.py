"""A plot as a picture or as numbers, from its menu."""

import csv
import re
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QObject, QRectF, QSize
from PySide6.QtGui import QAction, QImage, QPainter
from PySide6.QtSvg import QSvgGenerator
from PySide6.QtWidgets import QMenu

from gui.widgets.asking import ask_save, tell
from instrument.errors import system_words

_PNG_SCALE = 2.0
"""Pixels a point: sharp on paper and on a 4K screen."""
_KINDS = {"PNG": "Picture (*.png)", "SVG": "Drawing (*.svg)", "data CSV": "Data (*.csv)"}


def save_png(plot: Any, path: Path) -> None:
    """As it is seen, in twice the pixels. Raises `OSError`."""
    image = QImage(plot.size() * _PNG_SCALE, QImage.Format.Format_RGB32)
    image.fill(plot.backgroundBrush().color())
    painter = QPainter(image)
    plot.render(painter, QRectF(image.rect()), plot.viewport().rect())
    painter.end()
    if not image.save(str(path)):
        raise OSError(0, "cannot be written", str(path))


def save_svg(plot: Any, path: Path) -> None:
    """As it is seen, in lines and letters. Raises `OSError`."""
    path.touch()
    drawing = QSvgGenerator()
    drawing.setFileName(str(path))
    drawing.setSize(QSize(plot.width(), plot.height()))
    drawing.setViewBox(plot.rect())
    painter = QPainter(drawing)
    painter.fillRect(plot.rect(), plot.backgroundBrush())
    with _as_shapes(plot):
        plot.render(painter, QRectF(plot.rect()), plot.viewport().rect())
    painter.end()


@contextmanager
def _as_shapes(plot: Any) -> Iterator[None]:
    """Symbols are drawn as shapes; on the screen they are small pictures, which is quicker."""
    items = [item for item in plot.scene().items() if hasattr(item, "setExportMode")]
    for item in items:
        item.setExportMode(True)
    try:
        yield
    finally:
        for item in items:
            item.setExportMode(False)


def save_csv(plot: Any, path: Path) -> None:
    """Every number shown; columns of different length end in empty cells. Raises `OSError`."""
    columns: dict[str, NDArray[np.float64]] = plot.columns()
    longest = max((len(values) for values in columns.values()), default=0)
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(columns)
        for k in range(longest):
            writer.writerow([repr(float(v[k])) if k < len(v) else "" for v in columns.values()])


_SAVERS = {"PNG": save_png, "SVG": save_svg, "data CSV": save_csv}


def add_export_menu(plot: Any) -> None:
    """Into the plot's own menu, in place of the library's dialog."""
    plot.scene().contextMenu = []
    plot.getPlotItem().setMenuEnabled(False, enableViewBoxMenu=None)
    exporter = _Exporter(plot)

    def fill(menu: QMenu) -> None:
        for kind in _SAVERS:
            action = QAction(f"Export {kind}...", menu)
            action.setData(kind)
            action.triggered.connect(exporter.ask)
            menu.addAction(action)

    plot.getViewBox().fills.append(fill)


class _Exporter(QObject):
    def __init__(self, plot: Any) -> None:
        super().__init__(plot)
        self._plot = plot

    def ask(self) -> None:
        """Where to, then save."""
        action = self.sender()
        kind = action.data() if isinstance(action, QAction) else "PNG"
        name = f"{_word(self._plot.y.label)}.{_ending(kind)}"
        ask_save(self._plot, f"Export {kind}", name, _KINDS[kind], partial(self._save, kind))

    def _save(self, kind: str, path: Path) -> None:
        if not path.suffix:
            path = path.with_suffix("." + _ending(kind))
        try:
            _SAVERS[kind](self._plot, path)
        except OSError as error:
            tell(self._plot, "Export", f"{path}: {system_words(error)}")


def _ending(kind: str) -> str:
    """Of a file's name."""
    return kind.split()[-1].lower()


def _word(text: str) -> str:
    """What a plot shows, as a name for its file."""
    return re.sub(r"[^a-z0-9]+", "-", text.lower()).strip("-") or "plot"
