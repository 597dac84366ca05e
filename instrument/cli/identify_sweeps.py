"""`viscorig identify` of sweeps: one plate read at one spot, or files under one law."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from fitting.depth.posterior import SAMPLES
from fitting.errors import OutsideModel
from fitting.identification.pointwise import phase_is_kept
from fitting.specimen import Specimen
from instrument.cli.identify_asked import Asked
from instrument.cli.output import Output
from instrument.cli.print_beside import print_beside
from instrument.cli.print_budget import print_budget
from instrument.cli.print_identification import print_bare_plate, print_identification
from instrument.cli.print_run import print_result
from instrument.cli.print_uncertainty import print_in_depth
from instrument.facts.beside import BesideTable
from instrument.facts.budget import BudgetRow
from instrument.facts.identification import IdentificationResult
from instrument.facts.intervals import IntervalsFound
from instrument.files.dma_file import DmaTable, read_dma
from instrument.interchange.given import Given
from instrument.material.beside import beside, beside_table
from instrument.material.found_law import law_of_result
from instrument.models.files import File
from instrument.models.identification import Identified
from instrument.models.identification import identify as identify_sweep
from instrument.models.pointwise import pointwise_of
from instrument.models.together import identify_together
from instrument.progress import bar
from instrument.results.budget_from import budget, budget_from
from instrument.results.identification_from import identification_from
from instrument.results.pointwise_from import with_second_look
from instrument.results.session_result import BEFORE_DIAGNOSIS
from instrument.results.uncertainty_facts import Depth, in_depth, in_depth_facts


def identify_one(out: Output, data: Path, given: Given, asked: Asked) -> None:
    """One plate read at one spot: everything that was asked for."""
    read = given.specimen
    assert isinstance(read, Specimen)
    if asked.no_viscous_damping:
        read = replace(read, modal_ratios=(0.0,))
    if asked.pointwise:
        # Said before the work, not after it.
        phase_is_kept(given.sweep)
    table = _table(asked.dma, read)
    found: Identified = identify_sweep(given.sweep, read, asked.method, bar, given.modes)
    if given.recorded is not None:
        out.say(f"the law {BEFORE_DIAGNOSIS}, which the session's own result below is not:\n")
    print_identification(out, found, read)
    result = identification_from(found)
    if found.bare is not None:
        print_bare_plate(out, found.bare, read)
    result = _looked_deeper(out, found, result, asked, asked.samples)
    if asked.pointwise:
        result = _pointwise(out, found, result, asked.figures)
    if table is not None:
        result = result.but(beside=_beside(out, table, data, result, asked.figures))
    if given.recorded is not None:
        out.say()
        print_result(out, given.recorded)
    out.result(given.said(result))


def identify_files(out: Output, files: Sequence[File], every: Sequence[Given], asked: Asked) -> None:
    """Several files or spots under one law, or one file of something else than a plate."""
    only = every[0] if len(every) == 1 else None
    found, plate = identify_together(files, bar, every[0].modes), files[0].specimen
    print_identification(out, found, plate)
    if found.bare is not None and isinstance(plate, Specimen):
        print_bare_plate(out, found.bare, plate)
    result = identification_from(found)
    result = _looked_deeper(out, found, result, asked, SAMPLES)
    if only is not None and only.recorded is not None:
        out.say()
        print_result(out, only.recorded)
    out.result(result if only is None else only.said(result))


def _looked_deeper(
    out: Output, found: Identified, result: IdentificationResult, asked: Asked, samples: int
) -> IdentificationResult:
    """With the budget and the intervals that were asked for."""
    if asked.with_budget:
        result = result.but(budget=_budget(out, found))
    if asked.depths:
        looked = [one for d in dict.fromkeys(asked.depths) for one in _in_depth(out, found, d, samples)]
        result = result.but(uncertainty=tuple(looked))
    return result


def _pointwise(
    out: Output, found: Identified, result: IdentificationResult, figures: Path | None
) -> IdentificationResult:
    bands = pointwise_of(found)
    out.say(bands.words)
    if figures is not None:
        from instrument.results.pointwise_figures import save_pointwise_figure

        out.say(f"saved {save_pointwise_figure(bands, found.result.band, figures)}")
    return with_second_look(result, bands)


def _budget(out: Output, found: Identified) -> tuple[BudgetRow, ...] | None:
    """By source, at a few frequencies."""
    by_source = budget(found)
    if by_source is None:
        out.say("no budget: these data give no uncertainty, or the method none of its own")
        return None
    rows = budget_from(by_source)
    print_budget(out, rows)
    return rows


def _in_depth(out: Output, found: Identified, method: Depth, samples: int) -> list[IntervalsFound]:
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
