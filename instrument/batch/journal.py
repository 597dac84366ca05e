"""What is done, line by line on disk: a batch that was killed goes on after the last whole line.

A line carries a checksum: what was changed in it is no outcome, and its row is done again.
"""

import hashlib
import json
import os
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from types import TracebackType
from typing import Any

from instrument.batch.work import Outcome
from instrument.errors import BadInput, system_words

NAME = "batch.jsonl"


class OutcomeJournal:
    """Outcomes by key. Only where each begins in the file is held, not what it says. A context."""

    def __init__(self, folder: Path) -> None:
        self.path = folder / NAME
        try:
            folder.mkdir(parents=True, exist_ok=True)
            self._file = open(self.path, "a+b")  # noqa: SIM115
        except OSError as error:
            raise BadInput(f"{error.filename or folder}: {system_words(error)}") from None
        self._begins: dict[str, int] = {}
        try:
            self._look_through()
        except BadInput:
            self._file.close()
            raise

    def __enter__(self) -> "OutcomeJournal":
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        # Every row was flushed when it was kept; one that the disk did not take was said.
        with suppress(OSError):
            self._file.close()

    def __contains__(self, key: object) -> bool:
        return key in self._begins

    def __getitem__(self, key: str) -> Outcome:
        self._file.seek(self._begins[key])
        outcome: Outcome = json.loads(self._file.readline())["outcome"]
        return outcome

    def keep(self, key: str, outcome: Outcome) -> None:
        """Append, and return once the disk has it. Raises `BadInput` where it is full."""
        self._file.seek(0, os.SEEK_END)
        begins = self._file.tell()
        said = {"key": key, "outcome": outcome, "sha256": _digest(key, outcome)}
        line = json.dumps(said, allow_nan=False)
        try:
            self._file.write(line.encode() + b"\n")
            self._file.flush()
            os.fsync(self._file.fileno())
        except OSError as error:
            # Rows before it are kept: the same command goes on with the next one.
            raise BadInput(f"{self.path}: {system_words(error)}") from None
        self._begins[key] = begins

    def _look_through(self) -> None:
        """Where every whole line begins; what was torn by a kill is cut off."""
        end = 0
        for number, (begins, line) in enumerate(self._lines(), start=1):
            if not line.endswith(b"\n"):
                break
            key, again = self._read(number, line)
            if not again:
                self._begins[key] = begins
            end = begins + len(line)
        self._file.truncate(end)

    def _lines(self) -> Iterator[tuple[int, bytes]]:
        self._file.seek(0)
        begins = 0
        for line in self._file:
            yield begins, line
            begins += len(line)

    def _read(self, number: int, line: bytes) -> tuple[str, bool]:
        try:
            said: dict[str, Any] = json.loads(line)
            key, outcome = str(said["key"]), said["outcome"]
            again = bool(outcome["again"])
        except (ValueError, KeyError, TypeError, RecursionError):
            raise BadInput(
                f"{self.path}: line {number}: not a row of a batch, expected what 'viscorig batch' wrote; "
                "where it is damaged, remove it: its rows are done again"
            ) from None
        return key, again or said.get("sha256") != _digest(key, outcome)


def _digest(key: str, outcome: Any) -> str:
    """SHA-256 of a row, as it is written."""
    return hashlib.sha256(json.dumps([key, outcome]).encode()).hexdigest()
