"""What a diagnosis advises first, as the [sweep] of an experiment file."""

from itertools import groupby
from pathlib import Path

from instrument.facts.follow_up import FollowUp
from instrument.planning.into_experiment import write_into


def write_next(path: Path, text: str, offers: tuple[FollowUp, ...]) -> str:
    """Put the first of a ranking into `path` as `write_into` does, `text` being of `begun`.

    Returns what was written, or why nothing was. Raises `BadInput`.
    """
    if not offers:
        return f"{path} is not written: nothing is ranked that would tell explanations apart"
    first = offers[0]
    sweep = next_sweep_toml(first)
    if not sweep:
        return f"{path} is not written: what comes first is no sweep. {first.todo}"
    write_into(path, text, sweep)
    beside = _in_the_specimen(first)
    needed = f"; its specimen file has to say {beside}" if beside else ""
    return f"the first of these is written as the [sweep] of {path}{needed}"


def next_sweep_toml(offer: FollowUp) -> str:
    """Its steps; empty where it has none."""
    if not offer.frequencies_hz or offer.level_g is None:
        return ""
    lines = ["[sweep]", f"level_g = {offer.level_g:g}"]
    # Steps stay in their order: a region that is left and taken up again is two segments.
    for _, steps in groupby(zip(offer.segments, offer.frequencies_hz, strict=True), lambda step: step[0]):
        listed = ", ".join(f"{f:g}" for _, f in steps)
        lines += ["", "[[sweep.segments]]", f"frequencies_hz = [{listed}]"]
    return "\n".join(lines) + "\n"


def _in_the_specimen(offer: FollowUp) -> str:
    said = []
    if offer.spot_mm is not None:
        said.append(f"[pickup] x_mm = {offer.spot_mm[0]:g}, y_mm = {offer.spot_mm[1]:g}")
    if offer.mass_kg is not None and offer.mass_at_mm is not None:
        x, y = offer.mass_at_mm
        said.append(f"[[mass]] mass_kg = {offer.mass_kg:g}, x_mm = {x:g}, y_mm = {y:g}")
    return " and ".join(said)
