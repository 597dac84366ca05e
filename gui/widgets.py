"""Small widgets made in one line."""

from PySide6.QtWidgets import QLabel, QPushButton, QToolButton


def button(text: str, tip: str = "") -> QPushButton:
    """A push button with its tool tip."""
    made = QPushButton(text)
    made.setToolTip(tip)
    return made


def tool(text: str, tip: str) -> QToolButton:
    """A flat button of one sign, with its tool tip."""
    made = QToolButton()
    made.setText(text)
    made.setToolTip(tip)
    made.setAutoRaise(True)
    return made


def hint(text: str) -> QLabel:
    """A line that stands where there is nothing to show yet."""
    made = QLabel(text)
    made.setWordWrap(True)
    made.setEnabled(False)
    return made
