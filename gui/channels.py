"""Every input as it is now: a light each in the bar above, a table on the page of the run."""

from html import escape

from PySide6.QtWidgets import QLabel, QWidget

from gui.feeds.feed import Feed
from gui.state.readings import FRESH_S, ChannelNow, Readings
from gui.tables import Cell, ReadTable
from gui.theme import Role, current_theme

_CLIPPED_S = 3.0
"""A light stays on for so long: nobody sees one that flashes."""
_NEAR = 0.8
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
    """A light for each channel."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.said: dict[str, str] = {}
        self.setMinimumWidth(1)

    def show_feed(self, feed: Feed | None) -> None:
        """Show the lights as the feed has them now."""
        rows = _rows(feed)
        self.said = {channel.name: words_of(channel, clipped) for channel, clipped in rows}
        theme, lights = current_theme(), []
        for channel, clipped in rows:
            role = role_of(channel, clipped)
            sign = "\u25cf" if role == "good" else "\u25b2" if role == "fair" else "\u2716"
            color = theme.color(role).name()
            lights.append(f"<span style='color:{color}'>{sign}</span> {escape(channel.name)}")
        self.setText("&nbsp; ".join(lights))
        self.setToolTip("\n".join(f"{name}: {words}" for name, words in self.said.items()))


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
