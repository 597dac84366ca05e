"""What goes over the pipe between the engine and its client. Frozen, plain; every kind is in this file."""

from dataclasses import dataclass, field
from pathlib import Path
from time import monotonic
from typing import ClassVar, Literal

from instrument.check.piece import Region, TimedPiece
from instrument.files.rig_file import Shaker
from instrument.run.part import Part
from instrument.stream.event import Event
from instrument.stream.raw import Ending

Why = Ending | Literal["bad input", "died"]
"""A run ended. "died": the engine's process ended without a word, or was ended because it did not answer."""


@dataclass(frozen=True)
class Message:
    """Something said by one side to the other."""

    known: ClassVar[dict[str, type["Message"]]] = {}
    """Every kind of message by its name."""

    def __init_subclass__(cls) -> None:
        super().__init_subclass__()
        Message.known[cls.__name__] = cls


# To the engine


@dataclass(frozen=True)
class Order(Message):
    """What to run: the first message, and once. Its fields are those of `viscorig run`."""

    experiment: Path
    out: Path
    """Folder of the session."""
    parts: tuple[Part, ...] = ("hammer", "sweep")
    resume: Path | None = None
    """Folder of a run that was broken off."""
    ask_content: bool = False
    """Whether the hammer test, once it has its hits, waits for `Answered("content")`."""


@dataclass(frozen=True)
class HoldWanted(Message):
    """Silence the shaker and wait."""


@dataclass(frozen=True)
class ResumeWanted(Message):
    """Go on after a hold."""


@dataclass(frozen=True)
class DeclineWanted(Message):
    """Leave out the step that is being measured."""


@dataclass(frozen=True)
class OverruleWanted(Message):
    """A word to a sweep that chooses its own steps: a step next, or none any more."""

    what: Literal["add", "end"]
    frequency_hz: float | None = None


@dataclass(frozen=True)
class AbortWanted(Message):
    """End the run, as Ctrl-C does on a terminal. What is complete is kept."""


@dataclass(frozen=True)
class StopWanted(Message):
    """Silence the shaker at once, past whatever the run is doing, and end the run."""


@dataclass(frozen=True)
class Answered(Message):
    """What was asked for is done, the hits may be used, or an offer is to be measured or not."""

    what: Literal["mounted", "aimed", "changed", "content", "agreed", "declined"]


@dataclass(frozen=True)
class Decided(Message):
    """The operator's word about a hit."""

    what: Literal["accepted", "rejected", "undone"]
    hit: int = 0
    """Counts from 1; 0 is the last one."""


# From the engine


@dataclass(frozen=True)
class Happened(Message):
    """An event of the one stream, at once; it may not be on the disk yet.

    Blocks carry their samples. A run that is carried on tells what it has from before first, without samples.
    """

    event: Event
    at_s: float = field(default_factory=monotonic, compare=False)
    """When it came here, on `time.monotonic`."""


@dataclass(frozen=True)
class Planned(Message):
    """All the work of the run, before it begins."""

    work: tuple[TimedPiece, ...]
    regions: tuple[Region, ...] = ()
    """Swept, each once."""


@dataclass(frozen=True)
class BlocksDropped(Message):
    """So many blocks are missing here: the reader was too slow. The session on the disk has them."""

    count: int


@dataclass(frozen=True)
class Progressed(Message):
    """Long work goes on."""

    what: str
    fraction: float
    """Done, 0 to 1."""
    ended: bool = False


@dataclass(frozen=True)
class OperatorAsked(Message):
    """The operator is asked for something.

    "mount", "aim", "change" and "follow-up" wait for `Answered`. "hit" waits for a blow; "content" for
    `Answered("content")` or for a decision about a hit.
    """

    what: Literal["mount", "aim", "hit", "content", "follow-up", "change"]
    detail: str = ""
    """The plate ("bare", "damped"), the point ("base", "pickup"), or what there is to do."""
    at_mm: tuple[float, float] | None = None
    """Where on the plate: x from the clamp, y from a long edge."""
    mark: str = ""
    """What goes there; `clamp` without a place: the plate's clamped edge."""
    read_mm: tuple[float, float] | None = None
    """Where the laser is to point meanwhile, where that is asked for too."""
    free: bool = False
    """Whether the plate hangs free: x from the end that was clamped."""
    good: int = 0
    """Good hits so far."""
    wanted: int = 0
    """Good hits wanted; 0 where it does not matter."""


@dataclass(frozen=True)
class Logged(Message):
    """A line of the log."""

    utc: str
    level: str
    """As `logging` names it: INFO, WARNING, ERROR."""
    text: str


@dataclass(frozen=True)
class RecordingBegan(Message):
    """The run is being recorded."""

    folder: Path
    """Until its end; then what there is to resume or recover from."""
    session: Path
    """What the folder becomes."""


@dataclass(frozen=True)
class RigOpened(Message):
    """All devices answer. From here on the shaker can be driven."""

    shaker: Shaker
    """Where it answers, also that of a rig simulated for the run."""


@dataclass(frozen=True)
class RigClosed(Message):
    """The devices are being let go of; a diagnosis may follow."""

    at_rest: bool = True
    """Whether the shaker is known to be silent."""


@dataclass(frozen=True)
class Silenced(Message):
    """The engine's own answer to `StopWanted` and `AbortWanted`: the shaker is at rest."""


@dataclass(frozen=True)
class Ended(Message):
    """The run is over: always the last message, once."""

    why: Why
    message: str = ""
    """One line for people; empty where it is done."""
    session: Path | None = None
    """The session file; of a run that ended early with what is complete. None where there is none."""
    folder: Path | None = None
    """To resume or recover from; None where the session is whole or nothing was measured."""


# From the client's own side, in the same list


@dataclass(frozen=True)
class StopPathChanged(Message):
    """Whether the client's own connection to the shaker stands: the stop button's way past the engine."""

    ready: bool
    message: str = ""
    """Why not, in one line; what stops the shaker then."""


@dataclass(frozen=True)
class ShakerSeen(Message):
    """What the shaker itself says, over the client's own connection: several times a second."""

    drive_v: float
    """Amplitude at its output."""
    at_s: float
    """When it was asked, on `time.monotonic`."""


def ended(why: Why, message: str, recorded: RecordingBegan | None) -> Ended:
    """The end of a run that was recorded there, if it was: with what is to be found on the disk."""
    if recorded is None:
        return Ended(why, message)
    session = recorded.session if recorded.session.is_file() else None
    return Ended(why, message, session, recorded.folder if recorded.folder.is_dir() else None)
