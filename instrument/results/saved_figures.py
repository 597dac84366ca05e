"""Figures as files that say who has drawn them, so that they may be drawn anew."""

from collections.abc import Mapping
from pathlib import Path

from matplotlib.figure import Figure

from instrument.errors import BadInput, system_words

_BY = {"Software": "viscorig"}
"""What the head of a picture says: by it one of ours is known (`instrument.files.replaceable.FIGURE`)."""


def save_figures(drawn: Mapping[str, Figure], folder: Path, dpi: float) -> list[Path]:
    """Figures by the names of their files, as PNG. Raises `BadInput` where the folder cannot be written."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for name, figure in drawn.items():
            figure.savefig(folder / name, dpi=dpi, metadata=_BY)
    except OSError as error:
        raise BadInput(f"{folder}: {system_words(error)}") from None
    return [folder / name for name in drawn]
