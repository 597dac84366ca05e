"""A person's word to a sweep that chooses its own steps: the row, and what it asks of the run."""

from types import SimpleNamespace

import pytest
from PySide6.QtCore import Qt

from gui.pages.run.overrule import OverruleRow

LEFT = Qt.MouseButton.LeftButton


class Asked:
    """Commands that keep what is asked of the run."""

    def __init__(self, running=True):
        self.running, self.said = running, []

    def leave_out(self):
        self.said.append("leave out")

    def add_step(self, frequency_hz):
        self.said.append(frequency_hz)

    def end_sweep(self):
        self.said.append("end")


def state_of(*, adaptive=True, run="sweep", choice=True):
    wish = SimpleNamespace(band_hz=[15.0, 60.0]) if adaptive else None
    experiment = SimpleNamespace(sweep=SimpleNamespace(adaptive=wish))
    return SimpleNamespace(
        configuration=SimpleNamespace(experiment=experiment),
        run=SimpleNamespace(state=run, choice=object() if choice else None),
    )


@pytest.fixture
def row(qtbot):
    row = OverruleRow(Asked())
    qtbot.addWidget(row)
    row.show_state(state_of())
    return row


def test_each_button_asks_for_what_it_says(qtbot, row):
    row.frequency.setValue(45.2)
    for button in (row.leave_out, row.add, row.end):
        qtbot.mouseClick(button, LEFT)
    assert row._commands.said == ["leave out", 45.2, "end"]


def test_a_step_of_ones_own_lies_in_the_band(row):
    row.frequency.setValue(500.0)
    assert row.frequency.value() == 60.0


@pytest.mark.parametrize(
    "state",
    [state_of(adaptive=False), state_of(run="diagnosing"), state_of(choice=False)],
    ids=["a fixed sweep", "the sweep is over", "nothing is chosen yet"],
)
def test_it_is_not_seen_where_there_is_nothing_to_overrule(row, state):
    assert not row.isHidden()
    row.show_state(state)
    assert row.isHidden()
