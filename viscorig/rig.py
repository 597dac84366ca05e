"""A rig, real or simulated, and experiments run on it."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Self

from instrument.files.rig_file import RigDocument
from instrument.files.toml import read_document
from instrument.progress import bar
from instrument.run.experiment import run_experiment
from instrument.run.part import Part
from instrument.session.configuration import Experiment, read_whole_experiment
from viscorig.session import Session, load_session

_WHOLE: tuple[Part, ...] = ("hammer", "sweep")


@dataclass(frozen=True, repr=False)
class Rig:
    """The instruments of a RIG.toml; those with the address "simulated" are stood up for each run."""

    path: Path
    document: RigDocument
    """What the RIG.toml says, table by table."""

    @classmethod
    def from_file(cls, path: str | Path) -> Self:
        """Read a RIG.toml. Raises `BadInput`."""
        return cls(Path(path), read_document(Path(path), RigDocument))

    def __repr__(self) -> str:
        how = "simulated" if self.is_simulated else "real instruments"
        return f"<Rig: {self.document.name or self.path.stem}, {how}, {self.path}>"

    @property
    def is_simulated(self) -> bool:
        """Whether no real instrument is spoken to."""
        return self.document.is_simulated

    def run(
        self,
        experiment: str | Path,
        out: str | Path = ".",
        *,
        parts: Sequence[Part] = _WHOLE,
        resume: str | Path | None = None,
    ) -> Session:
        """Run an EXPERIMENT.toml on this rig, whatever rig it names; as `run` in all else."""
        on_this = replace(read_whole_experiment(Path(experiment)), rig=self.document, rig_path=self.path)
        return _run(on_this, out, parts, resume)


def run(
    experiment: str | Path,
    out: str | Path = ".",
    *,
    parts: Sequence[Part] = _WHOLE,
    resume: str | Path | None = None,
) -> Session:
    """Run an EXPERIMENT.toml on the rig it names, as `viscorig run` does; its session, kept in `out`.

    `parts` of "hammer" and "sweep"; `resume` is the folder of a run that was broken off. Whatever ends the
    run, the shaker is silent and what is complete is kept. Raises `BadInput`, `RigStopped`, and
    `StoppedByUser` when it is interrupted.
    """
    return _run(read_whole_experiment(Path(experiment)), out, parts, resume)


def _run(
    experiment: Experiment, out: str | Path, parts: Sequence[Part], resume: str | Path | None
) -> Session:
    folder = Path(resume) if resume is not None else None
    return load_session(
        run_experiment(experiment, Path(out), tuple(parts), resume=folder, progress=bar).session
    )
