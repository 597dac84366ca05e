"""A session's report: every section of it, as one HTML text that needs nothing beside it, or as a PDF."""

from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path

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
from instrument.report.law_to_use import law_to_use_sections
from instrument.report.pdf import save_pdf, save_pictures
from instrument.report.setting import rig_section, specimen_section, versions_section
from instrument.report.struck import struck_sections
from instrument.report.sweep import sweep_section
from instrument.results.diagnosis_words import UNRELIABLE
from instrument.results.typeset import capitalised
from instrument.session.contents import Contents

_PACKAGES = ("viscorig", "numpy", "scipy", "h5py", "matplotlib")


@dataclass(frozen=True)
class Report:
    """What a report says, however it is written."""

    title: str
    header: tuple[tuple[str, str], ...]
    sections: tuple[ReportSection, ...]

    def html(self) -> str:
        """One page that needs nothing beside it."""
        return html_page(self.title, self.header, self.sections, signed=True)

    def save_pdf(self, path: Path) -> None:
        """Sheets of A4. Raises `OSError`."""
        save_pdf(path, self.title, self.header, self.sections)

    def save_pictures(self, path: Path) -> tuple[Path, ...]:
        """Sheets of A4 as a PNG each, numbered behind the name. Raises `OSError`."""
        return save_pictures(path, self.title, self.header, self.sections)


def report_of(contents: Contents, progress: Progress = quiet) -> Report:
    """The report of a session. Law and damping are computed here, from what was recorded."""
    fitted = ReportedFit.of(contents, progress)
    with progress("drawing"):
        sections = sections_of(contents, fitted)
    c = contents.configuration
    header = (
        ("operator", c.experiment.operator or "not stated"),
        ("date", c.created_utc.replace("T", " ").replace("+00:00", " UTC")),
        ("session", c.name),
        ("specimen file", c.experiment.specimen),
        *_warned(contents),
        ("result", result_in_short(contents, fitted)),
    )
    return Report(c.experiment.title or c.name, header, tuple(sections))


def _warned(contents: Contents) -> list[tuple[str, str]]:
    """Above numbers that nobody should take: what they are worth."""
    found = contents.diagnosis.result if contents.diagnosis is not None else None
    if found is None or found.verdict != "unknown":
        return []
    return [("warning", f"{capitalised(UNRELIABLE)}.")]


def sections_of(contents: Contents, fitted: ReportedFit) -> list[ReportSection]:
    """In the order in which it was done."""
    return [
        ending_section(contents),
        specimen_section(contents),
        rig_section(contents),
        hammer_section(contents),
        calibration_section(contents),
        sweep_section(contents, fitted),
        *struck_sections(contents),
        *law_to_use_sections(contents),
        identification_section(contents, fitted),
        unexplained_section(fitted),
        *diagnosis_sections(contents),
        versions_section(contents, {package: version(package) for package in _PACKAGES}),
    ]
