"""Specimens that differ in stated values only: the first of them lends its reduced model to the others."""

from collections.abc import Sequence
from dataclasses import replace
from functools import cache
from pathlib import Path

from fitting.errors import FittingError
from fitting.specimen import PlateSpecimen
from instrument.batch.task import BatchTask
from instrument.errors import BadInput
from instrument.files.specimen_file import read_specimen
from instrument.models.sharing import may_be_like


def with_families(tasks: Sequence[BatchTask]) -> list[BatchTask]:
    """Each task with the specimen file whose models may serve it, by the order of the rows alone.

    Whether they do is judged where the row is worked on.
    """
    read = cache(_read)
    firsts: list[str] = []

    @cache
    def like(path: str) -> str | None:
        specimen = read(path)
        if specimen is None or specimen.exact:
            return None
        for first in firsts:
            lender = read(first)
            if lender is not None and may_be_like(specimen, lender):
                return first
        firsts.append(path)
        return None

    return [replace(task, like=like(task.specimen)) if task.specimen else task for task in tasks]


def _read(path: str) -> PlateSpecimen | None:
    try:
        return read_specimen(Path(path))
    except (BadInput, FittingError):
        return None
