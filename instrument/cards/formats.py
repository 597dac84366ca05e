"""The formats there are."""

from collections.abc import Callable
from dataclasses import dataclass

from instrument.cards.abaqus import abaqus
from instrument.cards.ansys import ansys
from instrument.cards.card import Card
from instrument.cards.comsol import comsol
from instrument.cards.nastran import nastran
from instrument.cards.plain import as_csv, as_json


@dataclass(frozen=True)
class Format:
    """How a card is written."""

    ending: str
    write: Callable[[Card], str]


FORMATS = {
    "abaqus": Format(".inp", abaqus),
    "ansys": Format(".mac", ansys),
    "nastran": Format(".bdf", nastran),
    "comsol": Format(".txt", comsol),
    "csv": Format(".csv", as_csv),
    "json": Format(".json", as_json),
}
