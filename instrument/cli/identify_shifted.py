"""`viscorig identify --shift`: one law over several temperatures."""

from collections.abc import Sequence
from pathlib import Path

import click
import numpy as np

from fitting.errors import OutsideModel
from fitting.mode_tables.table import ModalTable
from fitting.structures import AnySpecimen
from instrument.cli.identify_asked import Asked
from instrument.cli.output import Output
from instrument.cli.print_shifted import print_shifted
from instrument.cli.print_uncertainty import print_in_depth
from instrument.cli.reading import read_tables_at, sweeps_at
from instrument.errors import BadInput
from instrument.files.hammer_file import HammerModes
from instrument.interchange.given import Given
from instrument.interchange.questions import (
    question_modes_at,
    question_numbers,
    question_reference,
    question_shift,
    question_tables,
)
from instrument.progress import bar
from instrument.results.shifted_from import shifted_from
from instrument.results.uncertainty_facts import by_profile, in_depth_facts
from instrument.temperatures.members import AtTemperature
from instrument.temperatures.shifted import Shifted
from instrument.temperatures.shifted import identify_shifted as identify_at_temperatures

_PROFILED = 5
"""Reduced frequencies at which intervals are looked for: each is a dozen fits of all temperatures."""


def identify_shifted(
    out: Output,
    data: Sequence[Path],
    given: Sequence[Given],
    asked: Asked,
    *,
    specimens: Sequence[Path] = (),
    insist: bool = False,
) -> None:
    """Fit sweeps, print, draw; a law that is not simple is refused after its figures and JSON are written."""
    if len(given) < 2:
        raise click.UsageError(f"--shift: {len(given)} file, expected sweeps at two temperatures or more")
    sweeps, stated = sweeps_at(given, data, specimens)
    tested = next(((one.modes, path) for one, path in zip(given, data, strict=True) if one.modes), None)
    if tested is not None and len(stated) > 1:
        raise BadInput("--shift: a hammer test with several plates, expected one plate (or --no-hammer)")
    if tested is not None and any(one.session for one in given):
        out.say(f"the hammer test is that of {tested[1]}\n")
    modes = tested[0] if tested is not None else None
    if not insist:
        question_reference(asked.reference_c, [one.temperature_c for one in sweeps], data)
    found = _fitted(out, sweeps, stated, asked, modes)
    if not insist:
        question_shift(found, data)
    _tell(out, found, sweeps, asked)


def identify_tables_shifted(
    out: Output,
    data: Sequence[Path],
    specimens: Sequence[Path],
    asked: Asked,
    *,
    insist: bool = False,
) -> None:
    """Fit tables of modes as `identify_shifted` does sweeps.

    What no core comes near is refused unless someone insists.
    """
    every, stated = read_tables_at(data, specimens, insist=insist)
    tables = [one.data for one in every if isinstance(one.data, ModalTable)]
    if not insist:
        question_tables(tables, data)
        question_numbers(tables, [stated[one.specimen - 1] for one in every], data)
        question_reference(asked.reference_c, [one.temperature_c for one in every], data)
    found = _fitted(out, every, stated, asked)
    if not insist:
        question_shift(found, data)
        question_modes_at(tables, np.exp(found.fit.one.velocity_m_s.real), data)
    _tell(out, found, every, asked)


def _fitted(
    out: Output,
    every: Sequence[AtTemperature],
    stated: Sequence[AnySpecimen],
    asked: Asked,
    hammer: HammerModes | None = None,
) -> Shifted:
    assert asked.shift is not None
    return identify_at_temperatures(
        every,
        stated,
        asked.shift,
        asked.reference_c,
        bar,
        vertical=asked.vertical,
        hammer=hammer,
        temperature_k=asked.temperature_k,
    )


def _draw(out: Output, found: Shifted, asked: Asked) -> None:
    if asked.figures is not None:
        from instrument.results.shifted_figures import save_shifted_figures

        for path in save_shifted_figures(found, asked.figures):
            out.say(f"saved {path}")


def _tell(out: Output, found: Shifted, every: Sequence[AtTemperature], asked: Asked) -> None:
    result = shifted_from(found, every)
    if found.verdict.simple is False:
        _draw(out, found, asked)
        out.result(result)
        for line in (*found.verdict.advice, *_if_mounted_anew(every)):
            out.say(f"note: {line}")
        raise OutsideModel(found.verdict.said)
    print_shifted(out, result, law_stands=found.verdict.law_stands)
    if asked.depths:
        b = found.band.frequency_hz
        looked = by_profile(found.fit.quantities(np.geomspace(b[0], b[-1], _PROFILED)), bar)
        print_in_depth(out, looked)
        result = result.but(uncertainty=tuple(in_depth_facts(looked)))
    _draw(out, found, asked)
    out.result(result)


def _if_mounted_anew(every: Sequence[AtTemperature]) -> tuple[str, ...]:
    """What else to try of one specimen, said to have stayed where it was."""
    if len({one.specimen for one in every}) > 1 or len({one.name for one in every}) == 1:
        return ()
    return (
        "the specimen is taken to have stayed where it was: if it was mounted anew at each temperature, "
        "state it for each file (--specimen as often, copies of its file under other names)",
    )
