"""Several files under one law: identified, and diagnosed, in processes of their own.

Nothing of it is recorded. Material and Diagnosis show it in place of a session's own while it leads.
"""

from collections.abc import Mapping, Sequence
from pathlib import Path

from PySide6.QtCore import QObject, Signal

from gui.actions.rediagnosis import DiagnosisAsked, Rediagnosis, ShownDiagnosis
from gui.background.one_command import OneCommand
from gui.files.file_stamp import Stamp, stamp_of
from gui.files.pairing import PairedFile, arguments_of, fault_of, paired, with_specimen
from instrument.facts.identification import IdentificationResult
from instrument.facts.modal import ModalResult

Fitted = IdentificationResult | ModalResult
"""Of sweeps and sessions, or of tables of modes."""


class Together(QObject):
    """The files chosen, and what was found of them.

    Parameters
    ----------
    decline : tuple of str
        Effects that diagnoses of them leave out.

    Signals
    -------
    chosen
        Files, specimens or a hammer test, before anything is said of them.
    changed
        Other files, another result, or work began or ended.
    began
        Work was asked for.
    progressed
        What is being worked at, and the fraction of it that is done.
    failed
        One line.
    specimen_chosen
        Data and the specimen that they are of, to be remembered.
    """

    chosen = Signal()
    changed = Signal()
    began = Signal()
    progressed = Signal(str, float)
    failed = Signal(str)
    specimen_chosen = Signal(Path, Path)

    def __init__(
        self, rediagnosis: Rediagnosis, parent: QObject | None = None, *, decline: tuple[str, ...] = ()
    ) -> None:
        super().__init__(parent)
        self.files: tuple[PairedFile, ...] = ()
        self.hammer: Path | None = None
        """The test of the bare plate that all files are of: a session that has one, or a command's JSON."""
        self.known: dict[Path, Path] = {}
        """Specimens that data had before."""
        self.identified: Fitted | None = None
        self.diagnosed: ShownDiagnosis | None = None
        self.leads = False
        """Whether Material and Diagnosis show this."""
        self.failure = ""
        """Why the last identification of these files came to nothing."""
        self._leads_then = False
        """Whether what is being identified is to."""
        self._stamps: dict[Path, Stamp | None] = {}
        """Of the files that results are of, as they were looked at."""
        self._rediagnosis = rediagnosis
        self._decline = decline
        self._then_diagnose = False
        self._command = OneCommand(self)
        self._command.done.connect(self._done)
        self._command.failed.connect(self._failed)
        self._command.progressed.connect(self.progressed)
        rediagnosis.changed.connect(self._diagnosis_changed)
        rediagnosis.progressed.connect(self._diagnosis_progressed)

    @property
    def running(self) -> bool:
        """Whether something of these files is being computed."""
        return self._command.running or self._diagnosing

    @property
    def asked(self) -> DiagnosisAsked:
        """The diagnosis of the files chosen; there has to be one."""
        first, *further = self.files
        return DiagnosisAsked(
            first.data, first.specimen, decline=self._decline, further=tuple(further), hammer=self.hammer
        )

    @property
    def work(self) -> str:
        """What is being computed, in a word; empty for nothing."""
        return "identifying" if self._command.running else "diagnosing" if self._diagnosing else ""

    @property
    def shown(self) -> Fitted | None:
        """The fit, where it leads."""
        return self.identified if self.leads else None

    def remember(self, known: Mapping[Path, Path]) -> None:
        """Specimens that data had in earlier windows."""
        self.known.update(known)

    # The files

    def add(self, data: Sequence[Path]) -> None:
        """More of them, each once, with the specimen that is likeliest."""
        self.chosen.emit()
        self._choose(paired(data, self.files, self.known))
        self.look_again()

    def look_again(self) -> None:
        """At files that were written anew: what was found of those before is not theirs."""
        before, self._stamps = self._stamps, self._stamps_now()
        anew = [path.name for path, stamp in self._stamps.items() if before.get(path, stamp) != stamp]
        if anew:
            lost = self.identified is not None or self.running
            self._let_go_of_found()
            if lost:
                self.failed.emit(f"{', '.join(anew)}: written anew, what was found before is let go of")

    def stamps(self, file: PairedFile) -> tuple[Stamp | None, ...]:
        """Of data and specimen, as they were looked at last."""
        return tuple(self._stamps.get(path) for path in (file.data, file.specimen) if path is not None)

    def pair(self, row: int | None, specimen: Path) -> None:
        """A specimen for one file, or for all."""
        self.chosen.emit()
        files = with_specimen(self.files, row, specimen)
        for one, before in zip(files, self.files, strict=True):
            if one != before:
                self.known[one.data.resolve()] = specimen.resolve()
                self.specimen_chosen.emit(one.data.resolve(), specimen.resolve())
        self._choose(files)

    def remove(self, row: int) -> None:
        """Take the file at a row out of the list."""
        self.chosen.emit()
        self._choose((*self.files[:row], *self.files[row + 1 :]))

    def move(self, row: int, by: int) -> None:
        """Move the file at a row up (-1) or down (1)."""
        files, to = list(self.files), row + by
        if 0 <= to < len(files):
            files[row], files[to] = files[to], files[row]
            self._choose(tuple(files))

    def strike(self, hammer: Path | None) -> None:
        """With this hammer test of the bare plate, or without one: what was found is of other data."""
        self.chosen.emit()
        if hammer != self.hammer:
            self.cancel()
            self.hammer = hammer
            self._stamps = self._stamps_now()
            self._let_go_of_found()

    # The work

    def identify(self) -> None:
        """One law of all of them."""
        self.look_again()
        self._begin(then_diagnose=False)

    def diagnose(self) -> None:
        """What one law cannot explain; the law first, where it is not there yet."""
        self.look_again()
        if self.identified is None:
            self._begin(then_diagnose=True)
        elif not fault_of(self.files):
            self._diagnose()

    def cancel(self) -> None:
        """What is being computed is not wanted; what is there stays."""
        self._then_diagnose = False
        if self._diagnosing:
            self._rediagnosis.cancel()
        if self._command.running:
            self._command.drop()
            self.changed.emit()

    def lead(self) -> None:
        """Show it on Material and Diagnosis again."""
        if self.identified is None:
            return
        self.leads = True
        if self.diagnosed is not None:
            self._rediagnosis.show(self.diagnosed)
        self.changed.emit()

    def let_go(self) -> None:
        """Another session is shown; what was found, or is being looked for, is kept here."""
        self.leads = self._leads_then = self._then_diagnose = False
        if self._diagnosing:
            self._rediagnosis.cancel()
            self.failed.emit("The diagnosis of several files was ended: another session is shown.")
        self.changed.emit()

    def close(self) -> None:
        """Let go of everything."""
        self._command.drop()

    # Inside

    @property
    def _diagnosing(self) -> bool:
        asked = self._rediagnosis.asked
        return self._rediagnosis.running and asked is not None and asked.files == self.files

    def _choose(self, files: tuple[PairedFile, ...]) -> None:
        """Others than before: what was found is not theirs."""
        if files == self.files:
            return
        self.cancel()
        self.files = files
        self._stamps = self._stamps_now()
        self._let_go_of_found()

    def _let_go_of_found(self) -> None:
        self.cancel()
        led = self.leads
        self.identified, self.diagnosed, self.leads, self.failure = None, None, False, ""
        if led:
            self._rediagnosis.forget()
        self.changed.emit()

    def _stamps_now(self) -> dict[Path, Stamp | None]:
        paths = [path for one in self.files for path in (one.data, one.specimen)]
        return {path: stamp_of(path) for path in (*paths, self.hammer) if path is not None}

    def _begin(self, *, then_diagnose: bool) -> None:
        if fault_of(self.files):
            return
        self.cancel()
        self.failure = ""
        self._then_diagnose, self._leads_then = then_diagnose, True
        # That of modes first: all it must have, its modes, a sweep's has not; the other way it would do.
        results = (ModalResult, IdentificationResult)
        self._command.start(["identify", *arguments_of(self.files, self.hammer)], results)
        self.began.emit()
        self.changed.emit()

    def _diagnose(self) -> None:
        self._rediagnosis.start(self.asked)

    def _done(self, found: object) -> None:
        assert isinstance(found, Fitted)
        self.identified, self.diagnosed, self.leads = found, None, self._leads_then
        if self.leads:
            # What was shown is of other data, or of the law before this one.
            self._rediagnosis.forget()
        if self._then_diagnose:
            self._then_diagnose = False
            self._diagnose()
        self.changed.emit()

    def _failed(self, message: str) -> None:
        self._then_diagnose, self.failure = False, message
        self.changed.emit()
        self.failed.emit(message)

    def _diagnosis_changed(self) -> None:
        found = self._rediagnosis.found
        if found is not None and found.asked is not None and found.asked.files == self.files:
            self.diagnosed, self.leads = found, self.identified is not None
        elif found is not None or (self.diagnosed is not None and not self._rediagnosis.running):
            # Somebody looks at other data, or went back to what is recorded.
            self.leads = False
        self.changed.emit()

    def _diagnosis_progressed(self, what: str, fraction: float) -> None:
        if self._diagnosing:
            self.progressed.emit(what, fraction)
