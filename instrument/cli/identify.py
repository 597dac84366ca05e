"""`viscorig identify`: the core's law from a sweep."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import click

from fitting.depth.posterior import SAMPLES
from fitting.errors import OutsideModel
from fitting.pointwise import phase_is_kept
from fitting.specimen import Specimen
from fitting.temperature.shifts import Kind
from instrument.cli.identify_modes import identify_modes
from instrument.cli.identify_shifted import identify_shifted, identify_tables_shifted
from instrument.cli.naming import naming_data
from instrument.cli.options import NumberRange, figures_option, file_arguments, json_option
from instrument.cli.output import Output
from instrument.cli.print_beside import print_beside
from instrument.cli.print_budget import print_budget
from instrument.cli.print_identification import print_bare_plate, print_identification
from instrument.cli.print_run import print_result
from instrument.cli.print_uncertainty import print_in_depth
from instrument.cli.reading import are_tables, read_each, reading_options, together
from instrument.facts.beside import BesideTable
from instrument.facts.budget import BudgetRow
from instrument.facts.identification import IdentificationResult
from instrument.files.dma_file import DmaTable, read_dma
from instrument.files.repeated import refuse_repeats
from instrument.interchange.given import Given
from instrument.material.beside import beside, beside_table
from instrument.material.found_law import law_of_result
from instrument.models.files import File
from instrument.models.identification import Identified, Method
from instrument.models.identification import identify as identify_sweep
from instrument.models.pointwise import pointwise_of
from instrument.models.together import identify_together
from instrument.progress import bar
from instrument.results.budget_from import budget, budget_from
from instrument.results.identification_from import identification_from
from instrument.results.pointwise_from import with_second_look
from instrument.results.session_result import BEFORE_DIAGNOSIS
from instrument.results.together_from import identified_together_from
from instrument.results.uncertainty_facts import Depth, in_depth, in_depth_facts


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
@figures_option("With --pointwise, --with or --shift: save figures as PNG.")
@json_option
@naming_data
def identify(
    data: tuple[Path, ...],
    specimen: tuple[Path, ...],
    method: Method,
    hammer: Path | None,
    no_hammer: bool,
    insist: bool,
    no_viscous_damping: bool,
    pointwise: bool,
    dma: Path | None,
    with_budget: bool,
    depths: tuple[Depth, ...],
    samples: int,
    shift: Kind | None,
    reference_c: float | None,
    temperature_k: float | None,
    vertical: bool,
    bare: Path | None,
    figures: Path | None,
    json_path: str | None,
) -> None:
    """The core's complex shear modulus from DATA, with its uncertainty.

    DATA is a sweep (.csv), a recorded session (.h5), or an FRF of the pickup over the base's acceleration
    (.csv, .uff, .unv, .mat), or a table of modes (.csv: mode, frequency_hz, loss_factor). Several are fitted
    together: one law, each file its own specimen and channels.
    """
    if pointwise and method == "paper":
        raise click.UsageError("--pointwise and --method paper: expected the direct method")
    if figures is not None and not pointwise and dma is None and shift is None:
        raise click.UsageError(
            "--figures shows the law band by band, expected --pointwise, --with or --shift"
        )
    if shift is None and (reference_c is not None or temperature_k is not None or vertical):
        raise click.UsageError("--reference-c, --temperature-k and --vertical: expected --shift with them")
    out = Output(json_path)
    refuse_repeats(data)
    if are_tables(data, specimen):
        if pointwise or method == "paper" or hammer is not None or dma is not None or with_budget or depths:
            raise click.UsageError(
                "--pointwise, --method paper, --hammer, --with, --budget, --uncertainty with modal tables: "
                "expected sweeps"
            )
        if shift is not None:
            if bare is not None or no_viscous_damping:
                raise click.UsageError(
                    "--bare and --no-viscous-damping with --shift: expected tables of treated specimens alone"
                )
            identify_tables_shifted(
                out,
                data,
                specimen,
                shift,
                reference_c,
                figures,
                vertical=vertical,
                temperature_k=temperature_k,
                insist=insist,
            )
            return
        identify_modes(out, data, specimen, bare, insist=insist)
        return
    if bare is not None:
        raise click.UsageError("--bare: expected a table of modes of a beam")
    at_temperatures = shift is not None
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
    if shift is not None:
        if pointwise or method == "paper" or no_viscous_damping or dma is not None or with_budget or depths:
            raise click.UsageError(
                "--shift goes with --reference-c, --temperature-k, --vertical, --hammer and --figures alone"
            )
        identify_shifted(
            out,
            data,
            every,
            shift,
            reference_c,
            figures,
            vertical=vertical,
            temperature_k=temperature_k,
            specimens=specimen,
            insist=insist,
        )
        return
    files = together(every, data)
    if files is not None:
        if pointwise or method == "paper" or no_viscous_damping or dma is not None:
            raise click.UsageError(
                "--pointwise, --method, --no-viscous-damping, --with: expected one plate read at one spot"
            )
        if set(depths) - {"profile"}:
            of = "several files or spots" if len(files) > 1 else f"a {files[0].specimen.kind}"
            raise click.UsageError(f"--uncertainty posterior and bootstrap with {of}: expected profile")
        _identify_together(out, files, every, depths, with_budget=with_budget)
        return
    given = every[0]
    read = given.specimen
    assert isinstance(read, Specimen)
    if no_viscous_damping:
        read = replace(read, modal_ratios=(0.0,))
    if pointwise:
        # Said before the work, not after it.
        phase_is_kept(given.sweep)
    table = _table(dma, read)
    found: Identified = identify_sweep(given.sweep, read, method, bar, given.modes)
    if given.recorded is not None:
        out.say(f"the law {BEFORE_DIAGNOSIS}, which the session's own result below is not:\n")
    print_identification(out, found, read)
    result = identification_from(found, read)
    if found.bare is not None:
        print_bare_plate(out, found.bare, read)
    if with_budget:
        result = result.but(budget=_budget(out, found))
    if depths:
        looked = [one for d in dict.fromkeys(depths) for one in _in_depth(out, found, d, samples)]
        result = result.but(uncertainty=tuple(looked))
    if pointwise:
        bands = pointwise_of(found)
        out.say(bands.words)
        result = with_second_look(result, bands)
        if figures is not None:
            from instrument.results.pointwise_figures import save_pointwise_figure

            out.say(f"saved {save_pointwise_figure(bands, found.result.band, figures)}")
    if table is not None:
        result = result.but(beside=_beside(out, table, data[0], result, figures))
    if given.recorded is not None:
        out.say()
        print_result(out, given.recorded)
    out.result(given.said(result))


def _budget(out: Output, found: Identified) -> tuple[BudgetRow, ...] | None:
    """By source, at a few frequencies."""
    by_source = budget(found)
    if by_source is None:
        out.say("no budget: these data give no uncertainty, or the method none of its own")
        return None
    rows = budget_from(by_source)
    print_budget(out, rows)
    return rows


def _in_depth(out: Output, found: Identified, method: Depth, samples: int) -> list[dict[str, Any]]:
    looked = in_depth(found, method, samples, bar)
    if looked is None:
        out.say(f"no {method}: these data give no uncertainty, or the method none of its own")
        return []
    print_in_depth(out, looked)
    return in_depth_facts(looked)


def _table(dma: Path | None, specimen: Specimen) -> DmaTable | None:
    """Read before the work, not after it."""
    if dma is None:
        return None
    if specimen.core is None:
        raise OutsideModel("a bare plate has no core to identify, expected [core] and [constraining]")
    return read_dma(dma, specimen.core.poisson)


def _beside(
    out: Output, table: DmaTable, data: Path, result: IdentificationResult, figures: Path | None
) -> BesideTable | None:
    """The table beside the law just found."""
    law = law_of_result(data, result)
    if law is None:
        out.say("the law found has no band, nothing to compare with")
        return None
    found = beside(law, table)
    said = beside_table(table, found)
    print_beside(out, table, found, said)
    if figures is not None:
        from instrument.material.overlay import save_overlay

        out.say(f"saved {save_overlay(law, table, figures)}")
    return said


def _identify_together(
    out: Output,
    files: Sequence[File],
    every: Sequence[Given],
    depths: Sequence[Depth],
    *,
    with_budget: bool,
) -> None:
    only = every[0] if len(every) == 1 else None
    together = identify_together(files, bar, every[0].modes)
    found, plate = together.found, files[0].specimen
    print_identification(out, found, plate)
    if found.bare is not None and isinstance(plate, Specimen):
        print_bare_plate(out, found.bare, plate)
    result = identified_together_from(together, files)
    if with_budget:
        result = result.but(budget=_budget(out, found))
    if depths:
        looked = [one for d in dict.fromkeys(depths) for one in _in_depth(out, found, d, SAMPLES)]
        result = result.but(uncertainty=tuple(looked))
    if only is not None and only.recorded is not None:
        out.say()
        print_result(out, only.recorded)
    out.result(result if only is None else only.said(result))
