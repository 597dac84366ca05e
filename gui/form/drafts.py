"""An experiment's file and those it names, edited together. No Qt."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from gui.files.file_stamp import Stamp, stamp_of
from gui.form.draft import Draft
from gui.form.fields import FILES, Field
from instrument.errors import BadInput
from instrument.files.experiment_file import ExperimentDocument
from instrument.files.rig_file import RigDocument
from instrument.files.text import read_text


@dataclass
class Drafts:
    """Of an experiment and the files it names."""

    experiment: Draft
    rig: Draft | None
    specimen: Draft | None
    problems: tuple[str, ...] = ()
    """Why one of the named files is missing here."""
    _beside: dict[Path, Stamp | None] = field(default_factory=dict)
    """Files that these name and no form shows, as they were looked at."""

    @classmethod
    def of(cls, path: Path) -> "Drafts":
        """Read them. Raises `BadInput` where the experiment itself cannot be edited."""
        experiment = Draft.of(path, ExperimentDocument)
        found: dict[str, Draft | None] = {}
        problems: list[str] = []
        missing: dict[Path, Stamp | None] = {}
        for name in ("rig", "specimen"):
            said = experiment.value((name,))
            found[name] = None
            if not isinstance(said, str):
                continue
            named = path.parent / said
            stamp = stamp_of(named)
            try:
                found[name] = Draft.of(named, RigDocument) if name == "rig" else Draft.of_specimen(named)
            except BadInput as error:
                problems.append(str(error))
                missing[named] = stamp
        drafts = cls(experiment, found["rig"], found["specimen"], tuple(problems), missing)
        drafts._look_beside()
        return drafts

    @property
    def all(self) -> dict[str, Draft]:
        """The drafts that there are, by what they describe."""
        drafts = {"experiment": self.experiment, "rig": self.rig, "specimen": self.specimen}
        return {name: draft for name, draft in drafts.items() if draft is not None}

    @property
    def changed(self) -> bool:
        """Whether one of them differs from its file."""
        return any(draft.changed for draft in self.all.values())

    @property
    def changed_elsewhere(self) -> list[Path]:
        """Files that another program has written, or taken away, since they were read or saved here."""
        return [path for path, stamp in self._stamps.items() if stamp_of(path) != stamp]

    @property
    def files(self) -> list[Path]:
        """All of them, those that no form shows too."""
        return list(self._stamps)

    @property
    def _stamps(self) -> dict[Path, Stamp | None]:
        return self._beside | {draft.path: draft.stamp for draft in self.all.values()}

    def _look_beside(self) -> None:
        """At tables and sensors: a dry run is of them too."""
        for draft in filter(None, (self.rig, self.specimen)):
            for named in _names_in(draft.plain()):
                path = draft.path.parent / named
                self._beside.setdefault(path, stamp_of(path))

    @property
    def fault_count(self) -> int:
        """In all of them."""
        return sum(len(draft.faults()) for draft in self.all.values()) + len(self.problems)

    def parts(self) -> tuple[str, ...]:
        """Which parts the experiment has."""
        return tuple(p for p in ("hammer", "sweep") if isinstance(self.experiment.value((p,)), dict))

    def save(self) -> Path:
        """Each to its file; the experiment's path. Raises `BadInput`."""
        for draft in self.all.values():
            if draft.changed:
                draft.save()
        self._look_beside()
        return self.experiment.path

    def save_as(self, path: Path) -> Path:
        """All three beside each other, under the names they have. Raises `BadInput`."""
        if path.resolve() == self.experiment.path.resolve():
            return self.save()
        beside: dict[str, Path] = {}
        for name, draft in self.all.items():
            if name == "experiment":
                continue
            to = path.parent / draft.path.name
            if to.resolve() != draft.path.resolve() and to.exists() and read_text(to) != draft.text:
                raise BadInput(f"{to}: is there already and is another {name}: choose another folder")
            beside[name] = to
        for name, to in beside.items():
            self.all[name].save(to)
            self.experiment.write((name,), Field(name, "text"), to.name)
        self.experiment.save(path)
        self._look_beside()
        return path


def _names_in(values: Any) -> Iterator[str]:
    """Files that these values name, at any depth."""
    if isinstance(values, dict):
        yield from (said for key, said in values.items() if key in FILES and isinstance(said, str) and said)
        values = list(values.values())
    for inside in values if isinstance(values, list) else ():
        yield from _names_in(inside)
