"""The law from a recorded session: its points, its specimen, its hammer test."""

from dataclasses import dataclass

from pydantic import ValidationError

from fitting.identification.bare_plate import BarePlateFit
from fitting.specimen import Specimen
from fitting.structures import AnySpecimen
from fitting.sweep import Sweep
from instrument.errors import BadInput
from instrument.facts.identification import IdentificationResult
from instrument.files.hammer_file import HammerModes, accepted_modes
from instrument.files.toml import one_line
from instrument.models.files import File
from instrument.models.identification import Identified, identify
from instrument.models.together import Together, identify_together
from instrument.progress import Progress, quiet
from instrument.results.identification_from import identification_from
from instrument.results.together_from import identified_together_from
from instrument.session.contents import Contents
from instrument.session.points import sweep_of


@dataclass(frozen=True)
class SessionFit:
    """An identification and what went into it."""

    identified: Identified
    sweep: Sweep
    specimen: AnySpecimen
    bare: BarePlateFit | None
    together: Together | None = None
    """Of a structure other than the plate; `sweep` is then of the points that took part."""


def identify_session(contents: Contents, progress: Progress = quiet) -> SessionFit:
    """Identify all points as the live identification does, jointly with the session's hammer test.

    Raises `BadInput` without points, `FittingError` where these points carry no law.
    """
    specimen, modes = contents.specimen, session_modes(contents)
    sweep = session_sweep(contents)
    if not isinstance(specimen, Specimen):
        together = identify_together([File(sweep, specimen)], progress)
        return SessionFit(together.found, together.found.sweep, specimen, None, together)
    found = identify(sweep, specimen, "direct", progress, modes)
    return SessionFit(found, sweep, specimen, found.bare)


def result_of_fit(fit: SessionFit) -> IdentificationResult:
    """As `viscorig identify` has it."""
    if fit.together is not None:
        return identified_together_from(fit.together, [File(fit.sweep, fit.specimen)])
    plate = fit.specimen if isinstance(fit.specimen, Specimen) else None
    return identification_from(fit.identified, plate)


def session_sweep(contents: Contents) -> Sweep:
    """Steps and sentinels, each at its commanded level. Raises `BadInput` where there are none."""
    if not contents.points:
        raise BadInput(f"{contents.path}: no point of a sweep in this session, expected a measured sweep")
    return sweep_of(contents.measured, [p.time_s for p in contents.points])


def session_modes(contents: Contents) -> HammerModes | None:
    """The hammer test's accepted modes, of a plate, if any: no fit of a beam takes them.

    Raises `BadInput` where they are beyond what can be used.
    """
    if contents.damping is None or not isinstance(contents.specimen, Specimen):
        return None
    try:
        return accepted_modes(contents.damping.result)
    except ValidationError as error:
        raise BadInput(f"{contents.path}: {one_line(error, prefix='hammer test: ')}") from None
