"""What was found of several files, as the JSON that the commands write."""

from functools import partial
from pathlib import Path

from PySide6.QtWidgets import QWidget

from gui.actions.together import Together
from gui.background.task import BackgroundTask, Progress
from gui.background.writing import Writing
from gui.files.pairing import PairedFile
from gui.widgets.asking import ask_save
from instrument.errors import BadInput
from instrument.facts.result import Result
from instrument.files.result_file import write_result

ENDING = ".json"


class Saving(Writing):
    """Asks where to, then writes."""

    def __init__(self, together: Together, owner: QWidget) -> None:
        super().__init__(owner)
        self._together, self._owner = together, owner

    def identification(self) -> None:
        """As `viscorig identify --json`."""
        self._ask("Save the identification", "identified", self._together.identified)

    def diagnosis(self) -> None:
        """As `viscorig diagnose --json`."""
        shown = self._together.diagnosed
        self._ask("Save the diagnosis", "diagnosed", shown.found if shown is not None else None)

    def save(self, found: Result, to: Path) -> None:
        """Write it; returns at once."""
        to = to if to.suffix.lower() == ENDING else to.with_name(to.name + ENDING)
        self.write(BackgroundTask(partial(_write, to, found, self._together.files), self))

    def _ask(self, title: str, name: str, found: Result | None) -> None:
        if found is None:
            return
        start = self._together.files[0].data.parent / f"{name}{ENDING}"
        ask_save(self._owner, title, str(start), f"Results (*{ENDING})", partial(self.save, found))


def _write(to: Path, found: Result, files: tuple[PairedFile, ...], _: Progress) -> Path:
    read = [path for one in files for path in (one.data, one.specimen) if path is not None]
    if to.exists() and any(path.exists() and to.samefile(path) for path in read):
        raise BadInput(f"{to}: what the result is of, expected another name")
    write_result(to, found)
    return to
