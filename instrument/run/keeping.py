"""The folder of a running session: begun, taken up again, put together at the end, whatever the end is."""

import logging
import re
import shlex
from collections.abc import Sequence
from datetime import UTC, datetime
from itertools import count
from pathlib import Path

from instrument.errors import BadInput, is_full, system_words
from instrument.session.configuration import Configuration, Experiment
from instrument.session.journal import SessionJournal
from instrument.session.storage import part_events, write_session
from instrument.stream.derived import HitJudged, PointMeasured

log = logging.getLogger(__name__)


def open_journal(
    experiment: Experiment, out: Path, resume: Path | None, command: str = "run"
) -> tuple[SessionJournal, str]:
    """The folder of a new session, or of one to carry on, locked; and its name. Raises `BadInput`.

    `command`: which one begins it.
    """
    journal, name = _opened(experiment, out, resume, command)
    try:
        journal.lock()
        if resume is not None:
            if (lost := journal.damage()) is not None:
                log.warning("%s: lost is %s: measured again", resume, lost.words)
            journal.truncate(journal.entries())
    except OSError as error:
        journal.unlock()
        raise BadInput(f"{journal.folder}: {system_words(error)}") from None
    return journal, name


def _opened(
    experiment: Experiment, out: Path, resume: Path | None, command: str
) -> tuple[SessionJournal, str]:
    now = datetime.now(UTC)
    if resume is not None:
        journal = SessionJournal(resume)
        name = resume.name.removesuffix(".running")
        before = journal.configuration()
        _refuse_another(before, experiment.configuration(before.name, before.created_utc))
        return journal, name
    stem = re.sub(r"[^A-Za-z0-9_-]+", "-", experiment.path.stem).strip("-") or "session"
    name = _free(out, f"{stem}-{now:%Y%m%dT%H%M%SZ}")
    journal = SessionJournal(out / f"{name}.running")
    made = experiment.configuration(name, now.isoformat(timespec="seconds"))
    journal.begin(made.model_copy(update={"command": command, "experiment_file": experiment.path.name}))
    return journal, name


def _free(out: Path, name: str) -> str:
    """The name, numbered where a session has it already: a clock that was put back gives times again."""
    numbered = (name if k == 1 else f"{name}-{k}" for k in count(1))
    return next(one for one in numbered if not (out / f"{one}.h5").exists())


def finish_session(journal: SessionJournal, path: Path) -> int:
    """Put a session file together from what is sealed and remove the folder; how many parts there were.

    Where a sealed part is damaged the folder stays. Raises `BadInput` where nothing is sealed.
    """
    entries = journal.entries()
    if not entries:
        raise BadInput(f"{journal.folder}: nothing was completed, there is no session to put together")
    write_session(path, journal.configuration(), [journal.folder / e.file for e in entries])
    if (lost := journal.damage()) is None:
        journal.remove()
    else:
        log.warning("%s: lost is %s: the folder stays as it is", journal.folder, lost.words)
    return len(entries)


def kept(
    journal: SessionJournal,
    path: Path,
    begun: Sequence[str] = ("run", "EXPERIMENT.toml"),
    *,
    diagnosable: bool = False,
) -> str:
    """Put together what is complete, and say where it is and how to go on.

    `begun` is the command and its experiment; `diagnosable` where one goes on with the session alone. A run
    without anything complete leaves nothing. Where a person does not wait for it any more, the folder is what
    is kept.
    """
    try:
        entries = journal.entries()
        events = [e for entry in entries for e in part_events(journal.folder / entry.file)]
        if not any(isinstance(e, PointMeasured | HitJudged) for e in events):
            journal.remove()
            return "nothing was measured"
        write_session(path, journal.configuration(), [journal.folder / e.file for e in entries])
        steps = sum(len(e.steps) for e in entries)
        hits = sum(isinstance(e, HitJudged) for e in events)
        done = " and ".join(f"{n} {what}" for n, what in ((hits, "hits"), (steps, "steps")) if n)
        goes_on = ["diagnose", str(path)] if diagnosable else [*begun, "--resume", str(journal.folder)]
        again = shlex.join(["viscorig", *goes_on])
        return f"{done} kept in {path}; to go on: {again}"
    except KeyboardInterrupt:
        return f"what is complete is in {journal.folder}: {_recovery(journal)}"
    except (BadInput, OSError, ValueError, RuntimeError) as error:
        first = "make room, or copy that folder to another disk; then " if is_full(error) else ""
        why = system_words(error) if isinstance(error, OSError) else str(error)
        return (
            f"what is complete is in {journal.folder}, as no session could be written of it "
            f"({' '.join(why.split())}): {first}{_recovery(journal)}"
        )


def _recovery(journal: SessionJournal) -> str:
    """What a person types to have a session of what is complete."""
    return shlex.join(["viscorig", "recover", str(journal.folder)])


def _refuse_another(before: Configuration, now: Configuration) -> None:
    """A session is of one experiment; only where the instruments answer may differ."""
    for part in ("experiment", "specimen", "rig"):
        then, given = (getattr(c, part) for c in (before, now))
        if part == "rig":
            then, given = (r.anywhere() for r in (then, given))
        if then != given:
            raise BadInput(
                f"{before.name}: the {part} file is not the one this run was begun with: "
                "resume with it as it was, or begin a new run"
            )
