"""An identification as people read it."""

import numpy as np

from fitting.identification.bare_plate import BarePlateFit
from fitting.identification.result import Identification
from fitting.specimen import PlateSpecimen, StatedSpecimen
from fitting.sweep import Sweep
from instrument.cli.output import Output
from instrument.finding.identification import Identified
from instrument.results.adjusted_words import COLUMNS, adjusted_rows, more_adjusted
from instrument.results.error_words import is_below_floor, percent_words
from instrument.results.law_words import LAW_COLUMNS, a_few, law_cells, sources_words
from instrument.results.numbers import error_beside, to_error
from instrument.results.rows_from import law_rows_from

_MOST_ROWS = 30


def print_identification(out: Output, found: Identified) -> None:
    """What was found, how well it is known, and what the data do not say."""
    r, sweep, stated = found.result, found.sweep, found.files[0].specimen
    errors = r.standard_errors
    values = zip(r.law.names, r.law.values.tolist(), strict=True)
    rows = [[n, to_error(v, errors[n]), _relative(errors[n], v)] for n, v in values]
    out.table(f"{r.law.kind} by {r.method}", ["parameter", "value", "standard error"], rows)
    out.say()
    _print_band(out, r)
    if len(sweep) <= _MOST_ROWS:
        out.say()
        _print_points(out, r, sweep)
    out.say()
    out.say(f"difference in amplitude: rms {r.rms_percent:.2f} %, largest {r.max_percent:.2f} %")
    _print_validation(out, r)
    _print_adjusted(out, r, stated)
    for warning in r.warnings:
        out.say(f"note: {warning}")
    out.say(
        f"{len(sweep)} points, {r.fit.iterations} iterations; set-up {found.setup_seconds:.2f} s, "
        f"fit {found.seconds * 1e3:.0f} ms, validation {found.validation_seconds * 1e3:.0f} ms"
    )
    if found.bare is not None and isinstance(stated, PlateSpecimen):
        _print_bare_plate(out, found.bare, stated)


def _print_bare_plate(out: Output, bare: BarePlateFit, specimen: PlateSpecimen) -> None:
    """What the hammer test gives by itself; `specimen` as stated."""
    young, error = specimen.substrate.young_pa * bare.young_scale / 1e9, 100 * bare.standard_error
    worst = 100 * np.max(np.abs(bare.measured_hz / bare.fitted_hz - 1))
    out.say(
        f"hammer test by itself: substrate {young:.2f} GPa +- {error:.2f} %, "
        f"{100 * (bare.young_scale - 1):+.2f} % from the stated; "
        f"its own clamp takes {bare.clamp_percent:.2f} % off mode 1; "
        f"{len(bare.measured_hz)} modes within {worst:.2f} %"
    )
    if bare.left_out_hz:
        out.say(f"note: hammer modes that match none: {', '.join(f'{f:.2f}' for f in bare.left_out_hz)} Hz")


def _relative(error: float, value: float) -> str:
    if not np.isfinite(error) or error <= 0:
        return "-"
    percent = f"{percent_words(error, value)} %"
    return percent if is_below_floor(error, value) else f"{error_beside(value, error)} ({percent})"


def _print_band(out: Output, r: Identification) -> None:
    out.table(
        f"the law in the measured band, +- one standard error ({sources_words(r.method, r.noise.source)})",
        list(LAW_COLUMNS),
        law_cells(a_few(law_rows_from(r.band))),
    )


def _print_adjusted(out: Output, r: Identification, specimen: StatedSpecimen) -> None:
    found = r.fit.adjusted
    if not found:
        return
    out.say()
    out.table("stated numbers the data moved", list(COLUMNS), adjusted_rows(found, specimen))
    more = more_adjusted(found)
    if more:
        out.say(more)
    out.say()


def _print_points(out: Output, r: Identification, sweep: Sweep) -> None:
    rows = [
        [f"{f:g}", f"{m:.5g}", f"{p:.5g}", f"{d:+.2f}"]
        for f, m, p, d in zip(
            sweep.frequency_hz, r.measured_m_s, r.predicted_m_s, r.difference_percent, strict=True
        )
    ]
    columns = ["frequency/Hz", "measured/(m/s)", "predicted/(m/s)", "difference/%"]
    out.table("point by point", columns, rows)


def _print_validation(out: Output, r: Identification) -> None:
    v = r.validation
    if v.leave_one_out_rms_percent is not None:
        out.say(f"each point predicted from the others: rms {v.leave_one_out_rms_percent:.2f} %")
    for h in v.held_out:
        noise = f" (noise {h.noise_percent:.2f} %)" if np.isfinite(h.noise_percent) else ""
        out.say(f"segment {h.segment} predicted from the others: rms {h.rms_percent:.2f} %{noise}")
    if r.chi2_means_something:
        out.say(
            f"chi-square per degree of freedom {r.uncertainty.chi2_per_dof:.3g}, noise by {r.noise.source}"
        )
    elif r.noise.source == "misfit":
        out.say("no chi-square: readings count for as much as the fit leaves of them, not for their noise")
