"""Where an exported file comes from: lines that its comments or headers say."""

from instrument.session.contents import Contents


def provenance(contents: Contents) -> list[str]:
    """Session, title, operator, versions: one line each."""
    c = contents.configuration
    said = [
        f"session {c.name}, {c.created_utc}, exported from {contents.path.name}",
        f"title: {c.experiment.title}" if c.experiment.title else "",
        f"operator: {c.experiment.operator}" if c.experiment.operator else "",
        f"versions: {', '.join(f'{name} {version}' for name, version in c.versions.items())}",
    ]
    return [one_line(s) for s in said if s]


def reading(contents: Contents) -> list[str]:
    """What the velocity is, and what was taken off it."""
    reads = contents.configuration.rig.vibrometer.reads
    found = [
        f"range {name}: gain {k.gain:.6g}, delay {k.delay_s:.6g} s"
        for name, k in contents.calibrations.items()
    ]
    taken = "; ".join(found) if found else "none, no calibration in place"
    return [
        f'velocity is {reads}: [pickup] reads = "{reads}" in the specimen',
        one_line(f"calibration taken off: {taken}"),
    ]


def one_line(text: str) -> str:
    """Without line breaks: comments end at them."""
    return " ".join(text.split())
