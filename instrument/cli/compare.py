"""`viscorig compare`: which laws differ beyond their uncertainties, and where."""

from collections.abc import Sequence
from itertools import combinations
from pathlib import Path

import click
import numpy as np

from fitting.digits import two_digits
from instrument.cli.options import NumberRange, file_arguments, json_option
from instrument.cli.output import Output
from instrument.facts.comparison import CompareResult
from instrument.interchange.questions import kelvin_doubt
from instrument.material.alike import alike_in, stated_unlike
from instrument.material.comparing import LEVEL, Comparison, compared_pair
from instrument.material.comparing import compare as compare_laws
from instrument.material.found_law import MaterialLaw, read_law
from instrument.material.spread import spread_of
from instrument.material.spread_facts import spread_result
from instrument.progress import bar

_WARMER = 1.0
"""K between two laws, from which it is said: a damping polymer is another one."""
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
    beside = ", and is not in the spread" if spread is not None else ""
    for name, law in zip(names, laws, strict=True):
        if law.verdict == "unknown":
            out.say(f"{name}: verdict unknown: this law may be biased beyond what is known of it{beside}")
        elif law.is_doubted:
            out.say(f"{name}: its fit says that this law may be biased beyond its band{beside}")
        elif law.verdict == "ambiguous":
            out.say(f"{name}: verdict ambiguous ({law.found}): its band spans the laws of all of these")
        if doubt := kelvin_doubt(law.temperature_c):
            out.say(f"{name}: {doubt}")
    for (a, b), c in zip(pairs, found, strict=True):
        if (warm := _unlike_temperatures(c)) is not None:
            out.say(f"{a} and {b}: of {warm[0]:.4g} and {warm[1]:.4g} degC, which alone makes laws differ")
        for what, z in (("G'", c.storage_z), ("eta", c.loss_factor_z)):
            ranges = ", ".join(f"{low:.4g} to {high:.4g} Hz" for low, high in c.where(z))
            if ranges:
                out.say(f"{a} and {b}: {what} differs beyond 1.96 joint standard errors at {ranges}")
        if c.differs is False and (seen := c.would_be_seen) is not None:
            at, storage, eta = seen
            out.say(
                f"{a} and {b}: not told apart; at {at:.3g} Hz G' would be seen to differ by "
                f"{two_digits(100 * storage)} %, eta by {two_digits(eta)}"
            )
    _say_of_one_specimen(out, laws, found, said=one)
    result = CompareResult(
        pairs=tuple(compared_pair(c, a, b) for (a, b), c in zip(pairs, found, strict=True))
    )
    if spread is not None:
        for line in spread.lines:
            out.say(line)
        said = spread_result(spread)
        result = result.but(repeatability=said) if remounts else result.but(spread=said)
    out.result(result)


def _say_of_one_specimen(
    out: Output, laws: Sequence[MaterialLaw], found: Sequence[Comparison], *, said: bool
) -> None:
    """Whether the files bear it out, where it was `said`; else what saying so would tell."""
    if not said:
        if any(c.differs is False and len(alike_in((c.a, c.b))) for c in found):
            out.say("Of one specimen, measured again? --same-specimen then tells smaller differences apart.")
    elif unlike := stated_unlike(laws):
        out.say(
            f"said to be of one specimen, but the files state {' and '.join(unlike)} as different numbers: "
            "their laws differ by that already"
        )
    elif any(law.stated for law in laws) and not all(c.alike for c in found):
        out.say(
            "what one specimen's stated numbers make alike is not known of all of these laws: where it is "
            "not, the comparison is cautious"
        )


def _unlike_temperatures(c: Comparison) -> tuple[float, float] | None:
    a, b = c.a.temperature_c, c.b.temperature_c
    return (a, b) if a is not None and b is not None and abs(a - b) > _WARMER else None


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
        f"{c.frequency_hz[0]:.4g} to {c.frequency_hz[-1]:.4g}",
        *(
            format(value, spec) if np.isfinite(value) else "not known"
            for value, spec in (
                (100 * dG, "+.2f"),
                (de, "+.4f"),
                (c.chi2, ".2f"),
                (c.dof, ".1f"),
                (c.p_value, ".3g"),
            )
        ),
        _SAYS[c.differs],
    ]
