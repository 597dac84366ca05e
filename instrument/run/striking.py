"""Blows of a hammer: asked for, caught and judged, while nothing drives the shaker."""

from collections.abc import Callable, Sequence

from instrument.hammer_test.struck import OVERLOADED
from instrument.run.analysis import Analysis
from instrument.run.rig import Rig
from instrument.run.runner import Runner
from instrument.stream.derived import HitJudged
from instrument.stream.event import Event
from instrument.stream.raw import HammerTestEnded, Part

OVERLOADS = 3
"""Overloads of the laser in a row until its next coarser range is used: that one may not be calibrated."""
HITS_IN_VAIN = 20
"""Blows refused one after the other before a hammer test is given up: more of them would be no better."""


class Striking:
    """Hammer tests of one session, by the reads of its runner."""

    def __init__(self, runner: Runner, rig: Rig, analysis: Analysis, emit: Callable[[Event], object]) -> None:
        """`runner` reads this rig; `analysis` follows what `emit` takes."""
        self._runner, self._rig, self._analysis, self._emit = runner, rig, analysis, emit

    def bare(self, wanted: int, patience_s: float) -> None:
        """Catch blows on the bare plate until enough are good, or none comes, or too many in a row are not.

        Raises `RigStopped`, `DriverError`.
        """
        self._strike("hammer", ("force", "response"), wanted, patience_s)

    def treated(self, wanted: int, patience_s: float, ranges: Sequence[str]) -> None:
        """Catch blows on the treated plate as `bare` does, read in the first of some laser ranges with room.

        Raises `RigStopped`, `DriverError`.
        """
        self._runner.set_range(ranges[0])
        self._strike("struck", ("force", "velocity"), wanted, patience_s, tuple(ranges[1:]))

    def _strike(
        self,
        part: Part,
        channels: tuple[str, ...],
        wanted: int,
        patience_s: float,
        coarser: tuple[str, ...] = (),
    ) -> None:
        runner, operator = self._runner, self._rig.operator
        with runner.acquisition(part, channels):
            analysis = self._analysis.hammer
            assert analysis is not None
            asked, waited_s = (-1, -1), 0.0
            while not (analysis.complete and operator.content(analysis.accepted)):
                if analysis.ready and not analysis.complete and analysis.accepted_of_caught != asked:
                    asked, waited_s = analysis.accepted_of_caught, 0.0
                    operator.hit(analysis.accepted, wanted)
                for did in operator.decided():
                    self._emit(did)
                before = runner.samples
                caught = [e for e in runner.read(analysis.wanted()) if isinstance(e, HitJudged)]
                if coarser and _too_narrow(analysis.rejected_in_a_row):
                    runner.set_range(coarser[0])
                    coarser = coarser[1:]
                waited_s += 0.0 if caught else (runner.samples - before) / self._rig.front_end.sample_rate_hz
                in_vain = len(analysis.rejected_in_a_row) >= HITS_IN_VAIN
                if waited_s > patience_s + analysis.record_s or in_vain:
                    break
        self._emit(HammerTestEnded())


def _too_narrow(refused: list[str]) -> bool:
    """Whether the laser's range had no room for blow after blow: a softer one is to be had at once."""
    return len(refused) >= OVERLOADS and all(OVERLOADED in why for why in refused[-OVERLOADS:])
