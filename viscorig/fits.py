"""From a sweep or a session to the core's law, and to the effect that its residual shows."""

from collections.abc import Collection, Sequence
from dataclasses import replace
from typing import Any

from fitting.pointwise import phase_is_kept
from fitting.sweep import Sweep as Points
from instrument.errors import BadInput
from instrument.files.hammer_file import HammerModes
from instrument.models.diagnosis import diagnose as diagnose_sweep
from instrument.models.identification import Method
from instrument.models.identification import identify as identify_sweep
from instrument.models.pointwise import pointwise_of
from instrument.progress import bar
from instrument.results.diagnosis_facts import diagnosis_facts
from instrument.results.identification_facts import bare_plate_facts, identification_facts
from instrument.results.pointwise_facts import second_look_facts
from instrument.stream.jsonable import to_jsonable
from viscorig.diagnosis import Diagnosis
from viscorig.hammer import HammerTest, hammer_modes_of
from viscorig.identification import Identification
from viscorig.session import Session
from viscorig.specimen import Specimen
from viscorig.sweep import Sweep, points_of

Given = tuple[Points, Specimen, HammerModes | None, dict[str, Any]]


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
    sweep, plate, modes, said = _given(data, specimen, hammer)
    model = plate.model if viscous_damping else replace(plate.model, modal_ratios=())
    if pointwise:
        # Said before the work, not after it.
        phase_is_kept(sweep)
    found = identify_sweep(sweep, model, method, bar, modes)
    facts = identification_facts(found, sweep)
    if found.bare is not None:
        facts["hammer"] = bare_plate_facts(found.bare, model)
    if pointwise:
        facts |= second_look_facts(pointwise_of(found, sweep))
    return Identification(to_jsonable({**facts, **said}), plate)


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

    Effects in `without` are not considered; those in `accept` are fitted on your word and nothing is
    searched for. `resamples` sweeps without effects give the p-value, by default where points are few. The
    same numbers as `viscorig diagnose`. Raises `BadInput`, `OutsideModel`, `TooFewPoints`.
    """
    sweep, plate, modes, said = _given(data, specimen, hammer)
    found = diagnose_sweep(sweep, plate.model, modes, frozenset(without), bar, accept, resamples=resamples)
    return Diagnosis(to_jsonable({**diagnosis_facts(found, sweep), **said}))


def _given(data: Sweep | Session, specimen: Specimen | None, hammer: HammerTest | None) -> Given:
    """Points, plate, hammer test, and what a session adds to the facts. Raises `BadInput`."""
    if isinstance(data, Session):
        if data.sweep is None:
            raise BadInput(f"{data.path}: no point of a sweep in this session, expected a measured sweep")
        tested = hammer if hammer is not None else data.good_hammer
        said = {"session": data.name, "reads": data.reads}
        return points_of(data.sweep), specimen or data.specimen, hammer_modes_of(tested), said
    if specimen is None:
        raise BadInput("a sweep does not say which plate it was, expected its specimen")
    return points_of(data), specimen, hammer_modes_of(hammer), {}
