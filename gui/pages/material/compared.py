"""Laws to be drawn beside the session's: the paper's, and those of other sessions. No Qt."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from gui.pages.law.curve import LawCurve
from instrument.errors import BadInput
from instrument.files.sweep_file import read_sweep
from instrument.paper_case import TABLE_4, case_file
from instrument.results.diagnosis_words import UNKNOWN
from instrument.results.session_result import BEFORE_DIAGNOSIS
from instrument.results.standing import law_words, one_fit_words, stage_before
from instrument.session.contents import contents_of
from instrument.session.storage import SessionFile

PAPER = "ZN_1, the paper's Table 4"


@dataclass(frozen=True)
class ComparedLaw:
    """A law and its name in the legend."""

    name: str
    curve: LawCurve
    note: str
    """Where it comes from."""


def paper_law() -> ComparedLaw:
    """Over the band of the paper's measurement; the paper states no errors."""
    f = read_sweep(case_file("table5.csv")).sweep(1.0).frequency_hz
    grid = np.geomspace(f.min(), f.max(), 61)
    said = ", ".join(f"{name} = {value:g}" for name, value in zip(TABLE_4.names, TABLE_4.values, strict=True))
    return ComparedLaw(PAPER, LawCurve.stated(TABLE_4, grid), f"{TABLE_4.kind}: {said}; no errors stated")


def recorded_laws(path: Path) -> list[ComparedLaw]:
    """The law a session ended with, and that before its diagnosis found effects. Raises `BadInput`."""
    with SessionFile(path) as session:
        contents = contents_of(session, with_hits=False)
    fit = contents.fit.result if contents.fit is not None else None
    diagnosis = contents.diagnosis.result if contents.diagnosis is not None else None
    if fit is None:
        raise BadInput(f"{path}: no law was fitted in this session, expected one with a finished fit")
    if diagnosis is not None and stage_before(diagnosis) is not None:
        effects = " and ".join(diagnosis.equivalent)
        before, after = (LawCurve.of(stage.law) for stage in diagnosis.stages)
        return [
            ComparedLaw(path.stem, after, f"{path}: its diagnosis, with {law_words(diagnosis)}"),
            ComparedLaw(f"{path.stem}, before", before, f"{path}: {BEFORE_DIAGNOSIS}, without {effects}"),
        ]
    if diagnosis is None:
        note = f"{path}: its own fit, {len(fit.points)} points"
        return [ComparedLaw(path.stem, LawCurve.of(fit.law), note)]
    doubt = f", {UNKNOWN}" if diagnosis.verdict == "unknown" else ""
    note = f"{path}: its diagnosis, {one_fit_words(diagnosis)}{doubt}"
    return [ComparedLaw(f"{path.stem}{doubt}", LawCurve.of(diagnosis.after.law), note)]
