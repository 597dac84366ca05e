"""LabVIEW measurement files to the blows they hold."""

from pathlib import Path

import numpy as np

from instrument.errors import BadInput
from instrument.files.lvm import read_lvm
from instrument.interchange.found import Found
from instrument.interchange.read_table import read_table
from instrument.interchange.signals import Named


def read_lvm_hits(path: Path) -> Found:
    """A hit of each segment: a force and its responses, by their units. Raises `BadInput`."""
    found = Found()
    for k, block in enumerate(read_lvm(path), start=1):
        names = [
            f"{n or f'channel {c}'} [{u}]"
            for c, (n, u) in enumerate(zip(block.names, block.units, strict=True), 1)
        ]
        table: Named = dict(zip(names, block.samples.T, strict=True))
        if len(table) < len(names):
            raise BadInput(f"{path}: {', '.join(names)}: expected a name for each channel")
        table["sample_rate_hz"] = np.array([block.sample_rate_hz])
        if not read_table(f"{path.name} segment {k}", table, found):
            raise BadInput(f"{path}: segment {k}: found {', '.join(names)}, expected a force in N among them")
    return found
