"""The page: every section of a session, rendered to one HTML text that needs nothing beside it."""

from importlib.metadata import version

from instrument.progress import Progress, quiet
from instrument.report.blocks import ReportSection
from instrument.report.calibration import calibration_section
from instrument.report.diagnosis import diagnosis_sections
from instrument.report.ending import ending_section
from instrument.report.fitted import ReportedFit
from instrument.report.hammer import hammer_section
from instrument.report.html import html_page
from instrument.report.identification import (
    identification_section,
    result_in_short,
    unexplained_section,
)
from instrument.report.setting import rig_section, specimen_section, versions_section
from instrument.report.sweep import sweep_section
from instrument.session.contents import Contents

_PACKAGES = ("viscorig", "numpy", "scipy", "h5py", "matplotlib")


def report_page(contents: Contents, progress: Progress = quiet) -> str:
    """The report of a session as HTML. Law and damping are computed here, from what was recorded."""
    fitted = ReportedFit.of(contents, progress)
    with progress("drawing"):
        sections = sections_of(contents, fitted)
    c = contents.configuration
    header = [
        ("operator", c.experiment.operator or "not stated"),
        ("date", c.created_utc.replace("T", " ").replace("+00:00", " UTC")),
        ("session", c.name),
        ("specimen file", c.experiment.specimen),
        ("result", result_in_short(contents, fitted)),
    ]
    return html_page(c.experiment.title or c.name, header, sections, signed=True)


def sections_of(contents: Contents, fitted: ReportedFit) -> list[ReportSection]:
    """In the order in which it was done."""
    return [
        ending_section(contents),
        specimen_section(contents),
        rig_section(contents),
        hammer_section(contents),
        calibration_section(contents),
        sweep_section(contents, fitted),
        identification_section(contents, fitted),
        unexplained_section(fitted),
        *diagnosis_sections(contents),
        versions_section(contents, {package: version(package) for package in _PACKAGES}),
    ]
