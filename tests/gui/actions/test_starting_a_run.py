"""The files of a run that is about to begin."""

from PySide6.QtCore import QObject

from gui.actions.starting import Starting
from instrument.engine import Order
from instrument.session.configuration import Configuration
from instrument.simulated_case import write_case


def test_the_experiments_configuration_is_read_with_its_name(qtbot, tmp_path):
    order = Order(write_case(tmp_path), tmp_path)
    parent = QObject()
    starting = Starting(order, parent)
    with qtbot.waitSignal(starting.done, timeout=20_000) as done:
        starting.start()
    (configuration,) = done.args
    assert isinstance(configuration, Configuration)
    assert starting.order is order
    starting.close()


def test_a_file_that_is_wrong_is_told_in_one_line(qtbot, tmp_path):
    parent = QObject()
    starting = Starting(Order(tmp_path / "none.toml", tmp_path), parent)
    with qtbot.waitSignal(starting.failed, timeout=20_000) as failed:
        starting.start()
    (message,) = failed.args
    assert "none.toml" in message
    starting.close()
