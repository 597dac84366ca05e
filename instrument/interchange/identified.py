"""The law from a recorded session: its points, its specimen, its hammer test."""

from pydantic import ValidationError

from fitting.specimen import PlateSpecimen
from fitting.sweep import Sweep
from instrument.errors import BadInput
from instrument.files.hammer_file import HammerModes, accepted_modes
from instrument.files.toml import one_line
from instrument.finding.identification import Identified, identify
from instrument.interchange.files_of import files_of
from instrument.progress import Progress, quiet
from instrument.session.contents import Contents
from instrument.session.points import sweep_of


def identify_session(contents: Contents, progress: Progress = quiet) -> Identified:
    """Identify all points as `viscorig identify` does, jointly with the session's hammer test.

    What was read with a known mass, clamped anew, at another spot or struck is a file of its own under the
    law.

    Raises `BadInput` without points, `FittingError` where these points carry no law.
    """
    modes, sweep = session_modes(contents), session_sweep(contents)
    files = files_of(sweep, contents.measured, contents.specimen, contents.struck)
    return identify(files, progress=progress, hammer=modes)


def session_sweep(contents: Contents) -> Sweep:
    """Steps and sentinels, each at its commanded level. Raises `BadInput` where there are none."""
    if not contents.points:
        raise BadInput(f"{contents.path}: no point of a sweep in this session, expected a measured sweep")
    return sweep_of(contents.measured, [p.time_s for p in contents.points])


def session_modes(contents: Contents) -> HammerModes | None:
    """The hammer test's accepted modes, of a plate, if any: no fit of a beam takes them.

    Raises `BadInput` where they are beyond what can be used.
    """
    if contents.damping is None or not isinstance(contents.specimen, PlateSpecimen):
        return None
    try:
        return accepted_modes(contents.damping.result)
    except ValidationError as error:
        raise BadInput(f"{contents.path}: {one_line(error, prefix='hammer test: ')}") from None
