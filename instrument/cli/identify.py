"""`viscorig identify`: the core's law from a sweep."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import click

from fitting.depth.posterior import SAMPLES
from instrument.cli.identify_asked import Asked
from instrument.cli.identify_modes import identify_modes
from instrument.cli.identify_shifted import identify_shifted, identify_tables_shifted
from instrument.cli.identify_sweeps import identify_sweeps
from instrument.cli.naming import naming_files
from instrument.cli.options import NumberRange, figures_option, file_arguments, json_option
from instrument.cli.output import Output
from instrument.cli.reading import are_tables, read_each, reading_options
from instrument.files.repeated import refuse_repeats


@click.command()
@file_arguments("data")
@reading_options
@click.option(
    "--method",
    type=click.Choice(["direct", "paper"]),
    default="direct",
    show_default=True,
    help="Bounded least squares on the full equation, or the paper's Eq. (20) to (25) on real modes.",
)
@click.option(
    "--no-viscous-damping",
    is_flag=True,
    help="Leave the remaining viscous damping out, as in the paper's Fig. 10.",
)
@click.option(
    "--pointwise",
    is_flag=True,
    help="Also G* band by band without a law, and whether G' and eta are those of one causal core.",
)
@click.option(
    "--with",
    "dma",
    type=click.Path(path_type=Path),
    metavar="DMA.csv",
    help="Compare with somebody's table: frequency_hz, temperature_c, storage_modulus_pa, loss_factor or "
    "loss_modulus_pa; a line '# kind: tension' where it is not of shear.",
)
@click.option(
    "--budget",
    "with_budget",
    is_flag=True,
    help="Also the uncertainty of G' and eta by source: noise, model error, every tolerance.",
)
@click.option(
    "--uncertainty",
    "depths",
    type=click.Choice(["profile", "posterior", "bootstrap"]),
    multiple=True,
    help="Also intervals by profile likelihood, by sampling the posterior (extra 'posterior') or by "
    "bootstrap, beside the linear errors; may be given more than once.",
)
@click.option(
    "--samples",
    type=click.IntRange(2_000, 10_000_000),
    default=SAMPLES,
    show_default=True,
    help="With --uncertainty posterior: how many.",
)
@click.option(
    "--shift",
    type=click.Choice(["wlf", "arrhenius", "free"]),
    help="Data are of several temperatures (column temperature_c): one law in reduced frequency, shifted so. "
    "Of plates, beams or shear pairs; sweeps, a temperature a file, or tables of modes, any number in each.",
)
@click.option(
    "--reference-c",
    type=float,
    help="With --shift: the temperature of the law; the middle one otherwise.",
)
@click.option(
    "--temperature-k",
    type=NumberRange(min=0.0),
    help="With --shift: standard deviation of each stated temperature; 0.3 otherwise, 0 where everything "
    "stated is exact.",
)
@click.option(
    "--vertical", is_flag=True, help="With --shift: the modulus of a temperature may be off by a factor."
)
@click.option(
    "--bare",
    type=click.Path(path_type=Path),
    metavar="BARE.csv",
    help="With a treated beam's table of modes: the bare beam's, for the formulas of ASTM E756 beside the "
    "full model.",
)
@figures_option(
    "With --pointwise, --with or --shift: save figures as PNG.",
    "pointwise-law.png",
    "with-dma.png",
    "nomogram.png",
    "simplicity.png",
)
@json_option
@naming_files
def identify(
    data: tuple[Path, ...],
    specimen: tuple[Path, ...],
    hammer: Path | None,
    no_hammer: bool,
    insist: bool,
    json_path: str | None,
    **options: Any,
) -> None:
    """The core's complex shear modulus from DATA, with its uncertainty.

    DATA is a sweep (.csv), a recorded session (.h5), or an FRF of the pickup over the base's acceleration
    (.csv, .uff, .unv, .mat), or a table of modes (.csv: mode, frequency_hz, loss_factor). Several are fitted
    together: one law, each file its own specimen and channels.
    """
    asked = Asked(**options)
    asked.check()
    out = Output(json_path)
    refuse_repeats(data)
    if are_tables(data, specimen):
        asked.check_tables(hammer=hammer is not None)
        _identify_tables(out, data, specimen, asked, insist=insist)
        return
    if asked.bare is not None:
        raise click.UsageError("--bare: expected a table of modes of a beam")
    at_temperatures = asked.shift is not None
    every = read_each(
        out,
        data,
        specimen,
        hammer,
        no_hammer=no_hammer,
        insist=insist,
        one_plate=True,
        own_hammer=at_temperatures and hammer is None,
        at_temperatures=at_temperatures,
    )
    if asked.shift is not None:
        asked.check_shift()
        identify_shifted(
            out,
            data,
            every,
            asked,
            specimens=specimen,
            insist=insist,
        )
        return
    identify_sweeps(out, data, every, asked)


def _identify_tables(
    out: Output, data: Sequence[Path], specimen: Sequence[Path], asked: Asked, *, insist: bool
) -> None:
    if asked.shift is None:
        identify_modes(out, data, specimen, asked.bare, profiled=bool(asked.depths), insist=insist)
        return
    identify_tables_shifted(
        out,
        data,
        specimen,
        asked,
        insist=insist,
    )
