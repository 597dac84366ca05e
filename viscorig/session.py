"""A recorded session: what was measured, and what was found while it was."""

import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from instrument.facts.session_result import SessionResult
from instrument.interchange.identified import session_sweep
from instrument.interchange.specimen_toml import specimen_toml
from instrument.results.session_result import recorded_result
from instrument.session.contents import Contents, contents_of
from instrument.session.points import is_one_mounting
from instrument.session.storage import SessionFile
from instrument.stream.derived import DiagnosisFound, FitUpdated
from viscorig.diagnosis import Diagnosis
from viscorig.hammer import Damping
from viscorig.identification import Identification
from viscorig.shown import Columns, Shown
from viscorig.specimen import Specimen
from viscorig.sweep import Sweep, as_sweep

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@dataclass(frozen=True, repr=False)
class Session(Shown):
    """A recorded session, read whole and its file closed. What was not measured or not found is None."""

    path: Path
    name: str
    reads: str
    """What the rig's laser sees: `absolute` or `relative` velocity."""
    specimen: Specimen
    """The specimen that was measured, read as the rig's laser does."""
    sweep: Sweep | None
    """The velocities at steps and sentinels, each over its level."""
    hammer: Damping | None
    identification: Identification | None
    """The last identification of the run itself, as it was recorded."""
    diagnosis: Diagnosis | None
    remarks: tuple[str, ...]
    """Why there is no law or no diagnosis, where one was tried."""
    has_mountings: bool
    """Whether the run had known masses put on the plate: points with and without them."""
    result: SessionResult
    """The law to sign: that after the diagnosis, with its verdict and where it holds."""

    @property
    def good_hammer(self) -> Damping | None:
        """The hammer test where a mode of it was accepted: then it takes part in fits."""
        return self.hammer if self.hammer is not None and self.hammer.frequency_hz.size else None

    def as_dict(self) -> dict[str, Any]:
        """The facts of `viscorig run`."""
        found = {"damping": self.hammer, "identify": self.identification, "diagnose": self.diagnosis}
        return {
            "session": str(self.path),
            "points": len(self.sweep) if self.sweep is not None else 0,
            **{key: one.as_dict() if one is not None else None for key, one in found.items()},
            "result": self.result.as_json() if self.sweep is not None else None,
        }

    def to_numpy(self) -> Columns:
        """The points of the sweep; empty where there is none."""
        return self.sweep.to_numpy() if self.sweep is not None else {}

    def lines(self) -> list[str]:
        """Name, plate, and what each part gave."""
        parts = [p.lines()[0] for p in (self.specimen, self.hammer, self.sweep) if p is not None]
        result = [f"result: {self.result.words}"] if self.sweep is not None else []
        return [f"session {self.name}", *parts, *result, *self.remarks]

    def plot(self, ax: "Axes | None" = None) -> "Axes":
        """The sweep, or the hammer test where nothing else was measured; the axes."""
        from viscorig.plots import axes_of

        part = self.sweep or self.hammer
        return part.plot(ax) if part is not None else axes_of(ax)


def load_session(path: str | Path) -> Session:
    """Read a session (.h5). Raises `BadInput` where it is none, or damaged."""
    with SessionFile(Path(path)) as file:
        return _session(contents_of(file, with_hits=False))


def _session(contents: Contents) -> Session:
    specimen = Specimen(**tomllib.loads(specimen_toml(contents)))
    fit, diagnosis = contents.fit, contents.diagnosis
    return Session(
        path=contents.path,
        name=contents.configuration.name,
        reads=contents.configuration.rig.vibrometer.reads,
        specimen=specimen,
        sweep=as_sweep(session_sweep(contents)) if contents.points else None,
        hammer=Damping(contents.damping.result) if contents.damping is not None else None,
        identification=Identification(fit.result, specimen) if fit and fit.result else None,
        diagnosis=Diagnosis(diagnosis.result) if diagnosis and diagnosis.result else None,
        has_mountings=not is_one_mounting(contents.measured) or bool(contents.struck),
        result=recorded_result(contents),
        remarks=(*_why("no law identified", fit), *_why("no diagnosis", diagnosis)),
    )


def _why(nothing: str, found: FitUpdated | DiagnosisFound | None) -> list[str]:
    return [f"{nothing}: {found.message}"] if found is not None and found.message else []
