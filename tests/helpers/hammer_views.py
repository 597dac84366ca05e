"""The hits of the small session, and what they would say if others of them counted."""

import pytest

from gui.pages.hammer.choice import WhatIf
from instrument.impact.damping import damping_of_hits
from instrument.impact.result import damping_from
from instrument.session.contents import contents_of
from instrument.session.storage import SessionFile

BAND_HZ = (10.0, 550.0)


@pytest.fixture(scope="module")
def hits(session_path):
    """Three, the second one a double hit."""
    with SessionFile(session_path) as file:
        return tuple(contents_of(file).hits)


def only(hits, numbers):
    """As they count where just these do."""
    what_if = WhatIf()
    for hit in hits:
        what_if.say(hit, hit.number in numbers)
    return what_if.applied(hits)


def by_command(hits, numbers):
    """What `viscorig damping` would say of these hits."""
    judged = [h.judged() for h in only(hits, numbers)]
    return damping_from(damping_of_hits(judged, band_hz=BAND_HZ))
