"""`viscorig plan`: what to measure, before anything is."""

from pathlib import Path

import click

from fitting.gravity import PUBLISHED_G_M_S2
from fitting.planning.sensitivity import ReadingNoise
from fitting.specimen import PlateSpecimen
from instrument.cli.naming import naming_files
from instrument.cli.options import (
    Level,
    NumberRange,
    acceleration_option,
    figures_option,
    file_argument,
    force_option,
    json_option,
)
from instrument.cli.output import Output
from instrument.cli.print_plan import print_plan
from instrument.errors import BadInput
from instrument.files.acceleration import in_both
from instrument.files.hammer_file import read_hammer
from instrument.files.plausible import question_specimen
from instrument.files.structure_file import read_structure
from instrument.planning.into_experiment import begun, write_into
from instrument.planning.plan import make_plan
from instrument.planning.result import result_of
from instrument.planning.wish import CAUSES_SHARE, NOISE, TARGET, Wish
from instrument.progress import bar

_LEAST_RATIO = 1.05
_LOWEST_HZ = 0.01
"""Of a band: no shaker sweeps below, and a plan of decades without a resonance takes minutes, or for ever."""


class Band(click.ParamType):  # type: ignore[type-arg]
    """`LOW:HIGH` in Hz."""

    name = "LOW:HIGH"

    def convert(
        self, value: object, param: click.Parameter | None, ctx: click.Context | None
    ) -> tuple[float, float]:
        """Both in Hz."""
        try:
            low, high = (float(part) for part in str(value).split(":"))
        except ValueError:
            self.fail(f"{value!r}, expected LOW:HIGH in Hz", param, ctx)
        if not 0 < low * _LEAST_RATIO <= high < 1e5:
            self.fail(f"{value!r}, expected 0 < LOW < HIGH in Hz, at least 5 % apart", param, ctx)
        if low < _LOWEST_HZ:
            self.fail(f"{value!r}, expected LOW of at least {_LOWEST_HZ:g} Hz", param, ctx)
        return low, high


@click.command()
@file_argument("specimen")
@click.option(
    "--target",
    type=NumberRange(0.01, 100),
    default=100 * TARGET,
    show_default=True,
    metavar="PERCENT",
    help="Standard error of G' and of the loss factor wanted everywhere in the band.",
)
@click.option("--band", type=Band(), help="In Hz; around the first three resonances where none is given.")
@click.option(
    "--noise",
    type=NumberRange(0, 100),
    default=100 * NOISE.share,
    show_default=True,
    metavar="PERCENT",
    help="What repeated readings scatter, of the reading (each part of the phasor).",
)
@click.option(
    "--floor",
    type=NumberRange(0, 1e6),
    default=1e6 * NOISE.floor_m_s,
    show_default=True,
    metavar="UM_S",
    help="Velocity noise of a reading over one second, in um/s.",
)
@click.option(
    "--level",
    type=Level(),
    help="Of the base: 0.5 or 0.5g as `level_g` counts it, or 4.9m/s2; proposed where none is given.",
)
@click.option(
    "--causes",
    type=NumberRange(0, 80),
    default=100 * CAUSES_SHARE,
    show_default=True,
    metavar="PERCENT",
    help="Share of rig time for steps that separate what the model may lack.",
)
@click.option(
    "--hammer",
    type=click.Path(path_type=Path),
    help="JSON of 'viscorig damping' on the bare plate: known beside the sweep.",
)
@click.option("--no-spots", is_flag=True, help="Do not compare other spots: half of the time.")
@click.option(
    "--experiment",
    type=click.Path(path_type=Path),
    help="Write the plan as the [sweep] of this experiment file; a new one where there is none.",
)
@force_option
@acceleration_option
@figures_option(
    "Save the plan on the response, and the map of spots, as PNG.", "plan-errors.png", "plan-spots.png"
)
@json_option
@naming_files
def plan(
    specimen: Path,
    target: float,
    band: tuple[float, float] | None,
    noise: float,
    floor: float,
    level: float | None,
    causes: float,
    hammer: Path | None,
    no_spots: bool,
    insist: bool,
    experiment: Path | None,
    figures: Path | None,
    json_path: str | None,
) -> None:
    """Steps, level and spot for SPECIMEN.toml and a wanted uncertainty, and what they could not tell.

    Predicted to first order about the law that the file states, with its tolerances, the model's own error
    and the noise given here. Nothing is connected.
    """
    out = Output(json_path)
    read = read_structure(specimen)
    if not isinstance(read, PlateSpecimen):
        raise BadInput(
            f"{specimen}: a {read.kind}, expected a plate: other specimens are not planned for yet"
        )
    if read.force_m is not None:
        raise BadInput(
            f"{specimen}: a plate that a force drives, expected one on a base: what is planned are steps of "
            "a shaker"
        )
    question_specimen(specimen, insist=insist)
    wish = Wish(
        target=target / 100,
        band_hz=band,
        noise=ReadingNoise(floor * 1e-6, noise / 100),
        level_g=level,
        causes_share=causes / 100,
    )
    if noise == 0 and floor == 0:
        raise click.UsageError("--noise 0 and --floor 0: expected one above zero, no reading is exact")
    limit = wish.settings.limits.base_m_s2
    if level is not None and level * PUBLISHED_G_M_S2 > limit:
        raise BadInput(f"--level {level:g}g is {in_both(level * PUBLISHED_G_M_S2)}, limit {in_both(limit)}")
    # Said before the work, not after it.
    text = begun(experiment, specimen) if experiment is not None else ""
    hit = read_hammer(hammer) if hammer is not None else None
    found = result_of(make_plan(read, wish, hit, bar, with_spots=not no_spots), wish)
    print_plan(out, found)
    if experiment is not None:
        write_into(experiment, text, found.sweep_toml)
        out.say(f"\nwritten as the [sweep] of {experiment}")
    if figures is not None:
        from instrument.results.plan_figures import save_plan_figures

        for path in save_plan_figures(found, figures):
            out.say(str(path))
    out.result(found)
