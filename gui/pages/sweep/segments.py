"""How each segment stands, in words. No Qt."""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from fitting.gravity import PUBLISHED_G_M_S2
from gui.pages.sweep.points import PointsMeasured
from gui.state import SessionState
from instrument.files.acceleration import acceleration_unit
from instrument.files.experiment_file import SegmentSection

State = Literal["planned", "running", "broken off", "done"]


@dataclass(frozen=True)
class SegmentStatus:
    """Of one segment, all passes together."""

    number: int
    band: str
    state: State
    points: str
    level: str
    marked: int
    """Points with remarks or out of limits."""

    @property
    def lines(self) -> str:
        """Two lines for a list."""
        remarks = f", {self.marked} marked" if self.marked else ""
        return f"{self.number}   {self.band}\n{self.state}, {self.points}{remarks}, {self.level}"


def standings(state: SessionState, points: PointsMeasured) -> list[SegmentStatus]:
    """Every segment planned or begun, in order."""
    sweep = state.plan.sweep
    planned = dict(enumerate(sweep.segments, start=1)) if sweep is not None else {}
    begun = {segment for turn, segment in state.plan.begun if turn > 0}
    return [_standing(state, points, n, planned.get(n)) for n in sorted(planned.keys() | begun)]


def _standing(
    state: SessionState, points: PointsMeasured, number: int, planned: SegmentSection | None
) -> SegmentStatus:
    plan = state.plan
    runs = {key: run for key, run in plan.begun.items() if key[0] > 0 and key[1] == number}
    adaptive = plan.sweep is not None and plan.sweep.plan == "adaptive"
    stated = plan.sweep.sweeps if plan.sweep is not None and not adaptive else 1
    # What was measured because of a diagnosis is a pass that no file asks for.
    turns = max(stated, len(runs))
    mine = (points.segment == number) & ~points.sentinel
    done = sum(plan.done.get(key, 0) for key in runs)
    begun = [run.steps for run in runs.values()]
    each = begun[-1] if begun else planned.points if planned is not None else None
    # How many an adaptive sweep makes of a region nobody knows.
    known = each is not None and not (adaptive and begun)
    most = f" of {sum(begun) + (turns - len(begun)) * (each or 0)}" if known else ""
    passes = f", pass {len(runs)} of {turns}" if turns > 1 and runs else ""
    levels = np.unique(np.round(points.level_m_s2[mine], 6)).tolist()
    given = [sweep.level_g * PUBLISHED_G_M_S2] if (sweep := plan.sweep) is not None else []
    return SegmentStatus(
        number,
        _band(planned, [(run.low_hz, run.high_hz) for run in runs.values()]),
        _state(state, list(runs), turns),
        f"{done}{most} points{passes}",
        ", ".join(acceleration_unit().said(v, ".3g") for v in levels or given),
        int((points.quality[mine] > 0).sum()),
    )


def _state(state: SessionState, begun: list[tuple[int, int]], turns: int) -> State:
    if not begun:
        return "planned"
    if len(begun) == turns and all(key in state.plan.ended for key in begun):
        return "done"
    return "broken off" if state.run.over else "running"


def _band(planned: SegmentSection | None, begun: list[tuple[float, float]]) -> str:
    if begun:
        return f"{min(low for low, _ in begun):.4g} to {max(high for _, high in begun):.4g} Hz"
    if planned is None or planned.mode is not None:
        return f"around mode {planned.mode}" if planned is not None else ""
    if planned.frequencies_hz is not None:
        return f"{min(planned.frequencies_hz):.4g} to {max(planned.frequencies_hz):.4g} Hz"
    return f"{planned.low_hz:.4g} to {planned.high_hz:.4g} Hz"
