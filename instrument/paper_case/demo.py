"""The published case run as a whole: both methods, with and without the viscous damping, and diagnosed."""

from dataclasses import dataclass, replace

from fitting.specimen import PlateSpecimen
from fitting.sweep import Sweep
from instrument.files.specimen_file import read_specimen
from instrument.files.sweep_file import read_sweep
from instrument.finding.diagnosis import Diagnosed, diagnose
from instrument.finding.identification import Identified, identify
from instrument.models.files import File
from instrument.paper_case import case_file
from instrument.progress import Progress, quiet


@dataclass(frozen=True)
class PaperRun:
    """What the published tables give."""

    specimen: PlateSpecimen
    sweep: Sweep
    direct: Identified
    paper: Identified
    undamped: Identified
    """`direct` with the core's damping alone: the paper's Fig. 10."""
    diagnosis: Diagnosed


def run_paper_case(progress: Progress = quiet) -> PaperRun:
    """Identify ZN_1 from Tables 3 and 5."""
    specimen = read_specimen(case_file("zn1.toml"))
    sweep = read_sweep(case_file("table5.csv")).sweep(specimen.base_acceleration_m_s2)
    return PaperRun(
        specimen=specimen,
        sweep=sweep,
        direct=identify([File(sweep, specimen)], "direct", progress),
        paper=identify([File(sweep, specimen)], "paper", progress),
        undamped=identify([File(sweep, replace(specimen, modal_ratios=()))], "direct", progress),
        diagnosis=diagnose([File(sweep, specimen)], progress=progress),
    )
