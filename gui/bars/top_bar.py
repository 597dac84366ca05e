"""Always seen: how the run stands, what comes next, how near the limits are; and the stop button."""

from PySide6.QtCore import QEvent, Qt
from PySide6.QtGui import QColor, QFontMetrics, QPainter, QPaintEvent, QResizeEvent
from PySide6.QtWidgets import (
    QFrame,
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QProgressBar,
    QSizePolicy,
    QVBoxLayout,
    QWidget,
)

from gui.actions.controller import AppController
from gui.bars.channels import ClipLights
from gui.bars.run_gauges import RunGauges, run_color, state_color
from gui.bars.stop_button import StopButton
from gui.state import SessionState
from gui.state.run import WORDS
from gui.style.theme import current_theme
from gui.widgets.basic import button
from instrument.files.acceleration import acceleration_unit
from instrument.results.typeset import typeset

_PERMILLE = 1000
_EDGE_PX = 2
_RECORDED = "RECORDED"
_GO_ON = "; Run says how to go on"


class TopBar(QFrame):
    """Reads the session state, acts on the controller."""

    def __init__(self, controller: AppController, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._controller, self._recorded = controller, False
        self._words = ""
        self.state, self.next, self.left = QLabel(), QLabel(), QLabel()
        self.next.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        self.next.setTextFormat(Qt.TextFormat.PlainText)
        self.progress = QProgressBar()
        self.progress.setTextVisible(False)
        self.progress.setFixedWidth(160)
        self.level = QLabel()
        self.gauges, self.lights = RunGauges(controller, self), ClipLights()
        self.hold = button("Hold", "Silence the shaker and wait (F9)", "pause")
        self.abort = button("Abort", "End the run in order; what is complete is kept", "abort")
        self.stop = StopButton()
        self.hold.clicked.connect(controller.commands.hold)
        self.abort.clicked.connect(controller.commands.abort)
        self.stop.clicked.connect(controller.commands.stop)
        self._arrange()
        self._size()
        self.show_state(None)

    def changeEvent(self, event: QEvent) -> None:
        """Room for words follows the size of type."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange and hasattr(self, "gauges"):
            self._size()

    def show_state(self, state: SessionState | None) -> None:
        """How things stand now."""
        running = self._controller.running
        for one in (self.hold, self.abort):
            one.setEnabled(running)
        self.stop.setEnabled(running or self._controller.starting)
        if state is None:
            self._say(state_color("idle"), WORDS["idle"], "no session")
            self.left.clear()
            self.progress.hide()
            self._show_gauges(None)
            return
        run = state.run
        self.hold.setText("Resume" if run.state == "held" else "Hold")
        more = _GO_ON if run.state == "stopped" and self._controller.recorded is not None else ""
        self._say(run_color(run), run.word, run.next_words + more)
        self._show_progress(state)
        self._show_gauges(state)

    def paintEvent(self, event: QPaintEvent) -> None:
        """A recorded session stands on other ground, with an edge all around."""
        super().paintEvent(event)
        if self._recorded:
            painter, theme = QPainter(self), current_theme()
            painter.fillRect(self.rect(), QColor(theme.note))
            painter.fillRect(0, self.height() - _EDGE_PX, self.width(), _EDGE_PX, theme.color("fair"))
            painter.end()

    def _look(self, recorded: bool) -> None:
        if recorded != self._recorded:
            self._recorded = recorded
            self.update()

    def _size(self) -> None:
        """Words that change must not move what stands beside them."""
        bold = self.font()
        bold.setBold(True)
        longest_state = max(WORDS.values(), key=QFontMetrics(bold).horizontalAdvance)
        self.state.setFixedWidth(QFontMetrics(bold).horizontalAdvance(f"{_RECORDED} {longest_state} "))
        for label, longest in (
            (self.left, "59:59 min left"),
            (self.level, "level 0.123 m/s\u00b2"),
        ):
            label.setFixedWidth(self.fontMetrics().horizontalAdvance(longest) * 6 // 5)

    def _say(self, color: str, word: str, words: str) -> None:
        recorded = self._controller.recorded is not None
        sign = _RECORDED if recorded else "\u25cf"
        self.state.setText(f"<b style='color:{color}'>{sign} {word}</b>")
        self._look(recorded)
        self._words = typeset(words)
        self.next.setToolTip(self._words)
        self._show_next()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """More words, or fewer."""
        super().resizeEvent(event)
        self._show_next()

    def _show_next(self) -> None:
        """As much as there is room for; all of it stands on Run."""
        room = self.next.width()
        self.next.setText(self.fontMetrics().elidedText(self._words, Qt.TextElideMode.ElideRight, room))

    def _show_progress(self, state: SessionState) -> None:
        feed = self._controller.feed
        fraction = feed.fraction if feed is not None else None
        live = self._controller.recorded is None and not state.run.over
        self.progress.setVisible(live)
        self.progress.setMaximum(_PERMILLE if fraction is not None else 0)
        self.progress.setValue(round(_PERMILLE * (fraction or 0.0)))
        left = feed.left_s if feed is not None else None
        self.left.setText(_left_words(left) if live and left is not None else "")

    def _show_gauges(self, state: SessionState | None) -> None:
        self.gauges.refresh()
        self.lights.show_feed(self._controller.feed)
        if state is None or state.run.over or state.step is None or not state.readings.channels:
            self.level.clear()
            return
        level = state.step.began.level_m_s2
        self.level.setText(
            f"level {acceleration_unit().said(level, '.3g')}" if level is not None else "level \u2013"
        )

    def _arrange(self) -> None:
        above, below = QHBoxLayout(), QHBoxLayout()
        above.addWidget(self.state)
        above.addWidget(self.next, 1)
        above.addWidget(self.progress)
        above.addWidget(self.left)
        below.addWidget(self.level)
        for gauge in self.gauges.by_name.values():
            below.addWidget(gauge, 2)
        below.addWidget(self.lights, 2)
        rows = QVBoxLayout()
        rows.addLayout(above)
        rows.addLayout(below)
        buttons = QGridLayout()
        buttons.addWidget(self.hold, 0, 0)
        buttons.addWidget(self.abort, 1, 0)
        buttons.addWidget(self.stop, 0, 1, 2, 1)
        whole = QHBoxLayout(self)
        whole.setContentsMargins(8, 4, 8, 4)
        whole.addLayout(rows, 1)
        whole.addLayout(buttons)


def _left_words(seconds: float) -> str:
    """Remaining time in words; never zero, as what takes longer than foreseen is not over."""
    return f"{duration(seconds)} left" if seconds >= 1 else "soon done"


def duration(seconds: float) -> str:
    """For people: 45 s, 3:20 min, 1:02 h."""
    whole = max(0, round(seconds))
    if whole < 60:
        return f"{whole} s"
    if whole < 3600:
        return f"{whole // 60}:{whole % 60:02d} min"
    return f"{whole // 3600}:{whole % 3600 // 60:02d} h"
