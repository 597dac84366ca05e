"""Sections to one HTML text that needs nothing beside it."""

from collections.abc import Sequence
from pathlib import Path

from jinja2 import Environment, FileSystemLoader, StrictUndefined

from instrument.report.blocks import ReportSection
from instrument.report.picture import as_svg, in_words
from instrument.results.typeset import typeset

_TEMPLATE = "page.html"


def html_page(
    title: str, header: Sequence[tuple[str, str]], sections: Sequence[ReportSection], *, signed: bool = False
) -> str:
    """`header` are names and values under the title; a page to be `signed` ends with room for it.

    All is escaped: much of it is foreign text.
    """
    environment = Environment(
        loader=FileSystemLoader(Path(__file__).parent),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters["as_svg"] = as_svg
    environment.filters["in_words"] = in_words
    environment.filters["typeset"] = typeset
    return environment.get_template(_TEMPLATE).render(
        title=title, header=header, sections=sections, signed=signed
    )
