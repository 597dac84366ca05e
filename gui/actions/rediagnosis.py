"""A diagnosis made here: of data that has none, or again with effects accepted and declined by hand.

Nothing of it is recorded. Pages show it in place of the session's own until it is let go of.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

from PySide6.QtCore import QObject, Signal

from fitting.diagnosis.verdict.names import split
from gui.background.one_command import OneCommand
from gui.files.pairing import PairedFile, arguments_of
from gui.files.short_name import short_name
from gui.state import SessionState
from instrument.facts.diagnosis import DiagnosisResult
from instrument.results.diagnosis_words import with_verdict

AMBIGUOUS = "ambiguous"
"""Of a law beside which others explain the data as well."""


@dataclass(frozen=True)
class DiagnosisAsked:
    """What is to be diagnosed, and how."""

    data: Path
    specimen: Path | None = None
    """A session has its own."""
    accept: tuple[str, ...] | None = None
    """Fitted on a person's word, nothing searched for; empty for no effect at all."""
    decline: tuple[str, ...] = field(default=())
    """Left out of the search."""
    further: tuple[PairedFile, ...] = ()
    """Files that are diagnosed together with the first one."""
    hammer: Path | None = None
    """The bare plate's hammer test; a session has its own."""

    @property
    def files(self) -> tuple[PairedFile, ...]:
        """All of them, each with its specimen."""
        return PairedFile(self.data, self.specimen), *self.further

    @property
    def of_session(self) -> bool:
        """Whether it is of a session as it stands, and of nothing else."""
        return self.specimen is None and not self.further

    @property
    def by_hand(self) -> bool:
        """Whether a person decided anything."""
        return self.accept is not None or bool(self.decline)

    @property
    def arguments(self) -> list[str]:
        """Arguments of the command line that asks for it."""
        said = ["diagnose", *arguments_of(self.files, self.hammer)]
        if self.accept is not None:
            said += [f"--accept={name}" for name in self.accept or ("none",)]
        return said + [f"--without={name}" for name in self.decline]


@dataclass(frozen=True)
class ShownDiagnosis:
    """A diagnosis as pages show it."""

    found: DiagnosisResult
    origin: str
    """Where it comes from, for people."""
    asked: DiagnosisAsked | None = None
    """None for the recorded one."""

    @property
    def by_hand(self) -> bool:
        """Whether a person decided anything."""
        return self.asked is not None and self.asked.by_hand

    def is_of(self, session: Path | None) -> bool:
        """Whether it is of the session that is open, as it stands: data with equal plans look alike."""
        return self.asked is None or (self.asked.of_session and self.asked.data == session)

    def in_legend(self, title: str) -> str:
        """With what is to be known of its law: also that others explain the data as well as the one named."""
        said = with_verdict(f"{title}{', by hand' if self.by_hand else ''}", self.found)
        accepted = self.asked is not None and self.asked.accept is not None
        return f"{said} ({AMBIGUOUS})" if self.found.verdict == "ambiguous" and not accepted else said


class Rediagnosis(QObject):
    """One at a time, in a process of its own.

    Signals
    -------
    changed
        Another diagnosis is to be shown, or work began or ended.
    began
        One was asked for.
    progressed
        What is being worked at, and the fraction of it that is done.
    failed
        One line.
    """

    changed = Signal()
    began = Signal()
    progressed = Signal(str, float)
    failed = Signal(str)

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.found: ShownDiagnosis | None = None
        self._searched: dict[tuple[PairedFile, ...], DiagnosisResult] = {}
        """The last whole search of each file, or of several, made here."""
        self._asked: DiagnosisAsked | None = None
        self._command = OneCommand(self)
        self._command.done.connect(self._done)
        self._command.failed.connect(self._failed)
        self._command.progressed.connect(self.progressed)

    @property
    def running(self) -> bool:
        """Whether one is being made."""
        return self._command.running

    @property
    def asked(self) -> DiagnosisAsked | None:
        """The last that was asked for."""
        return self._asked

    def shown(self, state: SessionState | None) -> ShownDiagnosis | None:
        """What pages show: the one made here, else the session's own; None where there is neither."""
        if self.found is not None:
            return self.found
        own = _recorded(state)
        return ShownDiagnosis(own, "recorded with the session") if own is not None else None

    def ranking(self, state: SessionState | None) -> DiagnosisResult | None:
        """The last whole search of what is shown: an effect fitted by hand has no others beside it."""
        shown = self.shown(state)
        if shown is None or shown.asked is None:
            return shown.found if shown is not None else None
        own = _recorded(state) if shown.asked.of_session else None
        return self._searched.get(shown.asked.files) or own or shown.found

    def start(self, asked: DiagnosisAsked) -> None:
        """Make it; whatever was being made is let go of."""
        self._asked = asked
        self._command.start(asked.arguments, DiagnosisResult)
        self.began.emit()
        self.changed.emit()

    def cancel(self) -> None:
        """What is being made is not wanted; what is shown stays."""
        if self.running:
            self._command.drop()
            self.changed.emit()

    def show(self, shown: ShownDiagnosis) -> None:
        """One that was made here before."""
        self._command.drop()
        self.found = shown
        self.changed.emit()

    def let_go_of(self, path: Path) -> None:
        """A file that was written anew: what was found of it is another's."""
        of = self._asked.files if self._asked is not None else ()
        self._searched = {files: it for files, it in self._searched.items() if not _has(files, path)}
        if _has(of, path) and (self.running or self.found is not None):
            self.forget()

    def let_go(self) -> None:
        """Another session is shown. What was being looked for of the one before is ended, and it is said."""
        asked = self._asked
        if self.running and asked is not None and not asked.further:
            name = short_name(asked.data.name)
            self.failed.emit(f"The diagnosis of {name} was ended: another session is shown.")
        self.forget()

    def forget(self) -> None:
        """Back to what is recorded."""
        self._command.drop()
        self.found = None
        self._searched.clear()
        self.changed.emit()

    def close(self) -> None:
        """Let go of everything."""
        self._command.drop()

    def _done(self, found: DiagnosisResult) -> None:
        assert self._asked is not None
        self.found = ShownDiagnosis(found, _origin(self._asked), self._asked)
        if self._asked.accept is None:
            self._searched[self._asked.files] = found
        self.changed.emit()

    def _failed(self, message: str) -> None:
        self.changed.emit()
        self.failed.emit(message)


def _has(files: Sequence[PairedFile], path: Path) -> bool:
    return any(one.data == path for one in files)


def _recorded(state: SessionState | None) -> DiagnosisResult | None:
    """The session's own."""
    own = state.contents.diagnosis if state is not None else None
    return own.result if own is not None else None


def _origin(asked: DiagnosisAsked) -> str:
    of = f"{len(asked.files)} files" if asked.further else short_name(asked.data.name)
    if not asked.by_hand:
        return f"made here of {of}, not recorded"
    return "by hand, not recorded" if asked.of_session else f"{of}: by hand, not recorded"


def effects_of(names: Sequence[str]) -> tuple[str, ...]:
    """Single effects of candidates' names: a pair is two."""
    return tuple(dict.fromkeys(one for name in names for one in split(name)))
