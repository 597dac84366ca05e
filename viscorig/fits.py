"""From a sweep or a session to the core's law, and to the effect that its residual shows."""

from collections.abc import Collection, Sequence
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple, TypeVar

from fitting.identification.pointwise import phase_is_kept
from fitting.specimen import PlateSpecimen as Model
from fitting.sweep import Sweep as Points
from instrument.errors import BadInput
from instrument.facts.diagnosis import DiagnosisResult
from instrument.facts.identification import IdentificationResult
from instrument.files.hammer_file import HammerModes
from instrument.finding.diagnosis import diagnose as diagnose_files
from instrument.finding.identification import identify as identify_files
from instrument.finding.methods import Method
from instrument.finding.pointwise import pointwise_of
from instrument.interchange.given import at_its_spot
from instrument.models.files import spots_of
from instrument.planning.open_questions import with_open_questions
from instrument.progress import bar
from instrument.results.diagnosis_from import diagnosis_from
from instrument.results.identification_from import identification_from
from instrument.results.pointwise_from import with_second_look
from viscorig.diagnosis import Diagnosis
from viscorig.hammer import HammerTest, hammer_modes_of
from viscorig.identification import Identification
from viscorig.session import Session
from viscorig.specimen import Specimen
from viscorig.sweep import Sweep, points_of

R = TypeVar("R", IdentificationResult, DiagnosisResult)


class Given(NamedTuple):
    """What is to be fitted."""

    points: Points
    plate: Specimen
    modes: HammerModes | None
    session: Session | None = None

    def said(self, result: R) -> R:
        """A result of these data, which says whose they are."""
        if self.session is None:
            return result
        said = result.but(session=self.session.name, reads=self.session.reads)
        of_session = isinstance(said, IdentificationResult) and self.session.diagnosis is not None
        return said.but(session_result=self.session.result) if of_session else said


def identify(
    data: Sweep | Session,
    specimen: Specimen | None = None,
    *,
    method: Method = "direct",
    hammer: HammerTest | None = None,
    viscous_damping: bool = True,
    pointwise: bool = False,
) -> Identification:
    """The core's complex shear modulus from a sweep and its specimen, or from a session.

    The specimen's law is where the search starts. `hammer` is the bare plate's test, a session's own where
    none is given; `viscous_damping=False` leaves the remaining one out; `pointwise` adds G* band by band,
    without a law. The same numbers as `viscorig identify`. Raises `BadInput`; `OutsideModel` where the
    specimen has no core or the theory does not hold; `TooFewPoints`.
    """
    if pointwise and method == "paper":
        raise BadInput("pointwise with method 'paper', expected the direct method")
    given = _given(data, specimen, hammer)
    model = given.plate.model if viscous_damping else replace(given.plate.model, modal_ratios=(0.0,))
    if pointwise:
        # Said before the work, not after it.
        phase_is_kept(given.points)
    several = given.points.pickup is not None
    if several:
        _whole_sweeps_alone(given, pointwise=pointwise, method=method)
    found = identify_files(spots_of(given.points, model), method, bar, given.modes)
    result = identification_from(found)
    if pointwise:
        result = with_second_look(result, pointwise_of(found))
    return Identification(result if several else given.said(result), given.plate)


def diagnose(
    data: Sweep | Session,
    specimen: Specimen | None = None,
    *,
    hammer: HammerTest | None = None,
    without: Collection[str] = (),
    accept: Sequence[str] | None = None,
    resamples: int | None = None,
) -> Diagnosis:
    """Which effect the residual of a sweep or a session shows, and the law without and with it.

    Effects in `without`, and what contains one of them, are not considered; those in `accept` are fitted on
    your word and nothing is searched for. `resamples` sweeps without effects give the p-value, with one
    pickup only and without `accept`, and by default where points are few. The same numbers as `viscorig
    diagnose`. Raises `BadInput`, `OutsideModel`, `TooFewPoints`.
    """
    given = _given(data, specimen, hammer)
    points, model, declined = given.points, given.plate.model, frozenset(without)
    several = points.pickup is not None
    if several:
        _whole_sweeps_alone(given, resamples=resamples)
    found = diagnose_files(spots_of(points, model), given.modes, declined, bar, accept, resamples)
    result = with_open_questions(diagnosis_from(found), found)
    return Diagnosis(result if several else given.said(result))


def _whole_sweeps_alone(
    given: Given, *, pointwise: bool = False, method: Method = "direct", resamples: int | None = None
) -> None:
    """Raises `BadInput`."""
    if resamples is not None:
        raise BadInput("resamples with several pickups, expected one pickup")
    if pointwise or method == "paper" or given.modes is not None:
        raise BadInput("several pickups with pointwise, method 'paper' or a hammer test, expected one pickup")


def _given(data: Sweep | Session, specimen: Specimen | None, hammer: HammerTest | None) -> Given:
    """Raises `BadInput`."""
    if not isinstance(data, Points | Session):
        said = "; a file is read by vr.load_session or vr.load_sweep" if isinstance(data, str | Path) else ""
        raise BadInput(f"data: a {type(data).__name__}, expected a Sweep or a Session{said}")
    if not isinstance(specimen, Specimen | None):
        raise BadInput(f"specimen: a {type(specimen).__name__}, expected a Specimen (vr.load_specimen)")
    if isinstance(data, Session):
        if data.sweep is None:
            raise BadInput(f"{data.path}: no point of a sweep in this session, expected a measured sweep")
        if data.has_mountings:
            raise BadInput(
                f"{data.path}: the plate carried a known mass at some points, was clamped anew or struck, "
                "expected 'viscorig identify' or 'diagnose', which fit them together"
            )
        tested = hammer if hammer is not None else data.good_hammer
        return Given(points_of(data.sweep), specimen or data.specimen, hammer_modes_of(tested), data)
    if specimen is None:
        raise BadInput("a sweep does not say which plate it was, expected its specimen")
    model, points = at_its_spot("sweep", specimen.model, points_of(data))
    assert isinstance(model, Model)
    return Given(points, specimen.of(model), hammer_modes_of(hammer))
