"""`viscorig recover`: the session of a run that was killed."""

from pathlib import Path

import click

from instrument.cli.options import json_option
from instrument.cli.output import Output
from instrument.errors import BadInput, is_full, system_words
from instrument.facts.written import RecoverResult
from instrument.session.journal import CONFIGURATION, SessionJournal
from instrument.session.storage import SessionFile, part_events, write_session
from instrument.stream.derived import HitJudged


@click.command()
@click.argument("folder", type=click.Path(path_type=Path))
@json_option
def recover(folder: Path, json_path: str | None) -> None:
    """Put together the session of a run that was killed, from its FOLDER (NAME.running).

    The folder above will do where there is one such folder in it.

    The folder stays, so that the run can be carried on with --resume. A run that still goes on is left alone.
    """
    out = Output(json_path)
    folder = _of_run(folder)
    journal = SessionJournal(folder)
    configuration = journal.configuration()
    journal.refuse_while_it_goes_on()
    entries, lost = journal.entries(), journal.damage()
    if not entries:
        why = f"nothing is whole, lost is {lost.words}" if lost is not None else "nothing was completed"
        raise BadInput(f"{folder}: {why}, there is no session to put together")
    path = folder.parent / f"{folder.name.removesuffix('.running')}.h5"
    if path.exists():
        with SessionFile(path) as file:
            there = file.part_count
        if there > len(entries):
            raise BadInput(f"{path}: holds {there} parts, the folder only {len(entries)}: move it away first")
    try:
        write_session(path, configuration, [folder / e.file for e in entries])
    except OSError as error:
        more = f": make room, or copy {folder} to another disk and recover it there" if is_full(error) else ""
        raise BadInput(f"{path}: {system_words(error)}{more}") from None
    steps = [step for e in entries for step in e.steps]
    hits = sum(isinstance(e, HitJudged) for entry in entries for e in part_events(folder / entry.file))
    out.say(f"{hits} hits and {len(steps)} completed steps in {len(entries)} parts, all whole: {path}")
    if lost is not None:
        out.say(f"lost: {lost.words}: what comes after a damaged part is not put together")
        out.say(
            "--resume removes these parts and measures their steps again: copy the folder first to keep them"
        )
    # Of an older version: a whole run sweeps only after its hammer test, without one it was a sweep alone.
    alone = configuration.experiment.hammer is not None and bool(steps) and hits == 0
    command = configuration.command or ("sweep" if alone else "run")
    out.say(f"to go on: {configuration.resumed(command, folder)}")
    out.result(
        RecoverResult(
            session=str(path),
            parts=len(entries),
            hits=hits,
            steps=tuple(steps),
            lost_parts=lost.parts if lost is not None else 0,
            lost_steps=lost.steps if lost is not None else (),
        )
    )


def _of_run(folder: Path) -> Path:
    """The folder of a run: itself, or the only one in it. Raises `BadInput` where it is not clear which."""
    if not folder.is_dir() or (folder / CONFIGURATION).exists():
        return folder
    inside = sorted(f for f in folder.glob("*.running") if f.is_dir())
    if len(inside) > 1:
        named = ", ".join(f.name for f in inside)
        raise BadInput(f"{folder}: holds {len(inside)} runs ({named}): say which")
    return inside[0] if inside else folder
