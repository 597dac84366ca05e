"""Options and arguments shared by commands."""

import math
import os
import re
from collections.abc import Mapping
from functools import partial
from pathlib import Path
from typing import Any

import click
import numpy as np
from numpy.typing import NDArray

from fitting.gravity import PUBLISHED_G_M_S2
from instrument.errors import BadInput
from instrument.files.acceleration import UNITS, USUAL, show_acceleration_in
from instrument.files.replaceable import FIGURE, refuse_to_lose
from instrument.files.table import LOWEST_HZ

_MOST_FREQUENCIES = 100_000


def file_argument(name: str) -> Any:
    """A file to read; whether it can be read is found out on reading."""
    return click.argument(name, type=click.Path(path_type=Path))


def _each_once(_: click.Context, __: click.Parameter, files: tuple[Path, ...]) -> tuple[Path, ...]:
    """What is counted twice seems to be known better than it is."""
    for k, path in enumerate(files):
        if os.path.realpath(path) in map(os.path.realpath, files[:k]):
            raise BadInput(f"{path}: named twice, expected every file once")
    return files


def file_arguments(name: str, metavar: str | None = None) -> Any:
    """One file to read, or several, each once."""
    return click.argument(
        name,
        type=click.Path(path_type=Path),
        nargs=-1,
        required=True,
        metavar=metavar,
        callback=_each_once,
    )


json_option: Any = click.option(
    "--json",
    "json_path",
    metavar="PATH",
    help="Write the result as JSON; - for standard output and nothing else.",
)

force_option: Any = click.option(
    "--force", "insist", is_flag=True, help="Do it though the stated numbers or the data are questioned."
)


def _show_in(context: click.Context, _: click.Parameter, name: str) -> None:
    show_acceleration_in(name)
    context.call_on_close(partial(show_acceleration_in, USUAL))


acceleration_option: Any = click.option(
    "--acceleration",
    type=click.Choice(list(UNITS)),
    default=USUAL,
    show_default=True,
    expose_value=False,
    callback=_show_in,
    help="Unit in which accelerations are shown; files and JSON keep theirs.",
)


class NumberRange(click.FloatRange):
    """A range that NaN, which no comparison keeps out, is not in."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> float:
        """The number that was given, if it is one in the range."""
        found = float(super().convert(value, param, ctx))
        if math.isnan(found):
            self.fail(f"{value!r} is not a number", param, ctx)
        return found


class Level(click.ParamType):  # type: ignore[type-arg]
    """A level of the base as `level_g` counts it (`0.5` or `0.5g`), or in m/s^2 (`4.9m/s2`)."""

    name = "LEVEL"
    least_g, most_g = 1e-4, 1e3

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> float:
        """As `level_g`."""
        said = str(value).strip()
        unit = next((name for name in UNITS if said.endswith(name)), "g")
        try:
            level = float(said.removesuffix(unit)) / (1.0 if unit == "g" else PUBLISHED_G_M_S2)
        except ValueError:
            self.fail(f"{value!r}, expected a level as 0.5g or 4.9m/s2", param, ctx)
        if not self.least_g <= level <= self.most_g:
            self.fail(f"{value!r}, expected {self.least_g:g}g to {self.most_g:g}g", param, ctx)
        return level


def figures_option(said: str, *names: str) -> Any:
    """A folder for figures of these names: nobody else's pictures are written over, which is said at once."""

    def keep(_: click.Context, __: click.Parameter, folder: Path | None) -> Path | None:
        if folder is not None:
            for name in names:
                refuse_to_lose(folder / name, FIGURE)
        return folder

    return click.option(
        "--figures",
        type=click.Path(path_type=Path, file_okay=False),
        metavar="FOLDER",
        help=said,
        callback=keep,
    )


class Frequencies(click.ParamType):  # type: ignore[type-arg]
    """`A:B:STEP` (B included) or a list `F1,F2,...`, in Hz."""

    name = "A:B:STEP or F1,F2,..."

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> NDArray[np.float64]:
        """Frequencies in Hz, as given. Shape (points,)."""
        if isinstance(value, np.ndarray):
            return value
        try:
            f = _range(value) if ":" in value else np.array([float(part) for part in value.split(",")])
        except _NoRange as error:
            self.fail(f"{value!r}: {error}", param, ctx)
        except ValueError:
            self.fail(f"{value!r}, expected A:B:STEP or F1,F2,... in Hz", param, ctx)
        if is_decimal_comma(value):
            self.fail(DECIMAL_COMMA.format(value), param, ctx)
        if not np.all(np.isfinite(f)) or np.any(f <= 0):
            self.fail(f"{value!r}, expected frequencies above 0 Hz", param, ctx)
        if np.any(f < LOWEST_HZ):
            self.fail(f"{value!r}, expected frequencies of at least {LOWEST_HZ:g} Hz", param, ctx)
        return f


class _NoRange(ValueError):
    """Three numbers that span none, and why."""


DECIMAL_COMMA = "{!r}: a decimal comma? Expected a decimal point, or the lower frequency first"


def is_decimal_comma(text: str) -> bool:
    """Whether a list of two looks like one number: `28,5`."""
    found = re.fullmatch(r"(\d+),(\d{1,2})", text)
    return found is not None and float(found[2]) < float(found[1])


def _range(text: str) -> NDArray[Any]:
    low, high, step = (float(part) for part in text.split(":"))
    if not np.isfinite([low, high, step]).all():
        raise ValueError
    if high < low:
        raise _NoRange(f"A = {low:g} is above B = {high:g}, expected the lower one first")
    if step <= 0:
        raise _NoRange(f"STEP = {step:g}, expected more than 0 Hz")
    steps = (high - low) / step * (1 + 1e-12) + 1e-9
    if steps >= _MOST_FREQUENCIES:
        raise _NoRange(f"{steps:.3g} frequencies, expected at most {_MOST_FREQUENCIES}: a larger STEP")
    count = int(np.floor(steps)) + 1
    f = low + step * np.arange(count)
    # B belongs to the range even where no whole number of steps reaches it.
    return f if np.isclose(f[-1], high, rtol=1e-9) else np.append(f, high)


def refuse_with_tables(given: Mapping[str, bool]) -> None:
    """Options that are for sweeps, and whether each was given. Raises `click.UsageError` naming those."""
    there = [name for name, is_there in given.items() if is_there]
    if there:
        raise click.UsageError(f"{' and '.join(there)} with tables of modes: expected sweeps")
