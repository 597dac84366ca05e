"""The published case as `viscorig demo` shows it: from its tables to its figures."""

from pathlib import Path

from instrument.cli.output import Output
from instrument.cli.print_diagnosis import print_before_after, print_law, print_story
from instrument.cli.print_identification import print_identification
from instrument.cli.print_run import print_result
from instrument.facts.diagnosis import DiagnosisResult
from instrument.paper_case import TABLE_5_THEORY_M_S
from instrument.paper_case.demo import PaperRun, run_paper_case
from instrument.paper_case.figures import save_figures
from instrument.progress import bar
from instrument.results.diagnosis_from import diagnosis_from
from instrument.results.identification_from import identification_from
from instrument.results.session_result import BEFORE_DIAGNOSIS, Conditions, result_of


def show_paper_case(out: Output, folder: Path) -> None:
    """Identify ZN_1 from its published tables, diagnose what is left; save results and figures."""
    out.say("The published case: Table 3's damping and Table 5's nine measured responses.\n")
    run = run_paper_case(bar)
    out.say(f"Identified, {BEFORE_DIAGNOSIS}:")
    print_identification(out, run.direct)
    out.say()
    _print_beside_paper(out, run)
    out.say()
    diagnosed = diagnosis_from(run.diagnosis)
    _print_diagnosis(out, diagnosed)
    Output(str(folder / "identify-direct.json")).result(identification_from(run.direct))
    Output(str(folder / "identify-paper.json")).result(identification_from(run.paper))
    Output(str(folder / "diagnose-paper.json")).result(diagnosed)
    out.say()
    for path in save_figures(run, folder, bar):
        out.say(f"saved {path}")
    out.say()
    print_result(out, result_of(None, diagnosed, Conditions.of_sweep(run.sweep)))


def _print_diagnosis(out: Output, found: DiagnosisResult) -> None:
    """What the nine amplitudes say of the difference that four parameters leave, and the law with that."""
    out.say("What the nine points say of that:")
    print_story(out, found)
    out.say()
    print_before_after(out, found)
    out.say()
    print_law(out, found)


def _print_beside_paper(out: Output, run: PaperRun) -> None:
    direct, paper = run.direct.result, run.paper.result
    rows = []
    for k, f in enumerate(run.sweep.frequency_hz):
        measured, printed = direct.measured_m_s[k], TABLE_5_THEORY_M_S[k]
        rows.append(
            [
                f"{f:g}",
                f"{measured:.4f}",
                *(f"{printed:.4f}", f"{100 * (printed / measured - 1):+.2f}"),
                *(f"{direct.predicted_m_s[k]:.4f}", f"{direct.difference_percent[k]:+.2f}"),
                *(f"{paper.predicted_m_s[k]:.4f}", f"{paper.difference_percent[k]:+.2f}"),
            ]
        )
    out.table(
        "Table 5 beside the published theory (velocity amplitudes in m/s, differences in %)",
        ["f/Hz", "measured", "published", "%", "direct", "%", "paper's method", "%"],
        rows,
    )
    out.say(
        f"rms: direct {direct.rms_percent:.2f} %, the paper's method {paper.rms_percent:.2f} % "
        f"after {paper.fit.iterations} iterations (5 % criterion "
        f"{'met' if paper.fit.criterion_met else 'not met'})"
    )
    leave = direct.validation.leave_one_out_rms_percent
    out.say(
        f"The nine points leave {direct.rms_percent:.1f} % that four parameters cannot explain, "
        f"{leave:.1f} % when each point is predicted from the others."
    )
