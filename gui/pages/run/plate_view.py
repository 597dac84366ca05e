"""The plate as the forms have it, to scale: clamp, patches, spots. What is dragged goes into a field."""

from dataclasses import dataclass

from PySide6.QtCore import QPointF, QRectF, Qt, Signal
from PySide6.QtGui import QMouseEvent, QPainter, QPaintEvent, QPalette, QPen
from PySide6.QtWidgets import QSizePolicy, QWidget

from fitting.specimen import PlateSpecimen
from gui.form.draft import Draft
from gui.form.drafts import Drafts
from gui.form.fields import Place
from gui.style.theme import Role, Theme, current_theme

_ROOM_PX, _SKETCH_ROOM_PX = 44, 22
_MARK_PX = 7
_NEAR_PX = 14
"""A press so near a mark takes it."""
_ABOVE_PX = 4
_HATCH_PX = 8
_NOTHING = "The specimen of the experiment appears here, drawn to scale: clamp, laser spot, hit, sensor."


@dataclass(frozen=True)
class PlateMark:
    """A point of the plate, in mm from the clamp and from a long edge."""

    name: str
    file: str
    """Which form holds it: `specimen` or `experiment`."""
    x: Place
    y: Place
    at_mm: tuple[float, float]
    role: Role


class PlateView(QWidget):
    """Drawn from the drafts at every change.

    Signals
    -------
    moved : (str, object, str)
        A mark was dragged: the form, the field's place, its new text; once for x, once for y.
    """

    moved = Signal(str, object, str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.size_mm: tuple[float, float] | None = None
        self.marks: tuple[PlateMark, ...] = ()
        self.patches_mm: tuple[tuple[float, float, float, float], ...] | None = None
        """From and to along x, along y; None where all of the plate is treated, or nothing."""
        self._clamped = self._sketched = False
        self._held: int | None = None
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setToolTip("Drag the spot, the hit or the sensor: their fields follow")

    def show_drafts(self, drafts: Drafts | None) -> None:
        """As they are now; nothing where they hold no plate."""
        files = drafts.all if drafts is not None else {}
        specimen, experiment = files.get("specimen"), files.get("experiment")
        self.size_mm, self.marks = None, ()
        if specimen is not None:
            self.size_mm = _pair(specimen, ("plate", "length_mm"), ("plate", "width_mm"))
            self.patches_mm = _patches(specimen)
            self._clamped = specimen.value(("plate", "boundary")) in (None, "cantilever")
            self.marks = (*_spots(specimen), *(_of_hammer(experiment) if experiment is not None else ()))
        self.update()

    def show_place(
        self,
        specimen: PlateSpecimen,
        at_mm: tuple[float, float],
        mark: str,
        read_mm: tuple[float, float] | None = None,
    ) -> None:
        """One point of a plate, beside its own spot or another that is read; nothing can be dragged."""
        self.size_mm = (1e3 * specimen.length_m, 1e3 * specimen.width_m)
        self._clamped = specimen.boundary == "cantilever"
        own = [PlateMark("spot", "", (), (), (1e3 * x, 1e3 * y), "faint") for x, y in specimen.pickups_m]
        read = [] if read_mm is None else [PlateMark("laser", "", (), (), read_mm, "data")]
        self.marks = (*own, *read, PlateMark(mark, "", (), (), at_mm, "fair"))
        self._held, self._sketched = None, True
        self.setEnabled(False)
        self.update()

    def to_screen(self, at_mm: tuple[float, float]) -> QPointF:
        """Where a point of the plate is drawn; x to the right, y up."""
        plate, (length, width) = self._plate(), self._size
        return QPointF(
            plate.left() + at_mm[0] / length * plate.width(),
            plate.bottom() - at_mm[1] / width * plate.height(),
        )

    def from_screen(self, at: QPointF) -> tuple[float, float]:
        """Point of the plate there, kept on it, to half a millimetre."""
        plate, (length, width) = self._plate(), self._size
        x = (at.x() - plate.left()) / plate.width() * length
        y = (plate.bottom() - at.y()) / plate.height() * width
        return _half(min(max(x, 0.0), length)), _half(min(max(y, 0.0), width))

    def paintEvent(self, event: QPaintEvent) -> None:
        """Plate, patches, clamp, marks and the two lengths."""
        painter, theme = QPainter(self), current_theme()
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        if self.size_mm is None:
            painter.setPen(theme.color("faint"))
            painter.drawText(self.rect(), Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap, _NOTHING)
        else:
            self._draw_plate(painter, theme)
            for mark in self.marks:
                self._draw_mark(painter, theme, mark)
        painter.end()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Take hold of the mark nearest to the pointer, if any is near."""
        at = event.position()
        near = [
            (distance, k)
            for k, mark in enumerate(self.marks)
            if (distance := (self.to_screen(mark.at_mm) - at).manhattanLength()) < _NEAR_PX
        ]
        self._held = min(near)[1] if near else None

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Let the mark that is held follow the pointer."""
        if self._held is None or self._held >= len(self.marks):
            return
        mark, (x, y) = self.marks[self._held], self.from_screen(event.position())
        self.moved.emit(mark.file, mark.x, f"{x:.1f}")
        self.moved.emit(mark.file, mark.y, f"{y:.1f}")

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """Leave the mark where it is."""
        self._held = None

    @property
    def _size(self) -> tuple[float, float]:
        return self.size_mm if self.size_mm is not None else (1.0, 1.0)

    def _plate(self) -> QRectF:
        """As large as there is room, to scale."""
        length, width = self._size
        px = _SKETCH_ROOM_PX if self._sketched else _ROOM_PX
        room = QRectF(self.rect()).adjusted(px, px, -px, -px)
        scale = max(min(room.width() / length, room.height() / width), 1e-6)
        plate = QRectF(0.0, 0.0, scale * length, scale * width)
        plate.moveCenter(room.center())
        return plate

    def _draw_plate(self, painter: QPainter, theme: Theme) -> None:
        plate, (length, width) = self._plate(), self._size
        painter.setPen(QPen(theme.color("text"), 1.5))
        painter.setBrush(self.palette().color(QPalette.ColorRole.Base))
        painter.drawRect(plate)
        for x_0, x_1, y_0, y_1 in self.patches_mm or ():
            patch = QRectF(self.to_screen((x_0, y_1)), self.to_screen((x_1, y_0)))
            painter.setBrush(theme.color("data", 0.15))
            painter.setPen(QPen(theme.color("faint"), 1.0))
            painter.drawRect(patch)
        if self._clamped:
            clamp = QRectF(plate.left() - 2 * _HATCH_PX, plate.top(), 2 * _HATCH_PX, plate.height())
            painter.fillRect(clamp, theme.color("grid"))
            painter.fillRect(clamp, Qt.BrushStyle.BDiagPattern)
        if self._sketched:
            return
        painter.setPen(theme.color("faint"))
        below = plate.translated(0, plate.height() + _ABOVE_PX)
        painter.drawText(below, Qt.AlignmentFlag.AlignHCenter, f"{length:g} mm")
        # Upwards: beside the plate there may be no room for its unit.
        painter.save()
        painter.translate(plate.right() + _ABOVE_PX, plate.bottom())
        painter.rotate(-90)
        along = QRectF(0.0, 0.0, plate.height(), painter.fontMetrics().height())
        painter.drawText(along, Qt.AlignmentFlag.AlignCenter, f"{width:g} mm")
        painter.restore()

    def _draw_mark(self, painter: QPainter, theme: Theme, mark: PlateMark) -> None:
        at = self.to_screen(mark.at_mm)
        painter.setPen(QPen(theme.color(mark.role), 2.0))
        painter.setBrush(theme.color(mark.role, 0.3))
        painter.drawEllipse(at, _MARK_PX, _MARK_PX)
        painter.setPen(theme.color("text"))
        words = f"{mark.name} {mark.at_mm[0]:g}, {mark.at_mm[1]:g}"
        painter.drawText(self.words_begin(at, words), words)

    def words_begin(self, at: QPointF, words: str) -> QPointF:
        """Where the words beside a mark begin: right of it and above, or where the plate has room."""
        metrics, plate = self.fontMetrics(), self._plate()
        wide = metrics.horizontalAdvance(words)
        left = at.x() + _NEAR_PX if at.x() + _NEAR_PX + wide <= plate.right() else at.x() - _NEAR_PX - wide
        above = at.y() - _ABOVE_PX
        fits = above - metrics.ascent() > plate.top()
        return QPointF(left, above if fits else at.y() + _ABOVE_PX + metrics.ascent())


def _spots(specimen: Draft) -> tuple[PlateMark, ...]:
    given = specimen.value(("pickup",))
    several = isinstance(given, list)
    stems: list[Place] = [("pickup", k) for k in range(len(given))] if several else [("pickup",)]
    found = []
    for k, stem in enumerate(stems):
        x, y = (*stem, "x_mm"), (*stem, "y_mm")
        at = _pair(specimen, x, y)
        if at is not None:
            found.append(PlateMark(f"spot {k}" if several else "spot", "specimen", x, y, at, "data"))
    return tuple(found)


def _patches(specimen: Draft) -> tuple[tuple[float, float, float, float], ...] | None:
    given = specimen.value(("patch",))
    found = []
    for k in range(len(given) if isinstance(given, list) else 0):
        x, y = (
            _pair(specimen, ("patch", k, f"from_{axis}_mm"), ("patch", k, f"to_{axis}_mm")) for axis in "xy"
        )
        if x is not None and y is not None:
            found.append((*x, *y))
    return tuple(found) or None


def _of_hammer(experiment: Draft) -> tuple[PlateMark, ...]:
    kinds: tuple[tuple[str, str, Role], ...] = (("hit", "hit", "model"), ("sensor", "response", "second"))
    found = []
    for name, key, role in kinds:
        x, y = ("hammer", f"{key}_x_mm"), ("hammer", f"{key}_y_mm")
        at = _pair(experiment, x, y)
        if at is not None:
            found.append(PlateMark(name, "experiment", x, y, at, role))
    return tuple(found)


def _pair(draft: Draft, x: Place, y: Place) -> tuple[float, float] | None:
    values = [draft.value(place) for place in (x, y)]
    if all(isinstance(v, int | float) and not isinstance(v, bool) and 0 <= v < 1e5 for v in values):
        return float(values[0]), float(values[1])
    return None


def _half(mm: float) -> float:
    return round(2.0 * mm) / 2.0
