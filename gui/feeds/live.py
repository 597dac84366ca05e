"""A run that goes on in its engine."""

from collections import deque
from collections.abc import Callable
from time import monotonic

from PySide6.QtCore import QObject, Signal

from gui.background.task import BackgroundTask, Progress
from gui.feeds.feed import Feed, Turn
from gui.state import SessionState
from instrument.engine import Engine, Order, Stopped
from instrument.engine.messages import (
    BlocksDropped,
    Ended,
    Happened,
    Logged,
    Message,
    OperatorAsked,
    Planned,
    Progressed,
    RecordingBegan,
    RigClosed,
    RigOpened,
    ShakerSeen,
    StopPathChanged,
)
from instrument.session.configuration import Configuration
from instrument.stream.derived import HitRevised
from instrument.stream.event import Event
from instrument.stream.raw import BlockAcquired

_AT_ONCE = 64
"""Messages between two looks at the clock."""
_PACE_EVERY_S, _PACE_MARKS = 0.5, 20
_QUESTIONS: dict[str, Callable[[OperatorAsked, str], str]] = {
    "mount": lambda a, kind: f"mount the {a.detail} {kind}, nothing else on it",
    "aim": lambda a, _: (
        f"aim the laser at the {'base beside the accelerometer' if a.detail == 'base' else a.detail}, focus"
    ),
    "hit": lambda a, _: "",
    "content": lambda a, _: f"{a.good} good hits: use them, or decide otherwise",
    "follow-up": lambda a, _: a.detail,
    "change": lambda a, _: a.detail,
}
"""What is asked, of a specimen of that kind in words."""


class LiveFeed(Feed):
    """Asks the engine for what has come, at every turn.

    Signals
    -------
    asked
        The operator is asked for something: an `OperatorAsked`. `question` holds it until it is answered.
    stopped
        What the stop button achieved: a `Stopped`.
    """

    asked = Signal(object)
    stopped = Signal(object)

    def __init__(
        self,
        order: Order,
        configuration: Configuration,
        parent: QObject | None = None,
        engine: Engine | None = None,
    ) -> None:
        super().__init__(parent)
        self.engine = engine if engine is not None else Engine.start(order)
        self.state = SessionState(configuration)
        self.state.begin()
        self.question: OperatorAsked | None = None
        self.ending: Ended | None = None
        self.recording: RecordingBegan | None = None
        self.stop_path: StopPathChanged | None = None
        self.rig_open = self.let_go_at_rest = False
        """Whether the run has its devices; whether it let go of them, and of a shaker known to be silent."""
        self.blocks_dropped = 0
        self._pace = _WallPace()
        self._stopping: BackgroundTask[Stopped] | None = None

    @property
    def left_s(self) -> float | None:
        """Of the whole run, on the wall; a rig in virtual time is faster than its clock."""
        assert self.state is not None
        to_go = self.state.time_to_go
        measuring, beside = to_go.measuring_s(self.state.time_s), to_go.beside_s(monotonic())
        if measuring is None or beside is None:
            return None
        return measuring * self._pace.wall_s_per_s + beside

    @property
    def fraction(self) -> float | None:
        """Of the whole run that is done, 0 to 1; None before anything is known."""
        assert self.state is not None
        return self.state.time_to_go.fraction(self.state.time_s, monotonic())

    @property
    def ages_s(self) -> tuple[float, float]:
        """Seconds since anything was heard of the drive, and of the samples."""
        assert self.state is not None
        readings, now = self.state.readings, monotonic()
        return now - readings.drive_at, now - readings.samples_at

    def advance(self) -> None:
        """Take what has come."""
        turn = Turn()
        while not turn.over:
            messages = self.engine.poll(_AT_ONCE)
            for message in messages:
                self._take(message)
            if len(messages) < _AT_ONCE:
                return

    def answer(self, agreed: bool = True) -> None:
        """The operator has done what was asked for, or says whether an offer is to be measured."""
        if self.question is None:
            return
        match self.question.what:
            case "mount":
                self.engine.mounted()
            case "aim":
                self.engine.aimed()
            case "content":
                self.engine.content()
            case "change":
                self.engine.changed()
            case "follow-up":
                self.engine.agree(agreed)
        self._ask(None)

    def stop(self) -> None:
        """Silence the shaker past whatever hangs, and end the run; again where it was tried before."""
        if self._stopping is not None and not self._stopping.over:
            return
        self._stopping = BackgroundTask(_stop(self.engine), self)
        self._stopping.done.connect(self._stopped)
        self._stopping.failed.connect(self._stop_failed)
        self._stopping.start()

    def close(self) -> None:
        """A run that still goes on is stopped."""
        self.engine.close()

    def _stopped(self, result: object) -> None:
        self.stopped.emit(result)

    def _stop_failed(self, said: str) -> None:
        self.stopped.emit(Stopped(silent=False, seconds=0.0, message=f"the shaker did not answer: {said}"))

    def _take(self, message: Message) -> None:
        assert self.state is not None
        match message:
            case Happened():
                self.state.take(message.event, message.at_s)
                self._follow(message.event)
            case OperatorAsked():
                self._ask(message)
            case Progressed():
                self.state.work("" if message.ended else message.what, message.fraction)
            case Planned():
                self.state.time_to_go.plan(message.work, monotonic())
                self.state.foresee(message.regions)
            case BlocksDropped():
                self.blocks_dropped += message.count
                self.state.say(f"{message.count} blocks not shown; the session has them", "warning")
            case Logged():
                self.state.say(message.text, "warning" if message.level != "INFO" else "said")
            case RecordingBegan():
                self.recording = message
            case RigOpened() | RigClosed():
                self.rig_open = isinstance(message, RigOpened)
                self.let_go_at_rest = isinstance(message, RigClosed) and message.at_rest
                self.state.readings.forget()
            case ShakerSeen():
                if self.rig_open:
                    self.state.readings.see_drive(message.drive_v, message.at_s)
            case StopPathChanged():
                self.stop_path = message
                if not message.ready:
                    self.state.say(f"no stop path of the window's own: {message.message}", "warning")
            case Ended():
                self._end(message)

    def _follow(self, event: Event) -> None:
        assert self.state is not None
        if isinstance(event, BlockAcquired):
            self._pace.take(self.state.time_s)
        elif isinstance(event, HitRevised) and self.question is not None and self.question.what == "content":
            run = self.state.run
            if run.good_hits < run.wanted_hits:
                self._ask(None)

    def _ask(self, question: OperatorAsked | None) -> None:
        assert self.state is not None
        self.question = question if question is not None and question.what != "hit" else None
        kind = self.state.configuration.the_specimen().kind.replace("-", " ")
        self.state.ask(_QUESTIONS[question.what](question, kind) if question is not None else "")
        self.asked.emit(question)

    def _end(self, message: Ended) -> None:
        assert self.state is not None
        self.ending = message
        self.state.end(message.why, message.message)
        self._ask(None)
        self.ended.emit()


class _WallPace:
    """Seconds on the wall for one of the session's, over the last while."""

    def __init__(self) -> None:
        self._marks: deque[tuple[float, float]] = deque(maxlen=_PACE_MARKS)

    def take(self, session_s: float) -> None:
        """The session's clock stands here now."""
        now = monotonic()
        if not self._marks or now - self._marks[-1][0] >= _PACE_EVERY_S:
            self._marks.append((now, session_s))

    @property
    def wall_s_per_s(self) -> float:
        """1 until it is known."""
        if len(self._marks) < 2:
            return 1.0
        (wall, session), (wall_now, session_now) = self._marks[0], self._marks[-1]
        passed = session_now - session
        return (wall_now - wall) / passed if passed > 0 else 1.0


def _stop(engine: Engine) -> Callable[[Progress], Stopped]:
    def stop(_: Progress) -> Stopped:
        return engine.stop()

    return stop
