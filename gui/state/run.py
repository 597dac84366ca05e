"""How a run stands: its state, why it ended, what comes next in words."""

from dataclasses import dataclass, field
from typing import Literal

from instrument.errors import NOT_SILENT
from instrument.facts.diagnosis import DiagnosisResult
from instrument.files.experiment_file import ExperimentDocument
from instrument.hammer_test.struck import FEWEST_HITS
from instrument.results.diagnosis_words import UNRELIABLE, verdict_line
from instrument.results.next_words import apart_words
from instrument.stepped_sine.soak import Soak
from instrument.stream.derived import DiagnosisFound, FitUpdated, HitJudged, HitRevised, StepsChosen
from instrument.stream.event import Event
from instrument.stream.raw import (
    AcquisitionBegan,
    DiagnosisStarted,
    FitStarted,
    FollowUpDecided,
    FollowUpEnded,
    FollowUpProposed,
    HammerTestEnded,
    Held,
    OperatorDid,
    SegmentBegan,
    SegmentEnded,
    SessionBegan,
    SessionEnded,
    SoakBegan,
    SoakEnded,
    StepBegan,
    TemperatureRead,
)

State = Literal[
    "idle",
    "preparing",
    "hammer",
    "struck",
    "calibration",
    "soaking",
    "sweep",
    "held",
    "identifying",
    "diagnosing",
    "done",
    "stopped",
]
WORDS: dict[State, str] = {
    "idle": "idle",
    "preparing": "preparing",
    "hammer": "hammer test",
    "struck": "damped plate struck",
    "calibration": "calibration",
    "soaking": "soaking",
    "sweep": "sweep",
    "held": "held",
    "identifying": "identifying",
    "diagnosing": "diagnosing",
    "done": "done",
    "stopped": "stopped",
}
_WAITING = "waiting for you"
OVER: tuple[State, ...] = ("idle", "done", "stopped")
"""States in which nothing is going on."""
_MEASURING: tuple[State, ...] = ("hammer", "struck", "calibration", "soaking", "sweep", "held")


@dataclass
class Run:
    """Follows the events."""

    experiment: ExperimentDocument
    state: State = "idle"
    why: str = ""
    """Of the end, as `instrument.engine.messages.Why`; empty before."""
    message: str = ""
    question: str = ""
    """What a person is asked to do; empty where nobody waits."""
    work: tuple[str, float | None] | None = None
    """Long work that goes on: its name and the fraction done, where that is known."""
    segment: SegmentBegan | None = None
    step: StepBegan | None = None
    choice: StepsChosen | None = None
    """What a sweep that chooses its own steps decided last."""
    soak: Soak | None = None
    """The one in progress, or the last."""
    good_hits: int = 0
    _hits: dict[int, bool] = field(default_factory=dict)
    proposed: FollowUpProposed | None = None
    """What would tell the explanations of the last diagnosis apart, as far as the run can do it."""
    found: DiagnosisResult | None = None
    """The last diagnosis; None where there is none, or none was possible."""
    _fitted: bool = False
    _following: bool = False
    _segments_ended: int = 0

    def take(self, event: Event) -> None:
        """One event of the stream."""
        match event:
            case SessionBegan():
                self.state, self.why, self.message = "preparing", "", ""
            case AcquisitionBegan():
                self.state, self.step, self.segment = event.part, None, None
                self._hits = {}
                self.good_hits = 0
            case HitJudged() | HitRevised():
                self._hits = {**self._hits, event.hit: event.accepted}
                self.good_hits = sum(self._hits.values())
            case HammerTestEnded():
                self.state = "preparing"
            case FollowUpProposed():
                self.state, self.proposed = "preparing", event
            case FollowUpDecided():
                self.question, self._following = "", event.agreed
            case FollowUpEnded():
                self._following = False
            case OperatorDid() if event.what in ("mounted", "aimed", "changed"):
                self.question = ""
                self.state = "preparing"
            case SegmentBegan():
                self.segment = event
            case StepsChosen():
                self.choice = event
            case StepBegan():
                self.state = "calibration" if event.sweep == 0 else "sweep"
                self.step = event
            case SoakBegan():
                self.state, self.soak = "soaking", Soak(event)
            case TemperatureRead() if event.soak_s is not None and self.soak is not None:
                self.soak.take(event)
            case SoakEnded():
                self.state = "preparing"
            case Held():
                self.state = "held"
            case FitStarted() if self._sweep_is_whole and not self._following:
                self.state = "identifying"
            case DiagnosisStarted():
                self.state = "diagnosing"
            case DiagnosisFound():
                self.found = event.result
            case FitUpdated() if event.result is not None:
                self._fitted = True
            case SessionEnded():
                self.end(event.why, event.message)
            case SegmentEnded():
                self._segments_ended += event.sweep > 0

    def end(self, why: str, message: str) -> None:
        """Take note that the run is over."""
        self.state = "done" if why == "done" else "stopped"
        self.why, self.message, self.question, self.work = why, message, "", None

    @property
    def over(self) -> bool:
        """Whether nothing is going on."""
        return self.state in OVER

    @property
    def ending(self) -> str:
        """How it ended, in a line: first what to do at once, which no line may cut away."""
        if self.why == NOT_SILENT:
            return f"{self.message} ({self.why})"
        return self.why + (f": {self.message}" if self.message else "")

    @property
    def word(self) -> str:
        """The state, in large: what only a person can carry on waits for one."""
        return _WAITING if self.question and self.state == "preparing" else WORDS[self.state]

    @property
    def next_words(self) -> str:
        """What is being done or waited for, in a line."""
        if self.question:
            return self.question
        if self.work is not None and self.state not in _MEASURING:
            # A fit beside the sweep is not what the run does.
            return self.work[0]
        match self.state:
            case "hammer" | "struck":
                wanted = self.wanted_hits
                if self.good_hits < wanted:
                    return f"strike once and let it ring: {self.good_hits} of {wanted} good hits"
                return f"{self.good_hits} good hits: use them, or strike again"
            case "held":
                again = "soaks again" if self._soaks else "measures the step again"
                return f"the shaker is silent; resume {again}"
            case "soaking":
                return self.soak.words if self.soak is not None else ""
            case "calibration" | "sweep":
                return self._step_words()
            case "done":
                return self.message or self._found_words
            case "stopped":
                return self.ending
            case "preparing":
                return "what comes next is made ready"
            case "identifying":
                return "the law from all points"
            case "diagnosing":
                return "tracing what the fit cannot explain"
        return ""

    @property
    def _found_words(self) -> str:
        """What the run gave, and where it stands."""
        if self.found is None:
            return f"what was found stands on {'Material' if self._fitted else 'Hammer'}"
        if self.found.verdict == "unknown":
            return f"{UNRELIABLE}; Diagnosis says what to measure next"
        said = verdict_line(self.found).removeprefix("verdict: ")
        return f"{said}; see Diagnosis"

    @property
    def strikes(self) -> bool:
        """Whether blows are waited for, on whichever plate."""
        return self.state in ("hammer", "struck")

    @property
    def wanted_hits(self) -> int:
        """Good ones, of the test that goes on."""
        wanted = self.experiment.hammer.hits if self.experiment.hammer is not None else 0
        return max(wanted, FEWEST_HITS) if self.state == "struck" else wanted

    def _step_words(self) -> str:
        if self.step is None:
            return ""
        f = f"{self.step.frequency_hz:g} Hz"
        match self.step.purpose:
            case "loop-check":
                return f"loop check at {f}"
            case "sentinel":
                return f"sentinel at {f}"
        if self._following and self.proposed is not None:
            return f"{f}, {apart_words(self.proposed.offers[0].between)}"
        why = self.choice.why if self.choice is not None and self.step.sweep > 0 else ""
        return f"step at {f}" + (f": {why}" if why else "")

    @property
    def _soaks(self) -> bool:
        """Whether a soak has begun and not ended."""
        return self.soak is not None and not self.soak.done

    @property
    def _sweep_is_whole(self) -> bool:
        sweep = self.experiment.sweep
        if sweep is not None and sweep.plan == "adaptive":
            return self.choice is not None and self.choice.ended
        return sweep is not None and self._segments_ended >= len(sweep.segments) * sweep.sweeps
