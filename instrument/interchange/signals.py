"""Columns by their names to the quantities that they are parts of: re and im, or magnitude and phase."""

from collections.abc import Collection
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from instrument.errors import BadInput
from instrument.files.units import Unit
from instrument.interchange.said_by_name import (
    NotSaid,
    is_of_base,
    radians,
    refuse_contradiction,
    refuse_unknown,
)
from instrument.interchange.unit_in_name import (
    EXPECTED_DB,
    Part,
    amplitude_factor,
    of_decibels,
    part_in,
    reference_of_db,
    stem_of,
    unit_in,
)

Named = dict[str, NDArray[Any]]
"""Arrays of one length; matrices (samples, hits) for hits side by side; single numbers as arrays of one."""
_SAME = 0.02
"""Magnitude and phase beside real and imaginary part are written with few digits."""


@dataclass(frozen=True)
class Signal:
    """A quantity, its parts put together."""

    name: str
    unit: Unit
    is_base: bool
    values: NDArray[Any]
    peak: float = 1.0
    """What an amplitude was made with, of an rms value or one from peak to peak."""
    names: tuple[str, ...] = ()
    """Of its parts."""

    @property
    def words(self) -> str:
        """What is known of it, for people."""
        return self.name if self.peak == 1.0 else f"{self.name} times {self.peak:.4g}"


def signals_of(source: str, table: Named, others: Collection[str]) -> list[Signal]:
    """Of all columns but `others`; `source` names the table in messages.

    Raises `BadInput` where they contradict each other, `NotSaid` where they say too little.
    """
    parts: dict[tuple[str, ...], dict[Part, str]] = {}
    for name in table:
        if name in others:
            continue
        unit = unit_in(name)
        if (unit is None or unit.per is None) and part_in(name) != "phase":
            refuse_unknown(source, name, unit)
        if unit is None and part_in(name) != "phase":
            continue
        if unit is not None:
            refuse_contradiction(source, name, unit)
        mine, part = parts.setdefault(stem_of(name), {}), part_in(name)
        if part in mine:
            raise NotSaid(f"{source}: {mine[part]} and {name}: which of them? expected one, or other words")
        mine[part] = name
    _lend_phase(source, table, parts)
    return [s for stem, by_part in parts.items() if (s := _signal(source, table, stem, by_part)) is not None]


def _lend_phase(source: str, table: Named, parts: dict[tuple[str, ...], dict[Part, str]]) -> None:
    """A phase that says no more than the only size does is that one's, beside what drives it.

    Several are of the sizes whose words they share, each of one; a base's is of the only base. Raises
    `NotSaid` where one may be of several.
    """
    alone = [stem for stem, names in parts.items() if set(names) == {"phase"}]
    sizes = [
        stem
        for stem, names in parts.items()
        if set(names) in ({"whole"}, {"magnitude"})
        and not any(np.iscomplexobj(table[name]) for name in names.values())
    ]
    bases = [stem for stem in sizes if is_of_base(stem)]
    owners = {
        of: bases if is_of_base(of) else [stem for stem in sizes if set(of) <= set(stem)] for of in alone
    }
    if len(alone) == 1 and not is_of_base(alone[0]):
        (of,) = alone
        readings = [s for s in parts if s != of and not is_of_base(s) and not _is_force(parts[s])]
        owners[of] = [stem for stem in owners[of] if [stem] == readings]
    found = [stem for (stem, *more) in owners.values() if not more] if all(owners.values()) else []
    if len(set(found)) == len(alone):
        for of, stem in zip(alone, found, strict=True):
            parts[stem]["phase"] = parts.pop(of)["phase"]
    elif any(owners.values()):
        names = ", ".join(parts[of]["phase"] for of in alone)
        raise NotSaid(f"{source}: {names}: the phase of what? expected the words of it in its name")


def _is_force(names: dict[Part, str]) -> bool:
    units = [u for part, n in names.items() if part != "phase" and (u := unit_in(n))]
    return bool(units) and units[0].quantity == "force" and units[0].per is None


def _signal(source: str, table: Named, stem: tuple[str, ...], names: dict[Part, str]) -> Signal | None:
    label = next(iter(names.values()))
    units = [u for part, n in names.items() if part != "phase" and (u := unit_in(n))]
    if not units:
        return None
    unit = units[0]
    if any(u != unit for u in units):
        raise BadInput(f"{source}: {' and '.join(names.values())}: expected both in one unit")
    if ("re" in names) != ("im" in names):
        raise BadInput(f"{source}: {label}: its other part is missing, expected re and im")
    size = names.get("magnitude") or names.get("whole")
    if "re" in names:
        values: NDArray[Any] = _from_parts(source, table, names["re"], names["im"])
        if size is not None:
            _check_agree(source, table, names, size, values)
    elif size is None:
        return None
    elif "phase" in names:
        values = _size(table, size)
        if not np.iscomplexobj(values) and np.any(values < 0):
            raise NotSaid(
                f"{source}: {size}: {np.nanmin(values):g} as a size beside a phase: in dB? {EXPECTED_DB}"
            )
        values = values * np.exp(1j * radians(source, names["phase"], table[names["phase"]]))
    else:
        values = _size(table, size)
    # Of a ratio both are stated alike.
    peak = (
        1.0 if unit.per is not None else max(map(amplitude_factor, names.values()), key=lambda x: abs(x - 1))
    )
    return Signal(label, unit, is_of_base(stem), values * (unit.factor * peak), peak, tuple(names.values()))


def _from_parts(source: str, table: Named, re: str, im: str) -> NDArray[Any]:
    for name in (re, im):
        if reference_of_db(name) is not None:
            raise NotSaid(f"{source}: {name}: dB of a part of a phasor, expected dB of its magnitude")
    return np.asarray(table[re] + 1j * table[im])


def _size(table: Named, name: str) -> NDArray[Any]:
    """As it stands, of dB what it is a level of."""
    reference = reference_of_db(name)
    return table[name] if reference is None else of_decibels(table[name], reference)


def _check_agree(source: str, table: Named, names: dict[Part, str], size: str, values: NDArray[Any]) -> None:
    """Raise `BadInput` where a magnitude, or magnitude and phase, are not those of the parts beside them."""
    other = _size(table, size)
    if np.iscomplexobj(other) or other.shape != values.shape:
        return
    own = np.abs(values)
    if "phase" in names:
        other = other * np.exp(1j * radians(source, names["phase"], table[names["phase"]]))
        own = values
    most = float(np.nanmax(np.abs(values), initial=0.0))
    if not np.allclose(own, other, atol=_SAME * most, rtol=_SAME, equal_nan=True):
        raise BadInput(
            f"{source}: {', '.join(names.values())}: magnitude and phase are not those of real and imaginary "
            "part, expected one of both"
        )
