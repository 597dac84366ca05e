"""The page of a report, and its words."""

import re
from html import unescape

from instrument.report.page import report_of
from instrument.session.contents import contents_of
from instrument.session.storage import SessionFile


def page_of(path):
    with SessionFile(path) as file:
        return report_of(contents_of(file)).html()


def text_of(page):
    """Its words without markup or figures."""
    body = page[page.index("<body>") :]
    return unescape(" ".join(re.sub(r"<[^>]*>", " ", body).split()))


def section(page, title):
    """The words of one section."""
    start = page.index(f"<h2>{title}</h2>")
    return text_of("<body>" + page[start : page.index("</section>", start)])


def row(words, first):
    """The numbers behind a row's name."""
    return [float(v) for v in re.findall(r"[-+]?\d+\.?\d*(?:e-?\d+)?", words.split(first, 1)[1])]
