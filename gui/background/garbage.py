"""Rubbish is collected in the main thread and nowhere else.

Python collects cycles in whichever thread happens to need memory. A widget found there is deleted at another
moment than Qt expects, and the program crashes. So Python's own way is switched off, and a timer does it.
"""

import gc

from PySide6.QtCore import QObject, QTimer

_TURN_MS = 500


class Collector(QObject):
    """From its making until `stop`. One at a time."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        gc.collect()
        # What is there from the start stays: no collection has to walk through it.
        gc.freeze()
        gc.disable()
        self._timer = QTimer(self)
        self._timer.setInterval(_TURN_MS)
        self._timer.timeout.connect(self.look)
        self._timer.start()

    def look(self) -> None:
        """Collect the oldest generation that is due."""
        for generation in (2, 1, 0):
            if gc.get_count()[generation] > gc.get_threshold()[generation]:
                gc.collect(generation)
                return

    def stop(self) -> None:
        """Back to Python's own way; what was there from the start stays put."""
        self._timer.stop()
        gc.collect()
        gc.enable()
