"""What is cut or lies upon something else in a window, found by walking its widgets as they are seen."""

import re
from collections.abc import Iterator
from itertools import combinations

from PySide6.QtCore import QRect, QSize, Qt
from PySide6.QtGui import QAbstractTextDocumentLayout, QTextDocument
from PySide6.QtWidgets import (
    QAbstractButton,
    QAbstractScrollArea,
    QComboBox,
    QHeaderView,
    QLabel,
    QLineEdit,
    QSizeGrip,
    QSplitterHandle,
    QStyle,
    QStyleOptionComboBox,
    QStyleOptionFrame,
    QTabBar,
    QTableView,
    QTabWidget,
    QWidget,
)

from gui.frame.notice import Notice
from gui.frame.window import Window
from gui.plots import Plot

_SLACK_PX = 1
_TAG = re.compile(r"<[a-z]|&\w+;")
_TITLE_MARGIN_PX = 5
"""That a plot's title has around it."""
_FIELD_MARGIN_PX = 4
"""That a field keeps between its edge and its text, both sides together."""
_HOLDERS = (QTabWidget, QAbstractScrollArea, QComboBox)
"""Arrange their own inner widgets, some of them above others."""


def places(window: Window) -> Iterator[str]:
    """Every page, and every tab in it, shown one after the other under a name of its own."""
    for page in window.pages:
        window.show_page(page.objectName())
        yield page.objectName()
        named: set[str] = set()
        for tabs in page.findChildren(QTabWidget):
            first = tabs.currentIndex()
            for k in range(tabs.count()):
                if k != first and tabs.isVisible() and tabs.isTabVisible(k):
                    tabs.setCurrentIndex(k)
                    name = word(tabs.tabText(k))
                    # A page may have two tabs of one name: a form, and what is drawn of it.
                    name = f"{name}-{k + 1}" if name in named else name
                    named.add(name)
                    yield f"{page.objectName()}-{name}"
            tabs.setCurrentIndex(first)


def word(text: str) -> str:
    """As part of a file's name."""
    return re.sub(r"\W+", "-", text.lower()).strip("-")


def layout_faults(window: QWidget) -> list[str]:
    """One line for each text that has not room enough, and for each pair of neighbours that overlap."""
    seen = [w for w in (window, *window.findChildren(QWidget)) if w.isVisible()]
    return [
        fault for widget in seen for fault in (*_cut(widget), *_beyond(window, widget), *_overlaps(widget))
    ]


def _beyond(window: QWidget, widget: QWidget) -> list[str]:
    """What ends outside its window, unless it can be scrolled to."""
    if not isinstance(widget, (QLabel, QAbstractButton, QLineEdit)) or _scrolls(widget, window):
        return []
    right = widget.mapTo(window, widget.rect().bottomRight())
    if right.x() < window.width() + _SLACK_PX and right.y() < window.height() + _SLACK_PX:
        return []
    return [f"{_place(widget)}: ends at {right.x()}, {right.y()} of {window.width()}, {window.height()} px"]


def _scrolls(widget: QWidget, window: QWidget) -> bool:
    above = widget.parentWidget()
    while above is not None and above is not window:
        if isinstance(above, QAbstractScrollArea):
            return True
        above = above.parentWidget()
    return False


def _cut(widget: QWidget) -> list[str]:
    match widget:
        case Plot():
            return _plot(widget)
        case QLabel():
            return _label(widget)
        case QTabBar():
            return _narrow(widget, "tabs", widget.sizeHint().width())
        case QComboBox():
            return _combo(widget)
        case QAbstractButton():
            return _narrow(widget, widget.text(), widget.minimumSizeHint().width()) if widget.text() else []
        case QLineEdit():
            return _field(widget)
        case QTableView():
            return _table(widget)
    return []


def _narrow(widget: QWidget, text: str, wanted: int) -> list[str]:
    if wanted <= widget.width() + _SLACK_PX:
        return []
    return [f"{_place(widget)}: {text!r} has {widget.width()} px and wants {wanted}"]


def _label(label: QLabel) -> list[str]:
    if not label.text() or label.pixmap().width():
        return []
    room = QSize(
        label.contentsRect().width() - 2 * label.margin(), label.contentsRect().height() - 2 * label.margin()
    )
    document = QTextDocument()
    document.setDocumentMargin(0)
    document.setDefaultFont(label.font())
    rich = label.textFormat() == Qt.TextFormat.RichText or (
        label.textFormat() == Qt.TextFormat.AutoText and bool(_TAG.search(label.text()))
    )
    document.setHtml(label.text()) if rich else document.setPlainText(label.text().replace("&", ""))
    if label.wordWrap():
        document.setTextWidth(room.width())
    layout: QAbstractTextDocumentLayout = document.documentLayout()
    wanted = layout.documentSize()
    width = wanted.width() if label.wordWrap() else document.idealWidth()
    if width <= room.width() + _SLACK_PX and wanted.height() <= room.height() + 2 * _SLACK_PX:
        return []
    return [
        f"{_place(label)}: {document.toPlainText()!r} has {room.width()} x {room.height()} px "
        f"and wants {width:.0f} x {wanted.height():.0f}"
    ]


def _combo(box: QComboBox) -> list[str]:
    option = QStyleOptionComboBox()
    box.initStyleOption(option)
    room = box.style().subControlRect(
        QStyle.ComplexControl.CC_ComboBox, option, QStyle.SubControl.SC_ComboBoxEditField, box
    )
    wanted = box.fontMetrics().horizontalAdvance(box.currentText())
    return (
        [f"{_place(box)}: {box.currentText()!r} has {room.width()} px and wants {wanted}"]
        if wanted > room.width() + _SLACK_PX
        else []
    )


def _field(field: QLineEdit) -> list[str]:
    option = QStyleOptionFrame()
    field.initStyleOption(option)
    room = field.style().subElementRect(QStyle.SubElement.SE_LineEditContents, option, field)
    text = field.displayText() or field.placeholderText()
    wanted = field.fontMetrics().horizontalAdvance(text) + _FIELD_MARGIN_PX
    if wanted <= room.width() + _SLACK_PX:
        return []
    return [f"{_place(field)}: {text!r} has {room.width()} px and wants {wanted}"]


def _table(table: QTableView) -> list[str]:
    """Columns beyond the edge may be scrolled to; no cell may be shortened."""
    model, header, found = table.model(), table.horizontalHeader(), []
    for column in range(model.columnCount()):
        wide = header.sectionSize(column)
        name = model.headerData(column, Qt.Orientation.Horizontal)
        if header.isVisible() and table.fontMetrics().horizontalAdvance(str(name)) > wide + _SLACK_PX:
            found.append(f"{_place(table)}: heading {name!r} has {wide} px")
        for row in range(model.rowCount()):
            index = model.index(row, column)
            if table.wordWrap() and (high := _wrapped_px(table, index.data(), wide)):
                if high > table.rowHeight(row) + _SLACK_PX:
                    found.append(f"{_place(table)}: cell {index.data()!r} wants a row of {high} px")
                continue
            wanted = table.sizeHintForIndex(index).width()
            if wanted > wide + _SLACK_PX:
                found.append(f"{_place(table)}: cell {index.data()!r} has {wide} px and wants {wanted}")
    whole = header.length()
    scrolls = table.horizontalScrollBar().maximum() > 0
    if whole > table.viewport().width() + _SLACK_PX and not scrolls:
        found.append(f"{_place(table)}: columns end beyond its edge")
    return found


def _wrapped_px(table: QTableView, text: str, wide: int) -> int:
    """How high a cell's words are broken into lines; 0 where one of them is too long for that."""
    inside = QRect(0, 0, wide - 2 * _SLACK_PX, 10_000)
    metrics = table.fontMetrics()
    if max(map(metrics.horizontalAdvance, str(text).split()), default=0) > inside.width():
        return 0
    return metrics.boundingRect(inside, Qt.TextFlag.TextWordWrap, str(text)).height()


def _plot(plot: Plot) -> list[str]:
    found = []
    for side in ("bottom", "left"):
        axis = plot.getAxis(side)
        if axis.label.isVisible():
            wanted = plot.fontMetrics().horizontalAdvance(axis.label.toPlainText().strip())
            has = axis.boundingRect().width() if side == "bottom" else axis.boundingRect().height()
            label = axis.label.sceneBoundingRect()
            low, high = (label.left(), label.right()) if side == "bottom" else (label.top(), label.bottom())
            edge = plot.width() if side == "bottom" else plot.height()
            if wanted > has + _SLACK_PX or low < -_TITLE_MARGIN_PX or high > edge + _TITLE_MARGIN_PX:
                found.append(
                    f"{_place(plot)}: axis {axis.label.toPlainText()!r} has {has:.0f} and wants {wanted:.0f}"
                )
    return found


def _overlaps(parent: QWidget) -> list[str]:
    if isinstance(parent, (*_HOLDERS, QHeaderView)):
        return []
    children = [
        c
        for c in parent.children()
        if isinstance(c, QWidget)
        and c.isVisible()
        and not c.isWindow()
        and not isinstance(c, (QSplitterHandle, QSizeGrip, Notice))
    ]
    found = []
    for one, other in combinations(children, 2):
        both = one.geometry().intersected(other.geometry())
        if min(both.width(), both.height()) > _SLACK_PX:
            found.append(f"{_place(one)} lies upon {_place(other)} by {both.width()} x {both.height()} px")
    return found


def _place(widget: QWidget) -> str:
    names = []
    at: QWidget | None = widget
    while at is not None and len(names) < 3:
        names.append(at.objectName() or type(at).__name__)
        at = at.parentWidget()
    return " in ".join(names)
