"""A look at a file and its specimen before anything is fitted. No Qt."""

from dataclasses import dataclass

from fitting.arrays import Array
from fitting.structures import AnySpecimen, Beam
from fitting.structures.shear_pair import ShearPair
from gui.files.pairing import PairedFile
from instrument.files.modal_table import is_modal_table, read_modal_table
from instrument.files.structure_file import read_structure
from instrument.interchange.given import read_given


@dataclass(frozen=True)
class Looked:
    """What a file holds, and what it was measured on, in words."""

    data: str
    specimen: str


def look(file: PairedFile) -> Looked:
    """Read both as the commands do. Raises `BadInput`, `FittingError`."""
    if file.specimen is not None and file.data.suffix.lower() == ".csv" and is_modal_table(file.data):
        table = read_modal_table(file.data)
        return Looked(_counted(table.frequency_hz, "modes"), _words(read_structure(file.specimen)))
    given = read_given(file.data, file.specimen, None, own_hammer=False)
    return Looked(_counted(given.sweep.frequency_hz, "points"), _words(given.specimen))


def _counted(frequency_hz: Array, what: str) -> str:
    low, high = frequency_hz.min(), frequency_hz.max()
    return f"{len(frequency_hz)} {what}, {low:.4g} to {high:.4g} Hz"


def _words(specimen: AnySpecimen) -> str:
    """Its kind, and the number that tells it from its like."""
    if isinstance(specimen, ShearPair):
        return f"shear pair, {specimen.mass_kg:.4g} kg"
    length = f"{1e3 * specimen.length_m:.4g}"
    if isinstance(specimen, Beam):
        return f"beam, {length} mm"
    return f"plate, {length} x {1e3 * specimen.width_m:.4g} mm"
