"""`viscorig compare`: which laws differ beyond their uncertainties, and where."""

from functools import partial
from itertools import combinations
from pathlib import Path

import click
import numpy as np

from fitting.digits import band, tail
from instrument.cli.options import NumberRange, file_arguments, json_option
from instrument.cli.output import Output
from instrument.facts.comparison import CompareResult
from instrument.material.comparing import LEVEL, Comparison, compared_pair
from instrument.material.comparing import compare as compare_laws
from instrument.material.found_law import read_law
from instrument.material.remarks import remarks_on_law, remarks_on_one_specimen, remarks_on_pair
from instrument.material.spread import spread_of
from instrument.material.spread_facts import spread_result
from instrument.progress import bar
from instrument.results.numbers import signed

_SAYS = {True: "differ", False: "not told apart", None: "cannot be told"}


@click.command()
@file_arguments("files")
@click.option(
    "--spread",
    "with_spread",
    is_flag=True,
    help="Also the spread between specimens, told from the uncertainty of each: three laws or more.",
)
@click.option(
    "--remounts",
    is_flag=True,
    help="FILES are one specimen, mounted anew for each: also the repeatability from mount to mount, told "
    "from the uncertainty of each law: three or more.",
)
@click.option(
    "--same-specimen",
    is_flag=True,
    help="FILES are of one specimen, measured again: what its own stated numbers are off by is alike in all "
    "of them, and makes no difference.",
)
@click.option(
    "--repeatability",
    "repeatability_percent",
    type=NumberRange(0, 100),
    default=0.0,
    metavar="PERCENT",
    help="Of G' and of eta from mount to mount, where it is known: counted in beside each law's own errors.",
)
@json_option
def compare(
    files: tuple[Path, ...],
    with_spread: bool,
    remounts: bool,
    same_specimen: bool,
    repeatability_percent: float,
    json_path: str | None,
) -> None:
    """Where the laws in FILES differ beyond their joint uncertainties: two or more, each with each.

    FILES are sessions (.h5) or the JSON of `identify` or `diagnose`. Laws are compared on the band that both
    have; the p-value is of all frequencies together.
    """
    if len(files) < 2:
        raise click.UsageError(f"{files[0]}: one file, expected two or more to compare")
    if remounts and (with_spread or repeatability_percent):
        raise click.UsageError(
            "--remounts finds the repeatability: expected neither --spread nor --repeatability"
        )
    out = Output(json_path)
    laws = [read_law(path, bar) for path in files]
    one = same_specimen or remounts
    found = [
        compare_laws(a, b, repeatability_percent / 100, one_specimen=one) for a, b in combinations(laws, 2)
    ]
    # All that can be wrong with the files is said before anything is printed.
    spread = spread_of(laws, "mounts" if remounts else "specimens") if with_spread or remounts else None
    names = _names(files)
    pairs = list(combinations(names, 2))
    out.table(
        "",
        ["A", "B", "band / Hz", "G' B/A / %", "eta B-A", "chi2", "dof", "p", f"at {LEVEL:g}"],
        [[*pair, *_cells(c)] for pair, c in zip(pairs, found, strict=True)],
    )
    for name, law in zip(names, laws, strict=True):
        for said in remarks_on_law(law, beside_spread=spread is not None):
            out.say(f"{name}: {said}")
    for (a, b), c in zip(pairs, found, strict=True):
        for said in remarks_on_pair(c):
            out.say(f"{a} and {b}: {said}")
    for said in remarks_on_one_specimen(laws, found, said=one):
        out.say(said)
    result = CompareResult(
        pairs=tuple(compared_pair(c, a, b) for (a, b), c in zip(pairs, found, strict=True))
    )
    if spread is not None:
        for line in spread.lines:
            out.say(line)
        facts = spread_result(spread)
        result = result.but(repeatability=facts) if remounts else result.but(spread=facts)
    out.result(result)


def _names(files: tuple[Path, ...]) -> list[str]:
    """File names, with their folders where names alone are not told apart."""
    alone = [path.name for path in files]
    return alone if len(set(alone)) == len(alone) else [str(path) for path in files]


def _cells(c: Comparison) -> list[str]:
    if not len(c.frequency_hz):
        return ["none in common", *("",) * 5, _SAYS[None]]
    dG = c.storage_difference[np.argmax(np.abs(c.storage_difference))]
    de = c.loss_factor_difference[np.argmax(np.abs(c.loss_factor_difference))]
    return [
        band(c.frequency_hz[0], c.frequency_hz[-1]).removesuffix(" Hz"),
        *(
            said(value) if np.isfinite(value) else "not known"
            for value, said in (
                (100 * dG, signed),
                (de, partial(signed, places=4)),
                (c.chi2, "{:.2f}".format),
                (c.dof, "{:.1f}".format),
                (c.p_value, partial(tail, digits=3)),
            )
        ),
        _SAYS[c.differs],
    ]
