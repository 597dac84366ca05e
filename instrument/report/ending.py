"""How a session ended, and what of its plan is missing."""

from instrument.errors import NOT_SILENT
from instrument.files.acceleration import shown_quantity
from instrument.report.blocks import Block, ReportSection, Sentence
from instrument.session.contents import Contents
from instrument.stream.derived import LimitExceeded, LimitWarned


def ending_section(contents: Contents) -> ReportSection:
    """A sentence how it ended, and one for everything that is not there."""
    missing = missing_parts(contents)
    blocks: list[Block] = [Sentence(_ended(contents), "plain" if _is_done(contents) else "warning")]
    breaks = len(contents.began) - 1
    if breaks > 0:
        times = "once" if breaks == 1 else f"{breaks} times"
        blocks.append(Sentence(f"The run was broken off and resumed {times}."))
    blocks += [Sentence(text, "note") for text in missing]
    if not missing:
        blocks.append(Sentence("Everything the experiment asked for was measured."))
    blocks += [Sentence(text, "warning") for text in _limits(contents)]
    return ReportSection("How it ended", tuple(blocks))


def missing_parts(contents: Contents) -> list[str]:
    """What the experiment asks for and the session does not hold, a sentence each."""
    experiment = contents.configuration.experiment
    said = []
    if experiment.hammer is not None:
        said += _missing_hits(contents, experiment.hammer.hits)
    if experiment.sweep is not None:
        if experiment.sweep.calibration is not None and not contents.calibrations:
            said.append("The vibrometer was not calibrated in place.")
        said += _missing_segments(contents, len(experiment.sweep.segments), experiment.sweep.sweeps)
    return said


def _missing_hits(contents: Contents, wanted: int) -> list[str]:
    if not contents.hits:
        return ["No hammer test was made."]
    good = len(contents.good_hits)
    said = [] if good >= wanted else [f"The hammer test has {good} good hits of {wanted} asked for."]
    if contents.damping is None:
        said.append("The hammer test was not ended: the run itself found no damping from it.")
    return said


def _missing_segments(contents: Contents, segments: int, sweeps: int) -> list[str]:
    if not contents.segments:
        return ["No sweep was made."]
    said = []
    measured = [(p.point.sweep, p.point.segment) for p in contents.points if p.point.purpose == "step"]
    for key, run in contents.segments.items():
        if not run.ended:
            done = f"{measured.count(key)} of {run.steps} steps measured"
            said.append(f"Segment {run.segment} of sweep {run.sweep} is not complete: {done}.")
    planned = [(sweep, k) for sweep in range(1, sweeps + 1) for k in range(1, segments + 1)]
    for sweep, segment in planned:
        if (sweep, segment) not in contents.segments:
            said.append(f"Segment {segment} of sweep {sweep} was not begun.")
    return said


def _is_done(contents: Contents) -> bool:
    return contents.ended is not None and contents.ended.why == "done"


def _ended(contents: Contents) -> str:
    if contents.ended is None:
        return "The recording stops without an end: the program was ended from outside."
    if _is_done(contents):
        return "The run came to its planned end."
    said = {"stopped by the user": "The user stopped the run", "stopped safely": "The rig stopped itself"}
    message = contents.ended.message
    if contents.ended.why == NOT_SILENT:
        return f"{message} ({NOT_SILENT})."
    return said[contents.ended.why] + (f": {message}" if message else ".")


def _limits(contents: Contents) -> list[str]:
    """The highest of each kind that came near or over its limit."""
    worst: dict[str, LimitWarned | LimitExceeded] = {}
    for event in contents.limits:
        known = worst.get(event.what)
        if known is None or event.value > known.value:
            worst[event.what] = event
    return [
        f"Near or over its limit: {what}, {_said(e.value, e.unit)} {_at(e)}, limit {_said(e.limit, e.unit)}."
        for what, e in worst.items()
    ]


def _at(event: LimitWarned | LimitExceeded) -> str:
    return event.place if event.frequency_hz else f"at {event.place}"


def _said(value: float, unit: str) -> str:
    shown, of = shown_quantity(value, unit)
    return f"{shown:.4g} {of}"
