"""Whether a file is still the one that was read. No Qt."""

from pathlib import Path

Stamp = tuple[int, int]
"""When it was written last, in nanoseconds, and its size in bytes."""


def stamp_of(path: Path | None) -> Stamp | None:
    """None where there is no such file."""
    try:
        found = path.stat() if path is not None else None
    except OSError:
        return None
    return (found.st_mtime_ns, found.st_size) if found is not None else None
