"""Commented files to start from: each is valid as it stands."""

from pathlib import Path

from fitting.specimen import Kind
from instrument.errors import BadInput, system_words
from instrument.files.text import read_text

TEMPLATES = {
    "plate": Path(__file__).parent / "templates" / "plate.toml",
    "beam": Path(__file__).parent / "templates" / "beam.toml",
    "shear-pair": Path(__file__).parent / "templates" / "shear-pair.toml",
    "experiment": Path(__file__).parent / "templates" / "experiment.toml",
    "experiment-beam": Path(__file__).parent / "templates" / "experiment-beam.toml",
    "rig": Path(__file__).parents[1] / "simulated_case" / "rig.toml",
    "sensors": Path(__file__).parent / "templates" / "sensors.toml",
    "real-rig": Path(__file__).parent / "templates" / "rig.toml",
}
"""Kind of file, and where it is. A rig begins as the simulated one, which says how it becomes a real one."""
EXPERIMENT = ("specimen.toml", "rig.toml", "experiment.toml")
"""Files of an experiment on a real rig."""
SPECIMENS: dict[Kind, str] = {
    "plate": "experiment",
    "beam": "experiment-beam",
    "shear-pair": "experiment-beam",
}
"""Kinds of specimen, and the experiment that each begins with: only a plate is struck while it is bare."""


def write_real(folder: Path, specimen: Kind = "plate") -> Path:
    """The files of an experiment on a real rig; the experiment's path. Raises `BadInput`."""
    for name, kind in zip(EXPERIMENT, (specimen, "real-rig", SPECIMENS[specimen]), strict=True):
        write_new(kind, folder / name)
    return folder / "experiment.toml"


def write_new(kind: str, path: Path | None) -> Path:
    """Write one, by default as KIND.toml here. Raises `BadInput` where there is a file already."""
    where = path if path is not None else Path(f"{kind}.toml")
    if where.suffix.lower() != ".toml" and not where.exists():
        raise BadInput(f"{where}: ending {where.suffix!r}, expected .toml")
    try:
        with open(where, "x", encoding="utf-8") as file:
            file.write(read_text(TEMPLATES[kind]))
    except FileExistsError:
        raise BadInput(f"{where}: there is a file already, expected a new name") from None
    except OSError as error:
        raise BadInput(f"{where}: {system_words(error)}") from None
    return where
