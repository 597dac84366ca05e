"""Several files, or a structure other than the plate, identified and diagnosed: as JSON holds them."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from instrument.models.together import DiagnosedTogether, File, SetAside, Together
from instrument.results.diagnosis_facts import diagnosis_facts
from instrument.results.identification_facts import identification_facts


def identified_together_facts(found: Together, files: Sequence[File]) -> dict[str, Any]:
    """The JSON of `identify`, each point with its file (from 1), and what was set aside."""
    facts = identification_facts(found.found, found.sweep)
    for point, file in zip(facts["points"], _owners(files, facts["points"]), strict=True):
        point["file"] = file
    return {**facts, "files": [f.name for f in files], "set_aside": aside_facts(found.aside, files)}


def diagnosed_together_facts(found: DiagnosedTogether, files: Sequence[File]) -> dict[str, Any]:
    """The JSON of `diagnose`, with the files' names and what was set aside of which."""
    facts = diagnosis_facts(found.found, found.sweep)
    return {**facts, "files": [f.name for f in files], "set_aside": aside_facts(found.aside, files)}


def aside_facts(aside: Sequence[SetAside], files: Sequence[File]) -> list[dict[str, Any]]:
    """Stretches of each file that take no part."""
    return [
        {
            "file": one.file,
            "name": files[one.file - 1].name,
            "from_hz": one.glitch.low_hz,
            "to_hz": one.glitch.high_hz,
            "largest_percent": 100 * one.glitch.largest,
            "points": one.points,
        }
        for one in aside
    ]


def _owners(files: Sequence[File], points: Sequence[dict[str, Any]]) -> list[int]:
    """By segments: every file's are numbered on from the last one's."""
    counts = np.cumsum([len(np.unique(f.sweep.segment)) for f in files])
    return [int(np.searchsorted(counts, p["segment"])) + 1 for p in points]
