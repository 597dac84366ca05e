"""A terminal's sentences as a page or a window prints them."""

import re

_TYPESET = ((" +- ", " ± "), (" -> ", " → "), ("/s^2", "/s²"), ("/m^2", "/m²"), ("/m^3", "/m³"))
"""What is written in ASCII, and what is printed. Names of files stay as they are."""
_MICROSECONDS = re.compile(r"(?<=\d) us\b")
_EXPONENT = re.compile(r"(?<![\w.])(\d+(?:\.\d+)?e)(?:\+|(-))0*(\d+)(?![\w.]*\w)")
"""Of a number by itself: 2.7e+13 is printed as beside its error, (2.692 ± 0.094)e13."""
_UNITS = {"_mpa": "MPa", "_pa": "Pa", "_rad_s": "rad/s", "_s": "s"}
_LAW_KEY = re.compile(r"\b(g\w*|tau\w*)_(?:pa|s)\b")
"""A parameter of a law as results have it, its unit behind it."""


def typeset(text: str) -> str:
    """A sentence or cell as it is printed."""
    for plain, printed in _TYPESET:
        text = text.replace(plain, printed)
    text = _EXPONENT.sub(lambda n: f"{n[1]}{n[2] or ''}{n[3]}", text)
    return _MICROSECONDS.sub(" µs", text)


def heading(text: str) -> str:
    """Of a column, `f/Hz`, as it is printed."""
    return typeset(text).replace("/", " / ")


def quantity(key: str) -> str:
    """A key of a law, `ginf_mpa`, as a row or column is headed: `ginf / MPa`."""
    for ending, unit in _UNITS.items():
        if key.endswith(ending):
            return f"{key.removesuffix(ending)} / {unit}"
    return key


def note(text: str) -> str:
    """What a fit says of itself, as a sentence; parameters without the unit that their keys end with."""
    return _LAW_KEY.sub(r"\1", capitalised(typeset(text))) + "."


def capitalised(text: str) -> str:
    """A sentence that begins with a capital; the name of a key or an effect stays as it is."""
    first = text.partition(" ")[0]
    return text if "_" in first else f"{text[:1].upper()}{text[1:]}"
