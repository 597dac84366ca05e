"""Rows of the hit list, what is to be done, and where the damping is from: in words."""

from collections.abc import Sequence
from dataclasses import dataclass

from gui.pages.hammer.choice import WhatIf
from gui.pages.hammer.findings import Averaged
from gui.state.run import Run
from gui.style.theme import Role
from gui.widgets.tables import Cell, Row
from instrument.session.contents import RecordedHit
from instrument.stream.derived import StruckFound

HIT_COLUMNS = {
    "Hit": "Number of the hit in this test",
    "Peak / N": "Largest force of the blow",
    "up to / Hz": "Where the force spectrum has fallen by 20 dB: the blow excites little above",
    "Verdict": "Whether the hit is averaged with the others",
    "Why": "What speaks against the hit, and whose word it is",
}


@dataclass(frozen=True)
class HitRow:
    """One hit."""

    number: int
    cells: Row
    used: bool


def hit_rows(
    recorded: list[RecordedHit], hits: tuple[RecordedHit, ...], what_if: WhatIf, averaged: Averaged | None
) -> list[HitRow]:
    """`recorded` and as they count now, in the same order."""
    return [
        HitRow(
            now.number,
            (
                Cell(str(now.number), edge=_standing(now, changed=what_if.changes(was))),
                Cell(f"{now.peak_n:.4g}"),
                Cell(_usable(now.number, averaged)),
                _verdict(now, changed=what_if.changes(was)),
                Cell(_why(was), left=True),
            ),
            now.accepted,
        )
        for was, now in zip(recorded, hits, strict=True)
    ]


def _verdict(hit: RecordedHit, *, changed: bool) -> Cell:
    said = "used" if hit.accepted else "left out"
    if changed:
        return Cell(f"{said} (what if)", "otherwise than recorded", bold=True, left=True)
    return Cell(said, left=True)


def _standing(hit: RecordedHit, *, changed: bool) -> Role:
    return "fair" if changed else "good" if hit.accepted else "bad"


def prompt_of(run: Run, hits: tuple[RecordedHit, ...], *, live: bool) -> str:
    """What to do now, above the hits."""
    if live:
        said = run.next_words
        return f"{said[:1].upper()}{said[1:]}."
    if not hits:
        return "This session has no hammer test." if run.over else "No blow was caught so far."
    used = sum(h.accepted for h in hits)
    return f"{used} of {len(hits)} hits used. Accept or reject here to see what if: nothing is recorded."


def source_of(
    hits: tuple[RecordedHit, ...],
    *,
    recorded: bool,
    what_if: bool,
    live: bool,
    busy: bool,
    failure: str,
    differs: bool,
) -> str:
    """Where the damping table is from."""
    if not hits:
        return "The damping of the bare plate's modes appears here, by three methods side by side."
    numbers = ", ".join(str(h.number) for h in hits if h.accepted) or "none"
    which = f"hits {numbers} of {len(hits)}"
    if what_if:
        said = f"What if, not recorded: {which}."
    elif recorded:
        said = f"As recorded: {which}."
        if differs:
            said += " Computed again here, these hits give other values: another version recorded them."
    elif live:
        said = f"Preliminary: {which}. The run computes its own result when the hits are used."
    else:
        said = f"Computed here: {which}. The run has recorded no result so far."
    return said + (f" {failure}." if failure else "") + (" Computing ..." if busy else "")


def treated_words(struck: Sequence[StruckFound]) -> str:
    """What blows on the treated plate gave, in place of a damping table."""
    if not struck:
        return "Blows on the damped plate: their mobility goes into the diagnosis, once there are enough."
    one = struck[-1]
    held = "hung free" if one.held == "free" else "in its clamp"
    said = f"The damped plate struck {held}: {one.hits} hits, {len(one.frequency_hz)} lines of its mobility "
    said += f"from {min(one.frequency_hz):.4g} to {max(one.frequency_hz):.4g} Hz went into the diagnosis."
    return " ".join([said, *(f"{remark[:1].upper()}{remark[1:]}." for remark in one.remarks)])


def _usable(number: int, averaged: Averaged | None) -> str:
    seen = averaged.seen.get(number) if averaged is not None else None
    return f"{seen.usable_hz:.0f}" if seen is not None else "–"


def _why(hit: RecordedHit) -> str:
    said = [hit.why] if hit.why else []
    if hit.accepted and hit.why:
        said = [f"accepted by the operator against: {hit.why}"]
    elif not hit.accepted and not hit.why:
        said = ["rejected by the operator"]
    if not len(hit.record.force_n):
        said.append("its samples were not received here")
    return "; ".join(said)
