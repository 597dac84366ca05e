"""What is to be said of data and specimen as they were given, whatever is found in them."""

import numpy as np

from fitting.arrays import Array
from fitting.data.noise import noise_of, scatter_over_stated, shortest_group
from fitting.data.strays import BEYOND, strays
from fitting.dynamics.unstated_damping import RATIO, with_unstated_damping
from fitting.laws import CoreLaw
from fitting.laws.bent_law import BentLaw
from fitting.specimen import PlateSpecimen
from fitting.stated.patches import shifts_of
from fitting.stated.tolerances import STATED
from fitting.structures import AnySpecimen
from fitting.sweep import Sweep
from instrument.remarks.tolerance_words import asked, not_named

_NAMED = 6
"""Frequencies in one sentence."""
_DIFFERS = 1.5
"""Times, median over the points: a stated noise so far off the scatter is not this sweep's."""


def remarks_on_tolerances(specimen: AnySpecimen) -> tuple[str, ...]:
    """Where typical tolerances stand in for ones that were not named."""
    missing, every = not_named(specimen), asked(specimen)
    if not missing:
        return ()
    count = "" if len(missing) == len(every) else f"{len(missing)} of {len(every)} "
    return (f"{count}tolerances not named: typical values of a careful laboratory (docs/specimen.md)",)


def remarks_on_patches(specimen: AnySpecimen) -> tuple[str, ...]:
    """That no data tell a patch cut wrongly from another core."""
    if not isinstance(specimen, PlateSpecimen) or specimen.exact or "cut" in specimen.tolerances:
        return ()
    if not any(shift.kind == "cut" for shift in shifts_of(specimen)):
        return ()
    return (
        "a [[patch]] cut shorter than stated looks like a softer core, and no data tell the two apart: "
        f"measure it, and say how well by cut_mm ({1e3 * STATED['cut'].typical:g} stands in)",
    )


def remarks_on_damping(specimen: PlateSpecimen, *, tested: bool) -> tuple[str, ...]:
    """Where neither the file nor a hammer test says how a plate rings without its core."""
    if tested or with_unstated_damping(specimen) is specimen:
        return ()
    return (
        f"no [damping] and no hammer test: the bare plate's ratios are taken as {100 * RATIO:g} % of "
        "critical, known to a factor of 2.7; a hammer test narrows the loss factor's band",
    )


def remarks_on_law(law: CoreLaw, sweep_hz: Array) -> tuple[str, ...]:
    """Where the law that is fitted is not the one the specimen file names. Shape (points,)."""
    fitted = law.to_fit(sweep_hz)
    if fitted.kind == law.kind:
        return ()
    return (
        f"[core.law] is a {law.kind}: fitted is a {fitted.kind} that begins at the one nearest to it; the "
        "rows are a start and weigh nothing against the data",
    )


def remarks_on_bend(found: CoreLaw, usual: float) -> tuple[str, ...]:
    """Where the data asked for a law that bends further than `usual`."""
    times = found.freedom / usual if isinstance(found, BentLaw) else 1.0
    if times == 1.0:
        return ()
    return (
        f"the law may bend {times:g} times as far from its formula as materials usually do, as the data ask: "
        "the core follows another law, or something else is amiss; see 'viscorig diagnose'",
    )


def remarks_on_noise(sweep: Sweep, *, others_known: bool = False) -> tuple[str, ...]:
    """Where a sweep shows no noise, or scatters otherwise than its file or each of its dwells says.

    `others_known`: whether files beside it show theirs.
    """
    if not noise_of(sweep).is_known:
        few = f"{len(sweep)} points in segments of {shortest_group(sweep)} and more do not show their noise"
        so = (
            "it is taken for that of the other files, in shares of the readings"
            if others_known
            else "errors are by what the fit leaves, and the model's own error is not in them"
        )
        return (f"{few}: {so}; read more points, or state velocity_std_m_s",)
    ratio = scatter_over_stated(sweep)
    if ratio is None or 1 / _DIFFERS < ratio < _DIFFERS:
        return ()
    if sweep.std_of_dwells:
        return (_beside_dwells(ratio),)
    off = "too small" if ratio > 1 else "too large"
    return (
        f"neighbouring points scatter by {ratio:.2g} times the noise that velocity_std_m_s states (median, "
        f"limit {_DIFFERS:g} either way): errors follow what is stated and may be {off}; correct it or leave "
        "the column out",
    )


def remarks_on_strays(sweep: Sweep) -> tuple[str, ...]:
    """Which readings are so far off the curve of those beside them that they are set aside."""
    f = np.unique(np.round(sweep.frequency_hz[strays(sweep) > 0], 4))
    if not len(f):
        return ()
    named = ", ".join(f"{one:g}" for one in f[:_NAMED]) + (", ..." if len(f) > _NAMED else "")
    what = "reading leaves the curve of those" if len(f) == 1 else "readings leave the curve of those"
    return (
        f"{len(f)} {what} beside by more than {BEYOND:g} times what they scatter, set aside "
        f"({named} Hz): a signal lost, an overload, or a resonance narrower than the steps; read them again",
    )


def _beside_dwells(ratio: float) -> str:
    """Of a recorded session: its noise is what the readings of each dwell scatter by, nobody stated it."""
    said = (
        f"neighbouring points scatter by {ratio:.2g} times the noise seen within each dwell (median, limit "
        f"{_DIFFERS:g} either way): "
    )
    if ratio > 1:
        return said + (
            "something changes from point to point that a dwell does not show, as a drift, hum or a narrow "
            "resonance between the steps; errors follow the dwells and may be too small; see Drift and "
            "Quality on Sweep, and measure the segments again in finer steps"
        )
    return said + (
        "something changes within a dwell, as a transient left or hum; errors follow the dwells and may be "
        "too large; longer dwells average it"
    )
