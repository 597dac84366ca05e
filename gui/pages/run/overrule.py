"""A person's word to a sweep that chooses its own steps: leave this one out, add one, end."""

from PySide6.QtWidgets import QDoubleSpinBox, QHBoxLayout, QLabel, QWidget

from gui.actions.run_commands import RunCommands
from gui.state import SessionState
from gui.widgets.basic import button

_STEP_HZ = 0.1


class OverruleRow(QWidget):
    """Seen only while such a sweep goes on; acts on the run."""

    def __init__(self, commands: RunCommands, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._commands = commands
        self.leave_out = button("Leave this step out", "Nothing of it is kept; it is not chosen again")
        self.frequency = QDoubleSpinBox()
        self.frequency.setDecimals(3)
        self.frequency.setSingleStep(_STEP_HZ)
        self.frequency.setSuffix(" Hz")
        self.add = button("Measure next", "A step of your own, before the one that is chosen")
        self.end = button("End the sweep", "After this step; the run goes on with what is measured")
        self.leave_out.clicked.connect(commands.leave_out)
        self.add.clicked.connect(self._add)
        self.end.clicked.connect(commands.end_sweep)
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        for one in (self.leave_out, QLabel("or"), self.frequency, self.add, self.end):
            row.addWidget(one)
        row.addStretch(1)
        self.hide()

    def show_state(self, state: SessionState) -> None:
        """Show what may be overruled as the run stands now."""
        table = state.configuration.experiment.sweep
        wish = table.adaptive if table is not None else None
        goes_on = self._commands.running and state.run.state == "sweep" and state.run.choice is not None
        self.setVisible(wish is not None and goes_on)
        if wish is not None and self.frequency.maximum() != wish.band_hz[1]:
            self.frequency.setRange(*wish.band_hz)

    def _add(self) -> None:
        self._commands.add_step(self.frequency.value())
