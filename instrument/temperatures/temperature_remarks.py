"""What is to be said of data of several temperatures as they were given."""

from fitting.mode_tables.table import ModalTable
from fitting.specimen import PlateSpecimen
from fitting.stated.layers import METAL_PER_K, Face
from fitting.structures import Beam
from fitting.temperature.shifts import ZERO_K
from instrument.remarks.clamp_remarks import remarks_on_clamps
from instrument.remarks.file_remarks import remarks_on_edges
from instrument.remarks.modal_remarks import remarks_on_errors
from instrument.temperatures.members import Members

_WORTH_SAYING_K = 10.0
"""Between the coldest and the warmest, from which a metal's own change is said."""
_FAR_K = 40.0
"""The same of a plate, whose metal is taken to be as stated: by then it is off by more than its tolerance."""


def remarks_at_temperatures(members: Members, *, vertical: bool) -> tuple[str, ...]:
    """Each once; `vertical`: whether the law is shifted in size too."""
    said = [] if vertical else _on_entropy(members)
    for specimen in members.specimens:
        said += [*remarks_on_clamps(specimen), *remarks_on_edges(specimen)]
        if isinstance(specimen, Beam):
            said += _on_metal(members, specimen)
        elif isinstance(specimen, PlateSpecimen) and _kelvins(members) > _FAR_K:
            said.append(
                f"the faces are taken to be as stiff at all temperatures: over {_kelvins(members):.0f} K a "
                "metal's modulus changes by 0.03 to 0.05 % a kelvin, which is not counted of a plate"
            )
    tables = [one.data for one in members.every if isinstance(one.data, ModalTable)]
    said += remarks_on_errors(tables)
    return tuple(dict.fromkeys(said))


def _on_entropy(members: Members) -> list[str]:
    """That a rubber's modulus goes with the absolute temperature, where it is not let."""
    if any(s.exact for s in members.specimens) or _kelvins(members) < _WORTH_SAYING_K:
        return []
    T = [one.temperature_c + ZERO_K for one in members.every]
    return [
        "the law is shifted in frequency alone: a rubber's modulus goes with the absolute temperature "
        f"besides, by {100 * (max(T) / min(T) - 1):.0f} % over these, as '--vertical' allows"
    ]


def _kelvins(members: Members) -> float:
    T = [one.temperature_c for one in members.every]
    return max(T) - min(T)


def _on_metal(members: Members, beam: Beam) -> list[str]:
    faces: list[tuple[str, Face | None]] = [
        ("substrate", beam.substrate),
        ("constraining", beam.constraining),
    ]
    guessed = [name for name, face in faces if face is not None and face.young_per_k is None]
    if beam.exact or not guessed or _kelvins(members) < _WORTH_SAYING_K:
        return []
    return [
        f"Young's modulus of {' and '.join(guessed)} is taken to change by {100 * METAL_PER_K:g} +- 0.02 % a "
        "kelvin, as metals' does: state young_percent_per_k where it is known (steel -0.03, aluminium -0.05)"
    ]
