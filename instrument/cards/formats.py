"""The formats there are."""

import re
from collections.abc import Callable
from dataclasses import dataclass

from instrument.cards.abaqus import abaqus
from instrument.cards.ansys import ansys
from instrument.cards.card import Card
from instrument.cards.comsol import comsol
from instrument.cards.nastran import nastran
from instrument.cards.plain import as_csv, as_json
from instrument.files.replaceable import JSON, Written

_BEGINS = re.compile(rb"(\*\*|!|\$|%|#) viscorig [^\n]*: complex shear modulus")
"""A comment in one of the formats, and the first words of every card."""


@dataclass(frozen=True)
class Format:
    """How a card is written."""

    endings: tuple[str, ...]
    """That of a card nobody has named, then the others that its program reads."""
    write: Callable[[Card], str]

    @property
    def written(self) -> Written:
        """What of its kind may be written over: a card, by its first line."""
        return Written(_BEGINS if self.write is not as_json else JSON.begins, self.endings)


FORMATS = {
    "abaqus": Format((".inp", ".txt"), abaqus),
    "ansys": Format((".mac", ".inp", ".dat", ".txt"), ansys),
    "nastran": Format((".bdf", ".nas", ".dat", ".txt"), nastran),
    "comsol": Format((".txt", ".dat", ".csv"), comsol),
    "csv": Format((".csv", ".txt"), as_csv),
    "json": Format((".json",), as_json),
}
