"""The files of a run that is about to begin, read off the main thread."""

from PySide6.QtCore import QObject

from gui.background.task import BackgroundTask, Progress
from instrument.engine import Order
from instrument.session.configuration import Configuration, read_whole_experiment


class Starting(BackgroundTask[Configuration]):
    """Reads the experiment of a run that was asked for."""

    def __init__(self, order: Order, parent: QObject) -> None:
        super().__init__(self._read_files, parent)
        self.order = order

    def _read_files(self, _: Progress) -> Configuration:
        return read_whole_experiment(self.order.experiment).configuration(self.order.experiment.stem, "")
