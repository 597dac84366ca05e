"""What a page is made of. The template knows how these look, nothing else does."""

from dataclasses import dataclass
from typing import ClassVar, Literal

from matplotlib.figure import Figure


@dataclass(frozen=True)
class Sentence:
    """One line of text; a note or a warning stands out."""

    kind: ClassVar[str] = "sentence"
    text: str
    tone: Literal["plain", "note", "warning"] = "plain"


@dataclass(frozen=True)
class FactsBlock:
    """Names and values in two columns."""

    kind: ClassVar[str] = "facts"
    title: str
    rows: tuple[tuple[str, str], ...]


@dataclass(frozen=True)
class TableBlock:
    """Columns with their units in the head."""

    kind: ClassVar[str] = "table"
    title: str
    columns: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    folded: bool = False
    """Shut until it is asked for: long ones."""
    words: tuple[str, ...] = ("why", "remark", "remarks", "parameters")
    """Columns that hold words and not numbers: they are broken into lines and read from the left."""


@dataclass(frozen=True)
class FigureBlock:
    """A figure, drawn by whoever writes the page."""

    kind: ClassVar[str] = "picture"
    figure: Figure
    title: str
    """Below it; what is read aloud in its place is said by the figure itself."""


Block = Sentence | FactsBlock | TableBlock | FigureBlock


@dataclass(frozen=True)
class ReportSection:
    """A heading and what stands under it."""

    title: str
    blocks: tuple[Block, ...]

    @property
    def anchor(self) -> str:
        """For links inside the page."""
        return "-".join("".join(c if c.isalnum() else " " for c in self.title.lower()).split())
