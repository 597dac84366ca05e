"""What a person can tell a run that goes on, or one that is about to begin."""

from collections.abc import Callable

from PySide6.QtCore import QObject

from gui.actions.starting import Starting
from gui.feeds.live import LiveFeed


class RunCommands(QObject):
    """Commands to the run shown; each does nothing where there is none to obey it.

    Parameters
    ----------
    live
        Gives the run, also after its end; None where there is none.
    starting
        Gives what reads the files of a run that is about to begin; None where none is.
    """

    def __init__(
        self, live: Callable[[], LiveFeed | None], starting: Callable[[], Starting | None], parent: QObject
    ) -> None:
        super().__init__(parent)
        self._live, self._starting = live, starting

    @property
    def running(self) -> bool:
        """Whether a run goes on."""
        return self._running() is not None

    @property
    def at_rest(self) -> bool:
        """Whether a run goes on that has let go of its shaker, known to be silent: it only computes."""
        live = self._running()
        return live is not None and live.let_go_at_rest

    def hold(self) -> None:
        """Silence the shaker and wait, or go on where it is held."""
        live = self._running()
        if live is None:
            return
        if live.state is not None and live.state.run.state == "held":
            live.engine.resume()
        else:
            live.engine.hold()

    def answer(self) -> None:
        """Tell the run that what it asked the operator for is done."""
        if (live := self._live()) is not None:
            live.answer()

    def decline(self) -> None:
        """Decline what the run offers to measure."""
        if (live := self._live()) is not None:
            live.answer(False)

    def leave_out(self) -> None:
        """Leave out the step that is being measured."""
        if (live := self._running()) is not None:
            live.engine.decline()

    def add_step(self, frequency_hz: float) -> None:
        """Add a step to a sweep that chooses its own."""
        if (live := self._running()) is not None:
            live.engine.overrule("add", frequency_hz)

    def end_sweep(self) -> None:
        """End a sweep that chooses its own steps: the run goes on with what is measured."""
        if (live := self._running()) is not None:
            live.engine.overrule("end")

    def abort(self) -> None:
        """End the run in order."""
        if (live := self._running()) is not None:
            live.engine.abort()

    def stop(self) -> None:
        """Silence the shaker past whatever hangs; a run that is about to begin does not."""
        if (starting := self._starting()) is not None:
            starting.cancel()
        elif (live := self._running()) is not None:
            live.stop()

    def _running(self) -> LiveFeed | None:
        live = self._live()
        return live if live is not None and live.engine.running else None
