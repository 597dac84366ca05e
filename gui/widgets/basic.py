"""Small widgets made in one line."""

from PySide6.QtWidgets import QLabel, QPushButton, QToolButton

from gui.style.icons import Sign
from gui.style.style_sheet import PRIMARY


def button(text: str, tip: str = "", sign: str = "", *, primary: bool = False) -> QPushButton:
    """A push button with its tool tip, and a sign of `gui.style.icons`; the `primary` one goes on."""
    made = QPushButton(text)
    made.setToolTip(tip)
    if primary:
        made.setObjectName(PRIMARY)
    if sign:
        Sign(made, sign, "accent_text" if primary else "text")
    return made


def tool(sign: str, tip: str) -> QToolButton:
    """A flat button of one sign of `gui.style.icons`, with its tool tip."""
    made = QToolButton()
    made.setToolTip(tip)
    made.setAccessibleName(tip)
    made.setAutoRaise(True)
    Sign(made, sign)
    return made


def hint(text: str) -> QLabel:
    """A line that stands where there is nothing to show yet."""
    made = QLabel(text)
    made.setWordWrap(True)
    made.setEnabled(False)
    return made
