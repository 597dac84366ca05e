"""Files to be fitted together, asked for: all at once."""

from functools import partial
from pathlib import Path

from PySide6.QtCore import QMimeData
from PySide6.QtWidgets import QWidget

from gui.actions.together import Together
from gui.files.pairing import SPECIMEN_ENDING
from gui.widgets.asking import ask_open, ask_open_all
from instrument.interchange.given import SESSION_ENDINGS
from instrument.interchange.readers import foreign_endings

TOGETHER = "together"
"""The page's name, as `gui.pages` calls it."""
ENDINGS = tuple(dict.fromkeys((*SESSION_ENDINGS, ".csv", *foreign_endings())))
"""Of data that can be fitted together."""


HAMMER_ENDINGS = (*SESSION_ENDINGS, ".json")
"""Of what a hammer test is kept in."""


def ask_together(owner: QWidget, together: Together) -> None:
    """For more of them, beside the last ones."""
    start = str(together.files[-1].data.parent) if together.files else ""
    kinds = f"Sessions and data ({' '.join(f'*{ending}' for ending in ENDINGS)});;Everything (*)"
    ask_open_all(owner, "Files to fit together", start, kinds, together.add)


def ask_hammer(owner: QWidget, together: Together) -> None:
    """For the bare plate's hammer test."""
    near = together.hammer or next((one.data for one in together.files), None)
    kinds = f"Sessions and results ({' '.join(f'*{ending}' for ending in HAMMER_ENDINGS)});;Everything (*)"
    ask_open(owner, "Hammer test of the bare plate", str(near.parent) if near else "", kinds, together.strike)


def ask_specimen(owner: QWidget, together: Together, row: int | None) -> None:
    """For the specimen of one file, or of all; nothing where there are none."""
    if not together.files:
        return
    of = together.files[row or 0]
    near = of.specimen if of.specimen is not None else of.data
    title = "Specimen of all files" if row is None else f"Specimen of file {row + 1}, {of.data.name}"
    ask_open(owner, title, str(near.parent), "Specimen (*.toml)", partial(_pair, together, row))


def _pair(together: Together, row: int | None, specimen: Path) -> None:
    # The dialog stays open while files are taken away.
    if row is None or row < len(together.files):
        together.pair(row, specimen)


def paths_of(dropped: QMimeData) -> list[Path]:
    """Data and specimens among what was dropped."""
    paths = [Path(url.toLocalFile()) for url in dropped.urls() if url.isLocalFile()]
    return [path for path in paths if path.suffix.lower() in (*ENDINGS, SPECIMEN_ENDING)]
