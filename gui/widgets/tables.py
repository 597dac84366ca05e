"""Tables of text and numbers: bars and tints in cells, copied with Ctrl+C."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from PySide6.QtCore import QAbstractTableModel, QEvent, QModelIndex, QPersistentModelIndex, QRectF, QSize, Qt
from PySide6.QtGui import QFont, QGuiApplication, QKeyEvent, QKeySequence, QPainter, QResizeEvent
from PySide6.QtWidgets import (
    QAbstractItemView,
    QHeaderView,
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QTableView,
    QWidget,
)

from gui.style.theme import Role, current_theme

_EDGE_PX = 4
_ROOM_PX = 7
_BAR_ALPHA = 0.35
_Index = QModelIndex | QPersistentModelIndex
_ROOT = QModelIndex()
_Roles = Qt.ItemDataRole


@dataclass(frozen=True)
class Cell:
    """What stands in a cell."""

    text: str
    tip: str = ""
    bold: bool = False
    faint: bool = False
    fill: Role | None = None
    """Colour behind the text, over `share` of the width."""
    share: float = 1.0
    alpha: float = _BAR_ALPHA
    edge: Role | None = None
    """Colour of a stripe at the left."""
    left: bool = False
    """Set to the left; numbers go to the right otherwise."""

    @property
    def alignment(self) -> Qt.AlignmentFlag:
        """Of the text, and of its heading."""
        side = Qt.AlignmentFlag.AlignLeft if self.left else Qt.AlignmentFlag.AlignRight
        return side | Qt.AlignmentFlag.AlignVCenter


Row = Sequence[Cell]
_EMPTY = Cell("")


class ReadTable(QTableView):
    """Rows that are read; one of them can be selected where `selects`.

    Parameters
    ----------
    columns : dict
        Heading to its tool tip.
    wide : sequence of int
        Columns that share what room there is; the last one alone otherwise.
    fills : bool
        False where no column takes more than it needs.
    """

    def __init__(
        self,
        columns: dict[str, str],
        parent: QWidget | None = None,
        *,
        selects: bool = False,
        wide: Sequence[int] = (),
        fills: bool = True,
    ) -> None:
        super().__init__(parent)
        self._rows = _Rows(columns, self)
        self.setModel(self._rows)
        self.setItemDelegate(_Delegate(self))
        modes = QAbstractItemView.SelectionMode
        self.setSelectionMode(modes.SingleSelection if selects else modes.NoSelection)
        self.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.setHorizontalScrollMode(QAbstractItemView.ScrollMode.ScrollPerPixel)
        self.setWordWrap(False)
        self.setShowGrid(False)
        # Tab goes on to what stands beside the table; arrow keys move in it.
        self.setTabKeyNavigation(False)
        self.verticalHeader().hide()
        header = self.horizontalHeader()
        header.setHighlightSections(False)
        header.setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
        header.setStretchLastSection(fills and not wide)
        self._last_fills = fills and not wide
        for column in wide:
            header.setSectionResizeMode(column, QHeaderView.ResizeMode.Stretch)
        self._size_rows()

    def show_rows(self, rows: Sequence[Row], columns: dict[str, str] | None = None) -> None:
        """Instead of those there were, under other headings where they are given. Nothing is selected.

        What a row does not say of a column stays empty.
        """
        self._rows.show(rows, columns)
        self._fit_last()

    @property
    def row_count(self) -> int:
        """How many there are."""
        return self._rows.rowCount()

    @property
    def selected(self) -> int | None:
        """Number of the row selected."""
        rows = self.selectionModel().selectedRows()
        return rows[0].row() if rows else None

    def cell(self, row: int, column: int) -> Cell:
        """A cell as it is shown."""
        return self._rows.rows[row][column]

    def texts(self, column: int) -> list[str]:
        """The texts of one column, row by row."""
        return [row[column].text for row in self._rows.rows]

    @property
    def text(self) -> str:
        """Headings and rows, tabs between: as it is copied."""
        rows = [list(self._rows.columns), *([cell.text for cell in row] for row in self._rows.rows)]
        return "\n".join("\t".join(row) for row in rows)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Ctrl+C takes the whole table."""
        if event.matches(QKeySequence.StandardKey.Copy):
            QGuiApplication.clipboard().setText(self.text)
        else:
            super().keyPressEvent(event)

    def changeEvent(self, event: QEvent) -> None:
        """Rows follow the size of type."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange:
            self._size_rows()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """The last column takes what is left, or what it needs: then there is a scroll bar."""
        super().resizeEvent(event)
        self._fit_last()

    def _fit_last(self) -> None:
        if not self._last_fills:
            return
        header, last = self.horizontalHeader(), self.model().columnCount() - 1
        before = sum(header.sectionSize(k) for k in range(last))
        wanted = max(self.sizeHintForColumn(last), header.sectionSizeHint(last))
        stretched = before + wanted <= self.viewport().width()
        if stretched != header.stretchLastSection():
            header.setStretchLastSection(stretched)

    def _size_rows(self) -> None:
        height = self.fontMetrics().height() + _ROOM_PX
        self.verticalHeader().setMinimumSectionSize(height)
        self.verticalHeader().setDefaultSectionSize(height)


class _Rows(QAbstractTableModel):
    """What a table shows."""

    def __init__(self, columns: dict[str, str], parent: ReadTable) -> None:
        super().__init__(parent)
        self.columns = columns
        self.rows: Sequence[Row] = ()

    def show(self, rows: Sequence[Row], columns: dict[str, str] | None) -> None:
        self.beginResetModel()
        self.columns = columns if columns is not None else self.columns
        # Qt asks for every cell, and an error raised into it takes the program down.
        count = len(self.columns)
        self.rows = [row if len(row) >= count else [*row, *[_EMPTY] * (count - len(row))] for row in rows]
        self.endResetModel()

    def rowCount(self, parent: _Index = _ROOT) -> int:
        return 0 if parent.isValid() else len(self.rows)

    def columnCount(self, parent: _Index = _ROOT) -> int:
        return 0 if parent.isValid() else len(self.columns)

    def data(self, index: _Index, role: int = _Roles.DisplayRole) -> Any:
        cell = self.rows[index.row()][index.column()]
        match role:
            case _Roles.DisplayRole:
                return cell.text
            case _Roles.ToolTipRole:
                return cell.tip or cell.text
            case _Roles.TextAlignmentRole:
                return cell.alignment
            case _Roles.ForegroundRole if cell.faint:
                return current_theme().color("faint")
            case _Roles.FontRole if cell.bold:
                font = QFont()
                font.setBold(True)
                return font
        return None

    def headerData(self, section: int, along: Qt.Orientation, role: int = _Roles.DisplayRole) -> Any:
        if along != Qt.Orientation.Horizontal:
            return None
        match role:
            case _Roles.DisplayRole:
                return list(self.columns)[section]
            case _Roles.ToolTipRole:
                return list(self.columns.values())[section]
            case _Roles.TextAlignmentRole if self.rows:
                return self.rows[0][section].alignment
        return None


class _Delegate(QStyledItemDelegate):
    """Paints bars and stripes in the colours of the moment."""

    def __init__(self, table: ReadTable) -> None:
        super().__init__(table)
        self._table = table

    def sizeHint(self, option: QStyleOptionViewItem, index: _Index) -> QSize:
        """With room for the stripe."""
        size = super().sizeHint(option, index)
        cell = self._table.cell(index.row(), index.column())
        return size if cell.edge is None else size + QSize(_EDGE_PX, 0)

    def paint(self, painter: QPainter, option: QStyleOptionViewItem, index: _Index) -> None:
        """Bar or tint, then the text, then the stripe."""
        cell, theme = self._table.cell(index.row(), index.column()), current_theme()
        area = QRectF(option.rect)
        if cell.edge is not None:
            # The text begins beside the stripe.
            option.rect.setLeft(option.rect.left() + _EDGE_PX)
        if cell.fill is not None:
            bar = area.adjusted(1, 1, -1, -1)
            bar.setWidth(bar.width() * min(max(cell.share, 0.0), 1.0))
            painter.fillRect(bar, theme.color(cell.fill, cell.alpha))
        super().paint(painter, option, index)
        if cell.edge is not None:
            painter.fillRect(QRectF(area.left(), area.top(), _EDGE_PX, area.height()), theme.color(cell.edge))
