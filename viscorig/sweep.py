"""A sweep: from its file, or from arrays."""

from dataclasses import fields
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fitting.gravity import PUBLISHED_G_M_S2
from fitting.sweep import Sweep as Points
from fitting.sweep import segments_by_gap
from instrument.errors import BadInput
from instrument.files.sweep_file import words_of_other_reading
from instrument.interchange.base_frf import is_frf_csv, sweep_of_foreign, sweep_of_frf_csv
from instrument.interchange.given import file_of_one_mounting
from instrument.interchange.readers import is_foreign
from instrument.stream.jsonable import to_jsonable
from viscorig.checked import numbers
from viscorig.shown import Columns, Shown
from viscorig.specimen import Specimen

if TYPE_CHECKING:
    from matplotlib.axes import Axes


class Sweep(Shown, Points):
    """The pickup's velocity at single frequencies, phasors of e^{+i omega t} or amplitudes, zero to peak.

    Arrays have shape (points,), a single number stands for all points; order carries no meaning.
    `commanded_m_s2` is the base acceleration asked for, `base_m_s2` the one measured (phasors), both in
    newtons where a force drives; `std_m_s` the standard deviation of the reading, `pickup` which of several
    spots, from 0. Segments are told apart by gaps in frequency where none are
    given. Raises `BadInput` where arrays do not fit together or hold what was never measured.
    """

    def __init__(
        self,
        frequency_hz: ArrayLike,
        velocity_m_s: ArrayLike,
        commanded_m_s2: ArrayLike = PUBLISHED_G_M_S2,
        segment: ArrayLike | None = None,
        sweep: ArrayLike = 1,
        base_m_s2: ArrayLike | None = None,
        std_m_s: ArrayLike | None = None,
        weight: ArrayLike | None = None,
        time_s: ArrayLike | None = None,
        pickup: ArrayLike | None = None,
        **further: Any,
    ) -> None:
        f = numbers("frequency_hz", frequency_hz, float, above_zero=True)

        def array(name: str, values: ArrayLike, dtype: type, *, above_zero: bool = False) -> NDArray[Any]:
            return numbers(name, values, dtype, len(f), above_zero=above_zero)

        def optional(name: str, values: ArrayLike | None, dtype: type = float) -> NDArray[Any] | None:
            return None if values is None else array(name, values, dtype, above_zero=name != "time_s")

        kind = complex if np.iscomplexobj(velocity_m_s) else float
        super().__init__(
            frequency_hz=f,
            velocity_m_s=array("velocity_m_s", velocity_m_s, kind, above_zero=True),
            commanded_m_s2=array("commanded_m_s2", commanded_m_s2, float, above_zero=True),
            segment=segments_by_gap(f) if segment is None else array("segment", segment, np.intp),
            sweep=array("sweep", sweep, np.intp),
            base_m_s2=optional("base_m_s2", base_m_s2, complex),
            std_m_s=optional("std_m_s", std_m_s),
            weight=optional("weight", weight),
            time_s=optional("time_s", time_s),
            pickup=None if pickup is None else array("pickup", pickup, np.intp),
            **further,
        )

    def to_numpy(self) -> Columns:
        """Every array there is, by its name. Shape (points,) each."""
        return {f.name: v for f in fields(self) if isinstance(v := getattr(self, f.name), np.ndarray)}

    def as_dict(self) -> dict[str, Any]:
        """The arrays as lists; a phasor is split into `_re` and `_im`."""
        found: dict[str, NDArray[Any]] = {}
        for name, values in self.to_numpy().items():
            if np.iscomplexobj(values):
                stem, _, unit = name.partition("_")
                found |= {f"{stem}_re_{unit}": values.real, f"{stem}_im_{unit}": values.imag}
            else:
                found[name] = values
        return {name: to_jsonable(values) for name, values in found.items()}

    def lines(self) -> list[str]:
        """How many points there are, and between which frequencies."""
        f, kind = self.frequency_hz, "phasors" if self.has_phase else "amplitudes"
        segments = len(np.unique(self.segment))
        return [f"sweep of {len(f)} points, {f.min():g} to {f.max():g} Hz, {segments} segments, {kind}"]

    def plot(self, ax: "Axes | None" = None) -> "Axes":
        """Amplitude over frequency; the axes."""
        from viscorig.plots import plot_amplitude

        return plot_amplitude(ax, self.frequency_hz, np.abs(self.response_m_s), "o", "measured")


def load_sweep(path: str | Path, specimen: Specimen) -> Sweep:
    """Read a sweep (.csv), or FRFs over the base or the force (.csv, .uff, .unv, .mat).

    The levels of a file are multiples of the specimen's base acceleration. Raises `BadInput`, also where the
    file says itself that its velocities are absolute or relative, and the specimen otherwise.
    """
    path, level, drive = Path(path), specimen.model.drive_amplitude, specimen.model.drive
    if is_foreign(path) and drive == "force":
        return as_sweep(sweep_of_foreign(path, level, drive))
    if not is_foreign(path) and is_frf_csv(path):
        return as_sweep(sweep_of_frf_csv(path, level))
    file = file_of_one_mounting(path)
    doubt = words_of_other_reading(file.reads, specimen.model.reads) if file.reads else ""
    if doubt:
        raise BadInput(f"{path}: {doubt}")
    return as_sweep(file.sweep(level, drive))


def as_sweep(points: Points) -> Sweep:
    """Points as an object of this package."""
    return Sweep(**{f.name: getattr(points, f.name) for f in fields(points)})


def points_of(sweep: Sweep) -> Points:
    """Points as the fits take them."""
    return Points(**{f.name: getattr(sweep, f.name) for f in fields(sweep)})
