"""The law from a recorded session: its points, its specimen, its hammer test."""

from dataclasses import dataclass

from pydantic import ValidationError

from fitting.identification.bare_plate import BarePlateFit
from fitting.specimen import Specimen
from fitting.sweep import Sweep
from instrument.errors import BadInput
from instrument.files.hammer_file import HammerModes, accepted_modes
from instrument.files.toml import one_line
from instrument.models.identification import Identified, identify
from instrument.progress import Progress, quiet
from instrument.session.contents import Contents
from instrument.session.points import sweep_of


@dataclass(frozen=True)
class SessionFit:
    """An identification and what went into it."""

    identified: Identified
    sweep: Sweep
    specimen: Specimen
    bare: BarePlateFit | None


def identify_session(contents: Contents, progress: Progress = quiet) -> SessionFit:
    """As the live identification does: all points, jointly with the session's hammer test.

    Raises `BadInput` without points, `FittingError` where these points carry no law.
    """
    specimen, modes = contents.specimen, session_modes(contents)
    sweep = session_sweep(contents, specimen)
    found = identify(sweep, specimen, "direct", progress, modes)
    return SessionFit(found, sweep, specimen, found.bare)


def session_sweep(contents: Contents, specimen: Specimen) -> Sweep:
    """Steps and sentinels, each at its commanded level. Raises `BadInput` where there are none."""
    if not contents.points:
        raise BadInput(f"{contents.path}: no point of a sweep in this session, expected a measured sweep")
    return sweep_of(contents.measured, [p.time_s for p in contents.points])


def session_modes(contents: Contents) -> HammerModes | None:
    """The hammer test's accepted modes, if any. Raises `BadInput` where they are beyond what can be used."""
    if contents.damping is None:
        return None
    try:
        return accepted_modes(contents.damping.result)
    except ValidationError as error:
        raise BadInput(f"{contents.path}: {one_line(error, prefix='hammer test: ')}") from None
