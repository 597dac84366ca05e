"""The words of a name in plain small letters, those of German and French laboratories in English."""

import re
import unicodedata
from itertools import pairwise

_ENGLISH = {
    # Axes
    "frequenz": "frequency",
    "frequence": "frequency",
    "eigenfrequenz": "eigenfrequency",
    "resonanzfrequenz": "eigenfrequency",
    "kreisfrequenz": "omega",
    "pulsation": "omega",
    "zeit": "time",
    "temps": "time",
    # What is measured
    "schnelle": "velocity",
    "geschwindigkeit": "velocity",
    "vitesse": "velocity",
    "beschleunigung": "acceleration",
    "auslenkung": "displacement",
    "weg": "displacement",
    "verschiebung": "displacement",
    "deplacement": "displacement",
    "kraft": "force",
    "temperatur": "temperature",
    "kohaerenz": "coherence",
    "koharenz": "coherence",
    # Of a point
    "abschnitt": "segment",
    "durchlauf": "sweep",
    "durchgang": "sweep",
    "balayage": "sweep",
    "gewichtung": "weight",
    "ponderation": "weight",
    "nummer": "number",
    "numero": "number",
    # Where
    "basis": "base",
    "fusspunkt": "base",
    "sockel": "base",
    "einspannung": "clamp",
    "encastrement": "clamp",
    "anregung": "excitation",
    "erreger": "shaker",
    "eingang": "input",
    "entree": "input",
    "referenz": "reference",
    # One over another
    "uebertragungsfunktion": "frf",
    "ubertragungsfunktion": "frf",
    "frequenzgang": "frf",
    "transfert": "transfer",
    "admittanz": "mobility",
    "mobilitat": "mobility",
    "mobilite": "mobility",
    "inertanz": "inertance",
    "transmissibilite": "transmissibility",
    "transmissibilitat": "transmissibility",
    # Parts of a phasor
    "realteil": "real",
    "reell": "real",
    "reel": "real",
    "reelle": "real",
    "imaginarteil": "imaginary",
    "imaginaerteil": "imaginary",
    "imaginar": "imaginary",
    "imaginaer": "imaginary",
    "imaginaire": "imaginary",
    "betrag": "magnitude",
    "module": "magnitude",
    "phasenwinkel": "phase",
    "phasenlage": "phase",
    # Modes
    "ordnung": "order",
    "ordre": "order",
    "daempfung": "damping",
    "dampfung": "damping",
    "amortissement": "damping",
    "daempfungsmass": "damping",
    "dampfungsmass": "damping",
    "daempfungsgrad": "damping ratio",
    "dampfungsgrad": "damping ratio",
    "taux": "ratio",
    "verlustfaktor": "loss factor",
    "facteur": "factor",
    "perte": "loss",
    "pertes": "loss",
    "halbwertsbreite": "half power bandwidth",
    "guete": "quality",
    "gute": "quality",
    "guetefaktor": "quality",
    "gutefaktor": "quality",
    "dekrement": "decrement",
    "standardabweichung": "std",
    "unsicherheit": "uncertainty",
}
_COMPOUND = re.compile(r"(\w{4,})(schnelle|geschwindigkeit|beschleunigung|auslenkung|kraft)")
"""German puts a word for where before one for what: `Basisbeschleunigung`."""
_THINGS = {"module"}
_SPREAD = ("ecart-type", "std")
_LINK = "s"
"""Between them: `Anregungskraft`."""


def plain(text: str) -> str:
    """In small letters without accents, omega in full."""
    for letter, spelt in (("ω", "omega"), ("φ", "phi"), ("ß", "ss")):
        text = text.replace(letter, spelt)
    return "".join(c for c in unicodedata.normalize("NFKD", text.lower()) if not unicodedata.combining(c))


def words_of(text: str) -> list[str]:
    """Of some text, in order: `Mobilité (partie réelle)` is mobility, partie, real.

    What has a number may be a thing: `Module 1` is no modulus.
    """
    words = [word for word in re.split(r"[^a-z0-9]+", plain(text).replace(*_SPREAD)) if word]
    return [
        english
        for word, following in pairwise([*words, ""])
        for english in ([word] if word in _THINGS and following.isdigit() else _in_english(word))
    ]


def _in_english(word: str) -> list[str]:
    whole = _ENGLISH.get(word)
    if whole is not None:
        return whole.split()
    parts = _COMPOUND.fullmatch(word)
    if parts is None:
        return [word]
    where = _ENGLISH.get(parts[1]) or _ENGLISH.get(parts[1].removesuffix(_LINK), parts[1])
    return [*where.split(), _ENGLISH[parts[2]]]
