"""Who goes along with a run: told of everything at once, and given the rig to equip it."""

from contextlib import AbstractContextManager, nullcontext
from pathlib import Path

from instrument.check.piece import Region, TimedPiece
from instrument.run.rig import Rig
from instrument.stream.event import Event


class Companion:
    """Does nothing; subclasses do. None of the methods may raise, or wait: the run waits for them."""

    def recording(self, folder: Path, session: Path) -> None:
        """The run is recorded in this folder, which becomes that session file at the end."""

    def planned(self, work: tuple[TimedPiece, ...], regions: tuple[Region, ...]) -> None:
        """All there is to do and how long each piece is going to take; the regions that are swept."""

    def happened(self, event: Event) -> None:
        """Told of an event when it happens, on the thread it happens on; it may not be on the disk yet.

        A run that is carried on tells what it has from before first, without its blocks.
        """

    def with_rig(self, rig: Rig) -> AbstractContextManager[Rig]:
        """The rig to use instead of this one, for as long as it is open."""
        return nullcontext(rig)
