"""Play, pause, jump, speed, compare: at the foot of the window while a recording is shown."""

from PySide6.QtCore import QSignalBlocker, Qt, Signal
from PySide6.QtGui import QMouseEvent
from PySide6.QtWidgets import (
    QComboBox,
    QFrame,
    QHBoxLayout,
    QLabel,
    QSlider,
    QStyle,
    QWidget,
)

from gui.bars.top_bar import duration
from gui.feeds.recorded import RecordedFeed
from gui.style.icons import Sign
from gui.widgets.basic import button, tool
from gui.widgets.elided import ElidedLabel
from instrument.facts.run import ReplayResult

_STEPS = 10_000
_VERIFY = "Verify"
SPEEDS: dict[str, float | None] = {
    "0.25\u00d7": 0.25,
    "1\u00d7": 1.0,
    "2\u00d7": 2.0,
    "5\u00d7": 5.0,
    "20\u00d7": 20.0,
    "100\u00d7": 100.0,
    "fastest": None,
}


class Scrubber(QSlider):
    """A click goes to where it is, and the handle follows from there."""

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Go there, then drag."""
        if event.button() == Qt.MouseButton.LeftButton:
            handle = self.style().pixelMetric(QStyle.PixelMetric.PM_SliderLength, None, self)
            at, room = round(event.position().x()) - handle // 2, self.width() - handle
            self.setValue(QStyle.sliderValueFromPosition(self.minimum(), self.maximum(), at, room))
        super().mousePressEvent(event)


class ReplayBar(QFrame):
    """Of one recording at a time.

    Signals
    -------
    compare_wanted
        Another session is to be laid beside this one.
    """

    compare_wanted = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._feed: RecordedFeed | None = None
        self.play = button("Play", "Play or pause (Ctrl+Space)")
        self._sign = Sign(self.play, "play")
        self.back = tool("back", "To the mark before (Ctrl+Left)")
        self.on = tool("on", "To the next mark (Ctrl+Right)")
        self.slider = Scrubber(Qt.Orientation.Horizontal)
        self.slider.setMaximum(_STEPS)
        self.slider.setPageStep(_STEPS // 50)
        self.time, self.mark = QLabel(), QLabel()
        self.speed = QComboBox()
        self.speed.setToolTip("Speed")
        self.speed.addItems(list(SPEEDS))
        self.speed.setCurrentText("1\u00d7")
        self.compare = button("Compare...", "Lay the law of another session beside this one's", "compare")
        self.verify = button(
            _VERIFY, "Compute everything derived again: does it equal the recording?", "verify"
        )
        self.verdict = ElidedLabel()
        self.play.clicked.connect(self.toggle)
        self.back.clicked.connect(self.to_mark_before)
        self.on.clicked.connect(self.to_next_mark)
        self.slider.valueChanged.connect(self._slid)
        self.speed.currentTextChanged.connect(self._speed_chosen)
        self.compare.clicked.connect(self.compare_wanted)
        self.verify.clicked.connect(self._verify)
        row = QHBoxLayout(self)
        row.setContentsMargins(8, 2, 8, 2)
        for widget in (
            self.play,
            self.back,
            self.on,
            self.slider,
            self.time,
            self.mark,
            self.speed,
            self.compare,
            self.verify,
            self.verdict,
        ):
            row.addWidget(widget, 1 if widget is self.slider else 0)
        self.show_feed(None)

    def show_feed(self, feed: RecordedFeed | None) -> None:
        """Another recording, or none."""
        self._feed = feed
        self.setVisible(feed is not None)
        self.verdict.say("")
        if feed is not None:
            feed.moved.connect(self._moved)
            feed.compared.connect(self._compared)
            feed.comparison_failed.connect(self._not_compared)
            self._moved()

    def toggle(self) -> None:
        """Play or pause."""
        if self._feed is None:
            return
        if self._feed.playing:
            self._feed.pause()
        else:
            self._feed.play(SPEEDS[self.speed.currentText()])

    def to_mark_before(self) -> None:
        """Where the part began that is shown; again: the one before it."""
        if self._feed is not None and self._feed.index is not None:
            now = self._feed.position_s
            self._feed.jump(max((m.time_s for m in self._feed.index.marks if m.time_s < now), default=0.0))

    def to_next_mark(self) -> None:
        """Where the next part begins."""
        if self._feed is not None and self._feed.index is not None:
            now, end = self._feed.position_s, self._feed.length_s
            self._feed.jump(min((m.time_s for m in self._feed.index.marks if m.time_s > now), default=end))

    def _slid(self, value: int) -> None:
        if self._feed is not None:
            self._feed.jump(value / _STEPS * self._feed.length_s)

    def _speed_chosen(self, text: str) -> None:
        if self._feed is not None and self._feed.playing:
            self._feed.play(SPEEDS[text])

    def _moved(self) -> None:
        feed = self._feed
        if feed is None or feed.index is None:
            return
        with QSignalBlocker(self.slider):
            self.slider.setValue(round(_STEPS * feed.position_s / feed.length_s) if feed.length_s else 0)
        self.time.setText(f"{duration(feed.position_s)} of {duration(feed.length_s)}")
        passed = [m.what for m in feed.index.marks if m.time_s <= feed.position_s]
        self.mark.setText(passed[-1] if passed else "")
        self.play.setText("Pause" if feed.playing else "Play")
        self._sign.show("pause" if feed.playing else "play")

    def _verify(self) -> None:
        if self._feed is None:
            return
        if self._feed.comparing:
            self._feed.cancel_comparison()
            self._say(_VERIFY, "not compared")
        else:
            self._feed.compare()
            self._say("Cancel", "computing again ...")

    def _compared(self, found: ReplayResult) -> None:
        same = found.equal_to_recorded
        said = f"{found.derived_events} events {'equal' if same else 'NOT all equal'}"
        self._say(_VERIFY, said, "\n".join(found.differences))

    def _not_compared(self, message: str) -> None:
        self._say(_VERIFY, message)

    def _say(self, button: str, verdict: str, tip: str = "") -> None:
        self.verify.setText(button)
        self.verdict.say(verdict, tip)
