"""Names of files in lines with other words: of a long one the middle is left out."""

MOST_LETTERS = 40
"""A session named by the program has 30; two of 40 stand beside each other on a small screen."""


def short_name(name: str, most: int = MOST_LETTERS) -> str:
    """As it is where it has no more letters than `most`; else how it begins and how it ends.

    Names of one series differ at the end, and what a file is stands there too.
    """
    if len(name) <= most:
        return name
    begins = (most - 1) // 2
    return f"{name[:begins]}\u2026{name[begins + 1 - most :]}"
