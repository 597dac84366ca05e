"""`viscorig damping`: natural frequencies and damping ratios from impact tests."""

from pathlib import Path

import click

from fitting.modal.frf import DampingEstimate, Refusal
from instrument.cli.naming import naming_records
from instrument.cli.options import (
    DECIMAL_COMMA,
    NumberRange,
    figures_option,
    file_arguments,
    is_decimal_comma,
    json_option,
)
from instrument.cli.output import Output
from instrument.errors import BadInput
from instrument.files.records import Named, read_records
from instrument.files.repeated import refuse_repeats
from instrument.impact.damping import Damping, damping_of_frfs, damping_of_hits
from instrument.impact.judge import judge
from instrument.impact.record import Hit
from instrument.impact.result import damping_from
from instrument.impact.spectra import Estimator
from instrument.results.error_words import ratio_words

_HIGHEST_RATE = 1e8


def _band(_: click.Context, __: click.Parameter, text: str | None) -> tuple[float, float] | None:
    if text is None:
        return None
    try:
        low, high = (float(part) for part in text.split(":"))
    except ValueError:
        raise click.BadParameter(f"{text!r}, expected LOW:HIGH in Hz") from None
    if not 0 <= low < high < float("inf"):
        raise click.BadParameter(f"{text!r}, expected LOW below HIGH, both in Hz")
    return low, high


def _at(_: click.Context, __: click.Parameter, text: str | None) -> tuple[float, ...]:
    if text is None:
        return ()
    try:
        found = tuple(float(part) for part in text.split(","))
    except ValueError:
        raise click.BadParameter(f"{text!r}, expected F1,F2,... in Hz") from None
    if is_decimal_comma(text):
        raise click.BadParameter(DECIMAL_COMMA.format(text))
    if not all(0 < f < float("inf") for f in found):
        raise click.BadParameter(f"{text!r}, expected frequencies above 0 Hz")
    return found


@click.command()
@file_arguments("records", "RECORD...")
@click.option("--band", callback=_band, metavar="LOW:HIGH", help="Where to look for modes, in Hz.")
@click.option(
    "--at", callback=_at, metavar="F1,F2,...", help="Modes by name, in Hz, instead of looking for them."
)
@click.option("--force", metavar="NAME", help="The force channel, where the file does not say.")
@click.option(
    "--response", metavar="NAME[:UNIT],...", help="The response channels, where the file does not say."
)
@click.option(
    "--rate",
    type=NumberRange(min=0, min_open=True),
    help="Samples a second, where the file does not say.",
)
@click.option("--estimator", type=click.Choice(["h1", "h2", "hv"]), default="h1", show_default=True)
@click.option(
    "--exponential",
    type=NumberRange(0, 100, min_open=True, max_open=True),
    metavar="PERCENT",
    help="Exponential window ending at this, its damping taken off again. Half power always has one (1 %).",
)
@figures_option("Folder for figures.", "frf.png", "hits.png", "modes.png")
@json_option
def damping(
    records: tuple[Path, ...],
    band: tuple[float, float] | None,
    at: tuple[float, ...],
    force: str | None,
    response: str | None,
    rate: float | None,
    estimator: Estimator,
    exponential: float | None,
    figures: Path | None,
    json_path: str | None,
) -> None:
    """Natural frequencies and damping ratios of impact RECORDs (averaged) or of one FRF.

    Half power, a local rational fit and LSCF side by side; the rational fit is adopted.
    Files: .csv, .lvm, .uff, .unv, .mat.
    """
    out = Output(json_path)
    if rate is not None and not rate < _HIGHEST_RATE:
        raise BadInput(f"--rate {rate:g}, expected samples a second below {_HIGHEST_RATE:g}")
    refuse_repeats(records)
    named = Named(force, tuple(response.split(",")) if response else (), rate)
    read = [read_records(path, named) for path in records]
    if any(isinstance(r, dict) for r in read):
        if len(read) > 1 or not isinstance(read[0], dict):
            raise BadInput("FRFs are read one file at a time, and not beside records")
        with naming_records(records):
            found = damping_of_frfs(read[0], band_hz=band, at_hz=at)
    else:
        hits = [hit for r in read for hit in r if isinstance(hit, Hit)]
        _check_alike(hits)
        end = exponential / 100 if exponential else None
        judged = [judge(hit) for hit in hits]
        with naming_records(records):
            found = damping_of_hits(judged, band_hz=band, at_hz=at, estimator=estimator, end_value=end)
    _print(out, found)
    if figures is not None:
        from instrument.impact.figures import damping_figures
        from instrument.results.saved_figures import save_figures

        for path in save_figures(damping_figures(found), figures, 130):
            out.say(f"saved {path}")
    out.result(damping_from(found))


def _check_alike(hits: list[Hit]) -> None:
    first = hits[0]
    for hit in hits[1:]:
        same_rate = abs(hit.sample_rate_hz / first.sample_rate_hz - 1) < 1e-4
        if len(hit.force_n) != len(first.force_n) or not same_rate:
            raise BadInput(
                f"{hit.source}: {len(hit.force_n)} samples at {hit.sample_rate_hz:g}/s, expected "
                f"{len(first.force_n)} at {first.sample_rate_hz:g}/s as in {first.source}"
            )
        if [c.name for c in hit.responses] != [c.name for c in first.responses]:
            raise BadInput(f"{hit.source}: other channels than {first.source}")


def _print(out: Output, found: Damping) -> None:
    rows = [
        [
            f"{m.frequency_hz:.3f}",
            ratio_or_refusal(m.rational_fit),
            ratio_or_refusal(m.half_power),
            ratio_or_refusal(m.lscf),
            f"{m.lines_in_bandwidth:.1f}",
            m.channel,
            m.why or "-",
        ]
        for m in found.modes
    ]
    columns = ["f/Hz", "rational fit/%", "half power/%", "LSCF/%", "lines", "channel", "remarks"]
    low, high = found.band_hz
    title = (
        "damping ratio by three methods, +- one standard error by these hits' noise, half power's with what "
        "it is off the fit"
    )
    out.table(f"{low:.3g} to {high:.4g} Hz: {title}", columns, rows)
    for warning in found.warnings:
        out.say(f"note: {warning}")


def ratio_or_refusal(e: DampingEstimate | Refusal) -> str:
    """A damping ratio in percent with its standard error, or that the method refused the mode."""
    if isinstance(e, Refusal):
        return "refused"
    return ratio_words(e.ratio, e.standard_error)
