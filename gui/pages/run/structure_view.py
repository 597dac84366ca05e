"""A structure to scale, as it is stated: its clamp, its drive, where it is read. Nothing is dragged."""

from collections.abc import Sequence

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QSizePolicy, QStackedWidget, QWidget

from fitting.errors import FittingError
from fitting.specimen import PlateSpecimen
from fitting.structures import AnySpecimen
from gui.form.draft import Draft
from gui.form.drafts import Drafts
from gui.pages.run.plate_view import PlateView
from gui.style.theme import Role, Theme, current_theme
from instrument.errors import BadInput
from instrument.files.structure_file import AnyDocument, described
from instrument.results.sketch import Arrow, Box, Kind, Mark, MarkKind, View, sketch_of

_ROOM_PX, _TITLE_PX, _MARK_PX, _HEAD_PX, _EDGE_PX = 26, 24, 6, 5, 8
_WRAPPED = Qt.TextFlag.TextWordWrap
_NOTHING = "The specimen appears here, drawn to scale, once its file says what it is."
_FILLS: dict[Kind, tuple[Role, float]] = {
    "face": ("faint", 0.35),
    "core": ("data", 0.45),
    "bare": ("base", 1.0),
    "treated": ("data", 0.15),
    "held": ("grid", 1.0),
    "support": ("grid", 0.5),
    "mass": ("faint", 0.2),
}
_ROLES: dict[MarkKind, Role] = {
    "spot": "data",
    "force": "model",
    "mass": "second",
    "hit": "model",
    "sensor": "third",
}


class StructureView(QWidget):
    """Its views, one below the other, each to its own scale."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.views: tuple[View, ...] = ()
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)

    def show_specimen(self, specimen: AnySpecimen | None) -> None:
        """Draw it; None for none."""
        self.show_views(sketch_of(specimen) if specimen is not None else ())

    def show_views(self, views: Sequence[View]) -> None:
        """Draw these."""
        self.views = tuple(views)
        self.setToolTip("\n".join(view.title for view in self.views))
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Every view."""
        painter, theme = QPainter(self), current_theme()
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        if not self.views:
            painter.setPen(theme.color("faint"))
            painter.drawText(self.rect(), Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap, _NOTHING)
        for view, room in zip(self.views, self.rooms(), strict=True):
            _Painted(painter, theme, view, room).draw()
        painter.end()

    def rooms(self) -> Sequence[QRectF]:
        """The rectangle that each view has."""
        height = self.height() / max(len(self.views), 1)
        return [QRectF(0, k * height, self.width(), height) for k in range(len(self.views))]


class _Painted:
    """One view in its room."""

    def __init__(self, painter: QPainter, theme: Theme, view: View, room: QRectF) -> None:
        self._painter, self._theme, self._view = painter, theme, view
        self._x0, self._y0, x1, y1 = view.bounds
        # A title of several lines is whole: what is drawn makes room for it.
        wanted = QRectF(_EDGE_PX, room.top() + _EDGE_PX, room.width() - 2 * _EDGE_PX, room.height())
        self._title = painter.boundingRect(wanted, _WRAPPED, view.title)
        above = max(_ROOM_PX + _TITLE_PX, int(self._title.height()) + 3 * _EDGE_PX)
        inside = room.adjusted(_ROOM_PX, above, -2 * _ROOM_PX, -_ROOM_PX)
        width, height = x1 - self._x0, y1 - self._y0
        self._scale = max(min(inside.width() / width, inside.height() / height), 1e-6)
        self._left = inside.center().x() - self._scale * width / 2
        self._bottom = inside.center().y() + self._scale * height / 2

    def draw(self) -> None:
        """Title, boxes, arrows, marks."""
        self._painter.setPen(self._theme.color("text"))
        self._painter.drawText(self._title, _WRAPPED, self._view.title)
        for box in self._view.boxes:
            self._box(box)
        for arrow in self._view.arrows:
            self._arrow(arrow)
        for mark in self._view.marks:
            self._mark(mark)

    def _at(self, x: float, y: float) -> QPointF:
        return QPointF(self._left + self._scale * (x - self._x0), self._bottom - self._scale * (y - self._y0))

    def _box(self, box: Box) -> None:
        role, alpha = _FILLS[box.kind]
        area = QRectF(self._at(box.x, box.y + box.height), self._at(box.x + box.width, box.y))
        self._painter.setPen(QPen(self._theme.color("text"), 1.0))
        self._painter.setBrush(self._theme.color(role, alpha))
        self._painter.drawRect(area)
        if box.kind == "held":
            self._painter.fillRect(area, Qt.BrushStyle.BDiagPattern)

    def _arrow(self, arrow: Arrow) -> None:
        a, b = self._at(arrow.x, arrow.y), self._at(arrow.x + arrow.dx, arrow.y + arrow.dy)
        self._painter.setPen(QPen(self._theme.color("model"), 1.5))
        self._painter.drawLine(a, b)
        for end, side in ((a, -1), (b, 1)):
            for wing in (-_HEAD_PX, _HEAD_PX):
                self._painter.drawLine(end, end + QPointF(wing, side * _HEAD_PX))
        self._painter.drawText(a + QPointF(_HEAD_PX + 4, 0), arrow.name)

    def _mark(self, mark: Mark) -> None:
        at, role = self._at(mark.x, mark.y), _ROLES[mark.kind]
        self._painter.setPen(QPen(self._theme.color(role), 2.0))
        self._painter.setBrush(self._theme.color(role, 0.3))
        self._painter.drawEllipse(at, _MARK_PX, _MARK_PX)
        self._painter.setPen(self._theme.color("text"))
        self._painter.drawText(at + QPointF(_MARK_PX + 4, -_MARK_PX), mark.name)


class Drawing(QStackedWidget):
    """The specimen of the files as they are now, a plate's marks to be dragged; or a session's, as it was."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.plate, self.structure = PlateView(), StructureView()
        self.addWidget(self.plate)
        self.addWidget(self.structure)

    def show_drafts(self, drafts: Drafts | None) -> None:
        """Of an experiment's files; nothing where there are none."""
        specimen = drafts.specimen if drafts is not None else None
        described_now = _described(specimen) if specimen is not None else None
        if described_now is None or isinstance(described_now, PlateSpecimen):
            # A plate is drawn while its file is being written, whole or not.
            self.plate.show_drafts(drafts)
            self.setCurrentWidget(self.plate)
        else:
            self.show_specimen(described_now)

    def show_specimen(self, specimen: AnySpecimen | None) -> None:
        """Draw the specimen of a session."""
        self.structure.show_specimen(specimen)
        self.setCurrentWidget(self.structure)


def _described(draft: Draft) -> AnySpecimen | None:
    """None where the file does not say yet what it is."""
    if draft.faults():
        return None
    try:
        document = draft.model.model_validate(draft.plain())
        return described(document) if isinstance(document, AnyDocument) else None
    except (FittingError, BadInput, ValueError):
        return None
