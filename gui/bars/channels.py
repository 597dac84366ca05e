"""Every input as it is now: a light each in the bar above, a table on the page of the run."""

from html import escape

from PySide6.QtCore import QSize
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QLabel, QWidget

from gui.feeds.feed import Feed
from gui.state.readings import FRESH_S, ChannelNow, Readings
from gui.style.theme import Role, current_theme
from gui.widgets.tables import Cell, ReadTable

_CLIPPED_S = 3.0
"""A light stays on for so long: nobody sees one that flashes."""
_NEAR = 0.8
_GAP = "\u00a0 "
_COLUMNS = {
    "channel": "What the input measures",
    "peak / V": "Largest in the newest block",
    "of / V": "The input's full scale",
    "used": "Of the full scale",
    "state": "Whether it is driven beyond its range, or its cable is at fault",
}


def role_of(channel: ChannelNow, clipped: bool) -> Role:
    """Good, near its range, beyond it."""
    if clipped or channel.overload or channel.cable_fault:
        return "bad"
    return "fair" if channel.share >= _NEAR else "good"


def words_of(channel: ChannelNow, clipped: bool) -> str:
    """What `role_of` shows by colour, in words: no meaning is carried by colour alone."""
    if channel.cable_fault:
        return "cable fault"
    if channel.overload or clipped:
        return "clipped"
    return "near its range" if channel.share >= _NEAR else "well"


class ClipLights(QLabel):
    """A light for each channel; where there is no room for their names these are shortened."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.said: dict[str, str] = {}
        self._lights: list[tuple[str, str, str]] = []
        """Of each channel its name, sign and colour."""
        self.setMinimumWidth(1)

    def show_feed(self, feed: Feed | None) -> None:
        """Show the lights as the feed has them now."""
        rows = _rows(feed)
        self.said = {channel.name: words_of(channel, clipped) for channel, clipped in rows}
        theme, self._lights = current_theme(), []
        for channel, clipped in rows:
            role = role_of(channel, clipped)
            sign = "\u25cf" if role == "good" else "\u25b2" if role == "fair" else "\u2716"
            self._lights.append((channel.name, sign, theme.color(role).name()))
        self._show()
        self.setToolTip("\n".join(f"{name}: {words}" for name, words in self.said.items()))

    def sizeHint(self) -> QSize:
        """All names whole: what is shown follows the room, and must not change it."""
        return QSize(self._width(self._longest), super().sizeHint().height())

    def resizeEvent(self, event: QResizeEvent) -> None:
        """More of the names, or less."""
        super().resizeEvent(event)
        self._show()

    @property
    def _longest(self) -> int:
        return max((len(name) for name, _, _ in self._lights), default=0)

    def _width(self, letters: int) -> int:
        plain = _GAP.join(f"{sign} {_cut(name, letters)}" for name, sign, _ in self._lights)
        return self.fontMetrics().horizontalAdvance(plain)

    def _show(self) -> None:
        letters = self._longest
        while letters > 1 and self._width(letters) > self.width():
            letters -= 1
        self.setText(
            _GAP.join(
                f"<span style='color:{color}'>{sign}</span> {escape(_cut(name, letters))}"
                for name, sign, color in self._lights
            )
        )


def _cut(name: str, letters: int) -> str:
    return name if len(name) <= letters else f"{name[: letters - 1]}\u2026"


class ChannelTable(ReadTable):
    """Every channel with its numbers."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(_COLUMNS, parent)

    def show_feed(self, feed: Feed | None) -> None:
        """As they are now; grey where nothing has come for a while."""
        old = feed is not None and feed.ages_s[1] > FRESH_S
        self.show_rows(
            [
                [
                    Cell(c.name, left=True, faint=old),
                    Cell(f"{c.peak_v:.3g}", faint=old),
                    Cell(f"{c.full_scale_v:.3g}", faint=old),
                    Cell(
                        f"{100 * c.share:.0f} %", fill=role_of(c, clipped), share=min(1.0, c.share), faint=old
                    ),
                    Cell("old" if old else words_of(c, clipped), left=True, faint=old),
                ]
                for c, clipped in _rows(feed)
            ]
        )
        self.setVisible(bool(_rows(feed)))


def _rows(feed: Feed | None) -> list[tuple[ChannelNow, bool]]:
    """The channels, and whether each was clipped a moment ago."""
    if feed is None or feed.state is None or feed.state.run.over:
        return []
    readings: Readings = feed.state.readings
    return [
        (c, readings.samples_at - readings.clipped.get(c.name, -_CLIPPED_S - 1) < _CLIPPED_S)
        for c in readings.channels
    ]
