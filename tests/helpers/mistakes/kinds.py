"""What a mistake is, and how some are made of a file that is valid."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

IDENTIFY = "identify sweep.csv --specimen coarse.toml"
MODES = "modes coarse.toml --count 2"


@dataclass(frozen=True)
class Mistake:
    """One; `said` is a regular expression."""

    name: str
    do: Callable[[Path], None]
    command: str
    said: str
    plausibility: bool = False
    """Whether `--force` goes on all the same."""


def text(
    name: str, file: str, old: str, new: str, command: str, said: str, *, plausibility: bool = False
) -> Mistake:
    def do(folder: Path) -> None:
        content = (folder / file).read_text()
        assert old in content
        (folder / file).write_text(content.replace(old, new))

    return Mistake(name, do, command, said, plausibility)


def wrong(command: str, said: str, *, insists: bool = False) -> Mistake:
    """A file of another kind."""
    return Mistake(command, lambda folder: None, command, said, insists)


def made(name: str, command: str, said: str, content: str | None = None) -> Mistake:
    """`taken` is a folder, or a file with some content."""

    def do(folder: Path) -> None:
        if content is None:
            (folder / "taken").mkdir()
        else:
            (folder / "taken").write_text(content)

    return Mistake(name, do, command, said)
