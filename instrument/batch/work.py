"""A row's work: read, identify or diagnose, and say in one line why not. The same here and on a cluster."""

import os
import traceback
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from threadpoolctl import threadpool_limits

from fitting.errors import FittingError
from fitting.specimen import PlateSpecimen
from instrument.batch.keys import program
from instrument.batch.of_modes import diagnosed_modes, identified_modes
from instrument.batch.task import BatchTask
from instrument.errors import BadInput
from instrument.facts.diagnosis import DiagnosisResult, StageFitted
from instrument.facts.doubts import doubts_of
from instrument.facts.identification import IdentificationResult
from instrument.facts.modal import ModalResult
from instrument.files.modal_table import is_modal_table
from instrument.files.plausible import question_specimen
from instrument.files.specimen_file import read_specimen
from instrument.files.structure_file import read_structure
from instrument.finding.diagnosis import diagnose
from instrument.finding.identification import identify
from instrument.interchange.given import Given, read_given
from instrument.interchange.questions import question_data
from instrument.material.stated_part import stated_columns
from instrument.models.files import File
from instrument.models.sharing import serves
from instrument.processes.other_processes import VARIABLE as PROCESSES
from instrument.results.diagnosis_from import diagnosis_from
from instrument.results.identification_from import identification_from
from instrument.stream.jsonable import to_jsonable

Outcome = dict[str, Any]
"""As JSON has it. `failed` is a line, or None; `again` where the next run should try once more."""
_KEPT = (
    "law_kind",
    "parameters",
    "standard_errors",
    "rms_percent",
    "held_out_rms_percent",
    "leave_one_out_rms_percent",
    "chi2_per_dof",
    "law",
)


def outcome_of(task: BatchTask) -> Outcome:
    """Work on a row and never fail. `program` says whose answer it is."""
    # Rows share the processors among them; a row is alone on its own.
    os.environ[PROCESSES] = "1"
    with threadpool_limits(1, "blas"):
        try:
            # What numpy warns of on the way belongs to no one at the console.
            with np.errstate(all="ignore"):
                found = _worked(task)
        except (BadInput, FittingError) as error:
            found = failure(_without_folders(task, str(error)))
        except Exception as error:  # one row is not the end of a batch
            found = failure(_without_folders(task, _inside(error)), again=True)
    return {**found, "program": program()}


def _inside(error: Exception) -> str:
    """What to do about an exception that nothing foresaw, and what those ask for who can mend it."""
    *_, place = traceback.extract_tb(error.__traceback__) or [None]
    where = f" in {Path(place.filename).name}, line {place.lineno}" if place is not None else ""
    if isinstance(error, np.linalg.LinAlgError | FloatingPointError):
        return (
            "the equations of this specimen and these data have no solution: are units, edges, spots and "
            f"signs those of the files? If so, it is viscorig's fault: report both files ({error}{where})"
        )
    return (
        "viscorig itself failed at this row, whatever its files say; the others stand: report both files "
        f"({type(error).__name__}{where}: {error})"
    )


def failure(why: str, *, again: bool = False) -> Outcome:
    """A row without a law."""
    return {"failed": " ".join(why.split()) or "no reason given", "again": again}


def lost(task: BatchTask) -> Outcome:
    """A row whose process died with it, twice."""
    return {**failure("its process was ended from outside, or crashed", again=True), "program": program()}


def _without_folders(task: BatchTask, message: str) -> str:
    """Outcomes are kept by names and contents of files, wherever these are; the row itself names its data."""
    message = message.removeprefix(f"{task.data}: ")
    for path in (task.data, task.specimen, task.hammer):
        if path:
            message = message.replace(path, Path(path).name)
    return message


def _worked(task: BatchTask) -> Outcome:
    data, specimen, hammer = (Path(p) if p else None for p in (task.data, task.specimen, task.hammer))
    assert data is not None
    if specimen is None and not data.suffix:
        raise BadInput(f"{data}: neither a session nor a sweep")
    if specimen is not None:
        # Whatever else is wrong with it is said on reading.
        read_structure(specimen)
        question_specimen(specimen, insist=task.insist)
        if data.suffix.lower() == ".csv" and is_modal_table(data):
            return _of_modes(task, data, specimen)
    given = read_given(data, specimen, hammer)
    if hammer is not None and not isinstance(given.specimen, PlateSpecimen):
        raise BadInput(f"{hammer}: a hammer test with a {given.specimen.kind}, expected a plate")
    like = _lender(task, given)
    if not task.insist:
        question_data(given, data, like=like)
    if given.diagnosis is not None and not task.diagnose:
        like, facts = None, _of_diagnosis(given.diagnosis)
    else:
        facts = _diagnosed(given, like) if task.diagnose else _identified(given, like)
    f = given.sweep.frequency_hz
    measured = {
        "points": len(given.sweep),
        "lowest_hz": float(f.min()),
        "highest_hz": float(f.max()),
        "temperature_c": given.temperature_c,
        "borrowed_model": like is not None,
    }
    return _done(measured, facts)


def _of_modes(task: BatchTask, data: Path, specimen: Path) -> Outcome:
    if task.hammer is not None:
        raise BadInput(f"{task.hammer}: a hammer test with a table of modes, expected a sweep")
    if task.diagnose:
        diagnosed, measured = diagnosed_modes(data, specimen, insist=task.insist)
        return _done(measured, _of_diagnosis(diagnosed))
    result, measured = identified_modes(data, specimen, insist=task.insist)
    return _done(measured, _of_fit(result))


def _done(measured: dict[str, Any], facts: dict[str, Any]) -> Outcome:
    kept = {"failed": None, "again": False, **measured, **facts, "law": _columns(facts["law"])}
    found: Outcome = to_jsonable(kept)
    return found


def _columns(rows: list[dict[str, float]]) -> dict[str, list[float]]:
    """Short on disk: each key once."""
    return {key: [row[key] for row in rows] for key in rows[0]} if rows else {}


def _lender(task: BatchTask, given: Given) -> PlateSpecimen | None:
    if task.like is None or not isinstance(given.specimen, PlateSpecimen):
        return None
    lender = read_specimen(Path(task.like))
    if given.sweep.pickup is not None or given.with_masses:
        return None
    return lender if serves(lender, given.plate, given.sweep) else None


def _identified(given: Given, like: PlateSpecimen | None) -> dict[str, Any]:
    return _of_fit(identification_from(identify(_files(given, like), hammer=given.modes)))


def _files(given: Given, like: PlateSpecimen | None) -> list[File]:
    """As files under one law; `like` is the plate whose model one plate borrows, as `serves` allows."""
    return [replace(one, like=like) for one in given.files()]


def _diagnosed(given: Given, like: PlateSpecimen | None) -> dict[str, Any]:
    return _of_diagnosis(diagnosis_from(diagnose(_files(given, like), given.modes)))


def _of_fit(result: IdentificationResult | ModalResult) -> dict[str, Any]:
    """Not diagnosed."""
    return {
        "verdict": None,
        "effects": [],
        "converged": result.converged,
        "warnings": result.warnings,
        "doubts": doubts_of(result),
        **_kept(result),
    }


def _of_diagnosis(result: DiagnosisResult) -> dict[str, Any]:
    """Made now, or recorded with the session: its law is the one after it."""
    return {
        "verdict": result.verdict,
        "effects": [effect.name for effect in result.effects],
        "converged": None,
        "warnings": result.warnings,
        "doubts": doubts_of(result),
        **_kept(result.after),
    }


def _kept(fit: IdentificationResult | ModalResult | StageFitted) -> dict[str, Any]:
    """What a table of modes does not have is None."""
    facts = fit.as_json()
    return {**{key: facts.get(key) for key in _KEPT}, "stated": stated_columns(facts)}
