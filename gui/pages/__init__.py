"""The pages by their names, in the order of their keys Ctrl+1, Ctrl+2, ...; other packages' come last."""

from typing import Any

from fitting.plugins import NoPlugin, Registry
from gui.page import Page
from gui.pages.diagnosis import DiagnosisPage
from gui.pages.hammer import HammerPage
from gui.pages.material import MaterialPage
from gui.pages.run import RunPage
from gui.pages.sweep import SweepPage
from gui.pages.together import TogetherPage


def _judge(name: str, found: Any) -> type[Page]:
    if not (isinstance(found, type) and issubclass(found, Page)):
        raise NoPlugin(f"{found!r:.80} is no class derived from gui.page.Page")
    if not found.title:
        raise NoPlugin("its page has no title")
    return found


PAGES: Registry[type[Page]] = Registry(
    "viscorig.pages",
    {
        "run": RunPage,
        "sweep": SweepPage,
        "hammer": HammerPage,
        "material": MaterialPage,
        "diagnosis": DiagnosisPage,
        "together": TogetherPage,
    },
    _judge,
)
