"""The journal of a running session: which parts are sealed, with checksums, and what is complete in them."""

import json
import os
import re
import shutil
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import IO

from pydantic import TypeAdapter

from instrument.errors import BadInput, system_words
from instrument.session.configuration import Configuration
from instrument.session.storage import checksum, seal

try:
    import fcntl
except ImportError:  # not on Windows: there two runs in one folder are not kept apart
    fcntl = None  # type: ignore[assignment]

JOURNAL = "journal.jsonl"
CONFIGURATION = "configuration.json"
_LOCK = "lock"
_PART = re.compile(r"part-\d{6}\.h5")


@dataclass(frozen=True)
class Entry:
    """One sealed part."""

    part: int
    file: str
    sha256: str
    events: int
    steps: tuple[int, ...]
    """Completed in it."""


@dataclass(frozen=True)
class Damage:
    """Sealed parts that are no longer whole, or come after one that is not."""

    part: int
    """Number of the first such part."""
    why: str
    """What is wrong with it."""
    parts: int
    """How many, with it."""
    steps: tuple[int, ...]
    """Completed in them, as far as the journal can be read."""

    @property
    def words(self) -> str:
        """What is lost, in a line."""
        after = self.parts - 1
        also = f" and {after} {'part' if after == 1 else 'parts'} after it" if after else ""
        return f"part {self.part} ({self.why}){also}, with {len(self.steps)} completed steps"


class SessionJournal:
    """The journal of one session folder."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self._lock: IO[str] | None = None

    def begin(self, configuration: Configuration) -> None:
        """Make the folder. Raises `BadInput` where there is one already."""
        try:
            self.folder.mkdir(parents=True)
        except FileExistsError:
            self.refuse_while_it_goes_on()
            raise BadInput(f"{self.folder}: exists already: --resume it, or 'viscorig recover' it") from None
        except OSError as error:
            raise BadInput(f"{self.folder}: {system_words(error)}") from None
        temporary = self.folder / (CONFIGURATION + ".tmp")
        try:
            temporary.write_text(configuration.model_dump_json(indent=1), encoding="utf-8")
            seal(temporary, self.folder / CONFIGURATION)
        except OSError as error:
            self.remove()
            raise BadInput(f"{self.folder}: {system_words(error)}") from None

    def lock(self) -> None:
        """One run at a time. Raises `BadInput` where another one goes on in this folder."""
        self._lock = (self.folder / _LOCK).open("w")
        if fcntl is None:
            return
        try:
            fcntl.flock(self._lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            self._lock.close()
            raise self._goes_on() from None

    def refuse_while_it_goes_on(self) -> None:
        """Raise `BadInput` while a run goes on in this folder; nothing is written into it."""
        try:
            lock = (self.folder / _LOCK).open()
        except OSError:
            return
        with lock:
            if fcntl is None:
                return
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except OSError:
                raise self._goes_on() from None

    def _goes_on(self) -> BadInput:
        return BadInput(f"{self.folder}: another run goes on in it, expected one at a time")

    def unlock(self) -> None:
        """Let another run in; also twice."""
        if self._lock is not None:
            self._lock.close()

    def remove(self) -> None:
        """The folder and all in it; the journal first, so that a half removed folder counts for nothing."""
        (self.folder / JOURNAL).unlink(missing_ok=True)
        shutil.rmtree(self.folder, ignore_errors=True)

    def add(self, entry: Entry) -> None:
        """A part is sealed: from here on it counts."""
        with (self.folder / JOURNAL).open("a", encoding="utf-8") as file:
            file.write(json.dumps(asdict(entry)) + "\n")
            file.flush()
            os.fsync(file.fileno())

    def configuration(self) -> Configuration:
        """What the session was begun with. Raises `BadInput`."""
        path = self.folder / CONFIGURATION
        try:
            return Configuration.model_validate_json(path.read_text(encoding="utf-8"))
        except OSError:
            what = f"no {CONFIGURATION}" if self.folder.is_dir() else "no such folder"
            what = "a file" if self.folder.is_file() else what
            raise BadInput(f"{self.folder}: {what}, expected the folder of a run that broke off") from None
        except ValueError as error:
            raise BadInput(f"{path}: {str(error).splitlines()[0]}") from None

    def entries(self) -> list[Entry]:
        """Parts that are there and whole, in order; the first that is not ends the list.

        A last line torn by the end of the program is left out. Raises `BadInput` where the journal cannot be
        read.
        """
        return self._read()[0]

    def damage(self) -> Damage | None:
        """What `entries` leaves out of what was sealed; None where it is all there.

        A last line torn by the end of the program is no damage: its part had not been told of. Raises
        `BadInput` where the journal cannot be read.
        """
        good, why, left = self._read()
        known = [entry for line in left if (entry := _entry(line)) is not None]
        if not left or not (known or len(left) > 1):
            return None
        steps = tuple(step for entry in known for step in entry.steps)
        return Damage(len(good) + 1, why, len(left), steps)

    def _read(self) -> tuple[list[Entry], str, list[str]]:
        """Whole parts, what is wrong with the next one, and the lines of the journal from it on."""
        path = self.folder / JOURNAL
        if not path.exists():
            return [], "", []
        good: list[Entry] = []
        try:
            lines = path.read_text(encoding="utf-8", errors="replace").splitlines()
        except OSError as error:
            raise BadInput(f"{path}: {system_words(error)}") from None
        for k, line in enumerate(lines):
            if why := self._fault(_entry(line), k + 1):
                return good, why, lines[k:]
            good.append(_ENTRY.validate_json(line))
        return good, "", []

    def _fault(self, entry: Entry | None, number: int) -> str:
        """Of a part and its place in the journal; empty where it is whole."""
        if entry is None or entry.part != number:
            return f"line {number} of {JOURNAL} is damaged"
        part = self.folder / entry.file
        if not part.is_file():
            return f"{entry.file} is missing"
        return "" if checksum(part) == entry.sha256 else f"{entry.file} is damaged"

    def truncate(self, entries: list[Entry]) -> None:
        """Keep these and nothing else: what was torn goes, so that new parts can follow."""
        temporary = self.folder / (JOURNAL + ".tmp")
        temporary.write_text("".join(json.dumps(asdict(e)) + "\n" for e in entries), encoding="utf-8")
        seal(temporary, self.folder / JOURNAL)
        kept = {e.file for e in entries}
        for path in self.folder.glob("part-*"):
            if path.name not in kept:
                path.unlink()


_ENTRY = TypeAdapter(Entry)


def _entry(line: str) -> Entry | None:
    try:
        entry = _ENTRY.validate_json(line)
    except ValueError:
        return None
    return entry if _PART.fullmatch(entry.file) else None
