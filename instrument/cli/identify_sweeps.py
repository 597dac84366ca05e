"""`viscorig identify` of sweeps: one plate read at one spot, or files under one law."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from fitting.errors import OutsideModel
from fitting.identification.pointwise import phase_is_kept
from fitting.specimen import PlateSpecimen
from instrument.cli.identify_asked import Asked
from instrument.cli.output import Output
from instrument.cli.print_beside import print_beside
from instrument.cli.print_budget import print_budget
from instrument.cli.print_identification import print_identification
from instrument.cli.print_run import print_result
from instrument.cli.print_uncertainty import print_in_depth
from instrument.cli.reading import files_of_data
from instrument.facts.beside import BesideTable
from instrument.facts.budget import BudgetRow
from instrument.facts.identification import IdentificationResult
from instrument.facts.intervals import IntervalsFound
from instrument.files.dma_file import DmaTable, read_dma
from instrument.finding.identification import Identified, identify
from instrument.finding.pointwise import pointwise_of
from instrument.interchange.given import Given
from instrument.material.beside import beside, beside_table
from instrument.material.found_law import law_of_result
from instrument.models.files import lone_plate
from instrument.progress import bar
from instrument.results.budget_from import budget, budget_from
from instrument.results.identification_from import identification_from
from instrument.results.pointwise_from import with_second_look
from instrument.results.session_result import BEFORE_DIAGNOSIS
from instrument.results.uncertainty_facts import Depth, in_depth, in_depth_facts


def identify_sweeps(out: Output, data: Sequence[Path], every: Sequence[Given], asked: Asked) -> None:
    """Everything that was asked for. Raises `BadInput`, `FittingError`, `UsageError`."""
    files = files_of_data(every, data)
    plate = lone_plate(files)
    if plate is None:
        asked.check_together(files)
    elif asked.no_viscous_damping:
        plate = replace(plate, modal_ratios=(0.0,))
        files = [replace(files[0], specimen=plate)]
    if asked.pointwise:
        # Said before the work, not after it.
        phase_is_kept(files[0].sweep)
    table = _table(asked.dma, plate) if plate is not None else None
    found = identify(files, asked.method, bar, every[0].modes)
    recorded = every[0].recorded if len(every) == 1 else None
    if recorded is not None and plate is not None:
        out.say(f"the law {BEFORE_DIAGNOSIS}, which the session's own result below is not:\n")
    print_identification(out, found)
    result = _looked_deeper(out, found, identification_from(found), asked)
    if asked.pointwise:
        result = _pointwise(out, found, result, asked.figures)
    if table is not None:
        result = result.but(beside=_beside(out, table, data[0], result, asked.figures))
    if recorded is not None:
        out.say()
        print_result(out, recorded)
    out.result(every[0].said(result) if len(every) == 1 else result)


def _looked_deeper(
    out: Output, found: Identified, result: IdentificationResult, asked: Asked
) -> IdentificationResult:
    """With the budget and the intervals that were asked for."""
    if asked.with_budget:
        result = result.but(budget=_budget(out, found))
    if asked.depths:
        looked = [one for d in dict.fromkeys(asked.depths) for one in _in_depth(out, found, d, asked.samples)]
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


def _table(dma: Path | None, specimen: PlateSpecimen) -> DmaTable | None:
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
