"""How far a computation is: what is being worked at, a bar, and a button that ends it."""

from PySide6.QtWidgets import QHBoxLayout, QLabel, QProgressBar, QWidget

from gui.widgets.basic import button

_PERCENT = 100
"""A bar counts whole steps: no more of them can be told apart on its width."""
_WIDTH_PX = 160
"""Enough to see it move, beside the buttons of a row (a choice)."""


class WorkBar(QWidget):
    """In a row of buttons, while something is being computed."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.doing, self.bar = QLabel(), QProgressBar()
        self.cancel = button("Cancel", "End the computation; what is shown stays")
        self.bar.setFixedWidth(_WIDTH_PX)
        self.bar.setTextVisible(False)
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        for one in (self.doing, self.bar, self.cancel):
            row.addWidget(one)

    def begin(self, what: str) -> None:
        """Work whose length is not known yet."""
        self.doing.setText(what)
        self.bar.setMaximum(0)

    def tell(self, what: str, fraction: float) -> None:
        """What is being worked at, and the fraction of it that is done, 0 to 1."""
        self.doing.setText(what)
        self.bar.setMaximum(_PERCENT)
        self.bar.setValue(round(_PERCENT * fraction))
