"""The journal of a running session: which parts are sealed, with checksums, and what is complete in them."""

import json
import os
from dataclasses import asdict, dataclass
from pathlib import Path

from instrument.errors import BadInput
from instrument.session.configuration import Configuration
from instrument.session.storage import checksum, seal

JOURNAL = "journal.jsonl"
CONFIGURATION = "configuration.json"


@dataclass(frozen=True)
class Entry:
    """One sealed part."""

    part: int
    file: str
    sha256: str
    events: int
    steps: tuple[int, ...]
    """Completed in it."""


class Journal:
    """Of one session folder."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def begin(self, configuration: Configuration) -> None:
        """Make the folder. Raises `BadInput` where there is one already."""
        try:
            self.folder.mkdir(parents=True)
        except FileExistsError:
            raise BadInput(f"{self.folder}: exists already: --resume it, or 'viscorig recover' it") from None
        except OSError as error:
            raise BadInput(f"{self.folder}: {error.strerror or error}") from None
        temporary = self.folder / (CONFIGURATION + ".tmp")
        temporary.write_text(configuration.model_dump_json(indent=1), encoding="utf-8")
        seal(temporary, self.folder / CONFIGURATION)

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
            raise BadInput(f"{self.folder}: no {CONFIGURATION}, expected the folder of a run") from None
        except ValueError as error:
            raise BadInput(f"{path}: {str(error).splitlines()[0]}") from None

    def entries(self) -> list[Entry]:
        """Parts that are there and whole, in order; the first that is not ends the list.

        A last line torn by the end of the program is left out.
        """
        path = self.folder / JOURNAL
        if not path.exists():
            return []
        good: list[Entry] = []
        for line in path.read_text(encoding="utf-8", errors="replace").splitlines():
            entry = _entry(line)
            if entry is None or entry.part != len(good) + 1:
                break
            part = self.folder / entry.file
            if part.parent != self.folder or not part.exists() or checksum(part) != entry.sha256:
                break
            good.append(entry)
        return good

    def truncate(self, entries: list[Entry]) -> None:
        """Keep these and nothing else: what was torn goes, so that new parts can follow."""
        temporary = self.folder / (JOURNAL + ".tmp")
        temporary.write_text("".join(json.dumps(asdict(e)) + "\n" for e in entries), encoding="utf-8")
        seal(temporary, self.folder / JOURNAL)
        kept = {e.file for e in entries}
        for path in self.folder.glob("part-*"):
            if path.name not in kept:
                path.unlink()


def _entry(line: str) -> Entry | None:
    try:
        facts = json.loads(line)
        return Entry(**{**facts, "steps": tuple(facts["steps"])})
    except (ValueError, TypeError, KeyError):
        return None
