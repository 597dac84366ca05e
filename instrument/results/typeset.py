"""A terminal's sentences as a page or a window prints them."""

_TYPESET = ((" +- ", " ± "), (" -> ", " → "), ("/s^2", "/s²"), ("/m^3", "/m³"))
"""What is written in ASCII, and what is printed. Names of files stay as they are."""


def typeset(text: str) -> str:
    """A sentence or cell as it is printed."""
    for plain, printed in _TYPESET:
        text = text.replace(plain, printed)
    return text


def capitalised(text: str) -> str:
    """A sentence that begins with a capital; the name of a key or an effect stays as it is."""
    first = text.partition(" ")[0]
    return text if "_" in first else f"{text[:1].upper()}{text[1:]}"
