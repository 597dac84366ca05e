"""Where the Tab key goes: through the parts of a window as they are seen, whenever they were made.

Qt's own order is that of making. Pages, forms and panes are made when they are wanted: the last of them
would come after the log, whatever stands beside them.
"""

from collections.abc import Iterator, Sequence

from PySide6.QtCore import QObject, Qt
from PySide6.QtWidgets import QSplitter, QTabBar, QWidget


def in_order(parts: Sequence[QWidget]) -> list[QWidget]:
    """What Tab stops at in these, one part after the other; a row of tabs before what is below it."""
    return [widget for part in parts for widget in _of(part) if _stops(widget)]


def neighbour(parts: Sequence[QWidget], current: QWidget | None, *, forward: bool) -> QWidget | None:
    """The next stop, or the one before; around the end to the beginning. None where there is no other.

    From a widget at which Tab does not stop it goes on with what stands behind it.
    """
    every = [widget for part in parts for widget in _of(part)]
    if not any(map(_stops, every)):
        return None
    if current not in every:
        every = [*every, current] if forward else [current, *every]  # type: ignore[list-item]
    at = every.index(current)  # type: ignore[arg-type]
    around = [*every[at + 1 :], *every[:at]]
    return next(filter(_stops, around if forward else reversed(around)), None)


def _of(part: QWidget) -> Iterator[QWidget]:
    """The part and all that is in it, as deep as it goes."""
    yield part
    inside = [c for c in _inside(part) if isinstance(c, QWidget) and not c.isWindow() and c.isVisible()]
    for child in sorted(inside, key=lambda c: not isinstance(c, QTabBar)):
        yield from _of(child)


def _inside(part: QWidget) -> Sequence[QObject | None]:
    if isinstance(part, QSplitter):
        # Its children are in the order of drawing.
        return [part.widget(k) for k in range(part.count())]
    return part.children()


def _stops(widget: QWidget) -> bool:
    # What stands for another widget, as a scrolled area's inside does, would give the keyboard to that one.
    tabbed = bool(widget.focusPolicy() & Qt.FocusPolicy.TabFocus) and widget.focusProxy() is None
    return tabbed and widget.isEnabled() and widget.isVisible()
