"""What a run tells a person as it goes: one line a hit, a progress bar a segment, every remark."""

from collections.abc import Callable

from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

from instrument.progress import Screen
from instrument.results.event_words import Saying
from instrument.stepped_sine.soak import Soak
from instrument.stream.derived import PointMeasured
from instrument.stream.event import Event
from instrument.stream.raw import SegmentBegan, SoakBegan, TemperatureRead


class Watcher:
    """Consumes events once they are on the disk. Use as a context."""

    def __init__(self) -> None:
        self._console = Screen(stderr=True, highlight=False)
        self._bars = Progress(
            TextColumn("{task.description}"),
            BarColumn(),
            MofNCompleteColumn(),
            TimeElapsedColumn(),
            console=self._console,
            transient=True,
            disable=not self._console.is_terminal,
        )
        self._task = self._bars.add_task("", total=1, visible=False)
        self._soak: Soak | None = None
        self._saying = Saying()

    def __enter__(self) -> Callable[[list[Event]], None]:
        return self.watch

    def __exit__(self, *_: object) -> None:
        self._bars.stop()

    def watch(self, events: list[Event]) -> None:
        """Show what is worth showing. Until there is something, other bars have the line."""
        self._bars.start()
        for event in events:
            if isinstance(event, SegmentBegan):
                name = f"sweep {event.sweep} " if event.sweep > 1 else ""
                what = "calibration" if event.sweep == 0 else f"{name}segment {event.segment}"
                self._bars.reset(
                    self._task,
                    total=event.steps,
                    description=f"{what}: {event.low_hz:g} to {event.high_hz:g} Hz",
                    visible=True,
                )
            elif isinstance(event, PointMeasured) and event.purpose != "sentinel":
                self._bars.advance(self._task)
            elif isinstance(event, SoakBegan):
                self._soak = Soak(event)
                self._bars.reset(self._task, total=event.soak_s, description=self._soak.words, visible=True)
            elif isinstance(event, TemperatureRead) and event.soak_s is not None and self._soak is not None:
                self._soak.take(event)
                self._bars.update(
                    self._task, completed=round(self._soak.near_s), description=self._soak.words
                )
            line = self._saying.line(event)
            if line:
                self._console.print(line, markup=False, soft_wrap=True)
