"""`viscorig replay`: a recorded session through the same code again."""

from pathlib import Path

import click

from instrument.cli.options import NumberRange, acceleration_option, file_argument, json_option
from instrument.cli.output import Output
from instrument.cli.print_run import print_found, print_quality
from instrument.cli.watching import Watcher
from instrument.facts.run import ReplayResult
from instrument.progress import bar
from instrument.results.session_result import result_of_events
from instrument.run.replay import replay as replay_session
from instrument.session.storage import SessionFile
from instrument.stream.event import Event


@click.command()
@file_argument("session")
@click.option(
    "--speed",
    type=NumberRange(min=0, min_open=True),
    help="Times as fast as it was; as fast as it goes where none is given.",
)
@acceleration_option
@json_option
def replay(session: Path, speed: float | None, json_path: str | None) -> None:
    """Run SESSION.h5 again: every derived event is computed from the recorded samples and compared."""
    out = Output(json_path)
    with SessionFile(session) as file:
        if speed is None:
            with bar("replaying"):
                again = replay_session(file)
        else:
            with Watcher() as watch:

                def one(event: Event) -> None:
                    watch([event])

                again = replay_session(file, speed=speed, watch=one)
    if again.points:
        print_quality(out, again.points)
    print_found(out, again.fit, again.diagnosis, again.points)
    verdict = "all equal to the recorded ones" if again.equal else "NOT all equal to the recorded ones"
    out.say(f"{again.derived} derived events computed again: {verdict}")
    for difference in again.differences:
        out.say(f"  {difference}")
    if again.words:
        out.say("said in other words, numbers and verdicts the same (another version recorded it):")
        for words in again.words:
            out.say(f"  {words}")
    result = ReplayResult(
        identify=again.fit.result if again.fit is not None else None,
        diagnose=again.diagnosis.result if again.diagnosis is not None else None,
        result=result_of_events(again.fit, again.diagnosis, again.points) if again.points else None,
        equal_to_recorded=again.equal,
        derived_events=again.derived,
        differences=tuple(again.differences),
    )
    out.result(result.but(words=tuple(again.words)) if again.words else result)
