"""The words of a name in plain small letters, those of German and French laboratories in English."""

import re
import unicodedata

_ENGLISH = {
    # Axes
    "frequenz": "frequency",
    "frequence": "frequency",
    "eigenfrequenz": "frequency",
    "resonanzfrequenz": "frequency",
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
    "mobilite": "mobility",
    "inertanz": "inertance",
    "transmissibilite": "transmissibility",
    # Parts of a phasor
    "realteil": "real",
    "reel": "real",
    "reelle": "real",
    "imaginarteil": "imaginary",
    "imaginaerteil": "imaginary",
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
    "daempfungsgrad": "damping ratio",
    "dampfungsgrad": "damping ratio",
    "taux": "ratio",
    "verlustfaktor": "loss factor",
    "facteur": "factor",
    "perte": "loss",
    "pertes": "loss",
    "halbwertsbreite": "half bandwidth",
    "guete": "quality",
    "gute": "quality",
    "dekrement": "decrement",
    "standardabweichung": "std",
    "unsicherheit": "uncertainty",
    "ecart": "std",
}
_COMPOUND = re.compile(r"(\w{4,})(schnelle|geschwindigkeit|beschleunigung|auslenkung|kraft)")
"""German puts a word for where before one for what: `Basisbeschleunigung`."""
_LINK = "s"
"""Between them: `Anregungskraft`."""


def plain(text: str) -> str:
    """In small letters without accents, omega in full."""
    text = text.replace("ω", "omega").replace("ß", "ss")
    return "".join(c for c in unicodedata.normalize("NFKD", text.lower()) if not unicodedata.combining(c))


def words_of(text: str) -> list[str]:
    """Of some text, in order: `Mobilité (partie réelle)` is mobility, partie, real."""
    return [english for word in re.split(r"[^a-z0-9]+", plain(text)) if word for english in _in_english(word)]


def _in_english(word: str) -> list[str]:
    whole = _ENGLISH.get(word)
    if whole is not None:
        return whole.split()
    parts = _COMPOUND.fullmatch(word)
    if parts is None:
        return [word]
    where = _ENGLISH.get(parts[1]) or _ENGLISH.get(parts[1].removesuffix(_LINK), parts[1])
    return [*where.split(), _ENGLISH[parts[2]]]
