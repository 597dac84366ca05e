"""DATA of `identify` and `diagnose`, as their options have it."""

from collections.abc import Callable
from pathlib import Path

import click

from instrument.cli.output import Output
from instrument.interchange.given import Given, read_given

_OPTIONS = (
    click.option(
        "--specimen",
        type=click.Path(path_type=Path),
        help="SPECIMEN.toml; its law is the start. A session has its own.",
    ),
    click.option(
        "--hammer",
        type=click.Path(path_type=Path),
        help="JSON of 'viscorig damping' on the bare plate: its ratios, and the substrate's stiffness. "
        "A session has its own.",
    ),
    click.option("--no-hammer", is_flag=True, help="Leave a session's own hammer test out."),
)


def reading_options(command: Callable[..., None]) -> Callable[..., None]:
    """`--specimen`, `--hammer`, `--no-hammer`."""
    for option in reversed(_OPTIONS):
        command = option(command)
    return command


def read_data(
    out: Output, data: Path, specimen: Path | None, hammer: Path | None, *, no_hammer: bool
) -> Given:
    """Read DATA, its specimen and its hammer test. Raises `BadInput`, `UsageError`."""
    if hammer is not None and no_hammer:
        raise click.UsageError("--hammer and --no-hammer exclude each other")
    given = read_given(data, specimen, hammer, own_hammer=not no_hammer)
    if given.remark:
        out.say(f"{given.remark}\n")
    return given
