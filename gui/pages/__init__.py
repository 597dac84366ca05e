"""The pages, in the order of their shortcuts Ctrl+1, Ctrl+2, ..."""

from gui.page import Page
from gui.pages.diagnosis import DiagnosisPage
from gui.pages.hammer import HammerPage
from gui.pages.material import MaterialPage
from gui.pages.run import RunPage
from gui.pages.sweep import SweepPage

PAGES: tuple[type[Page], ...] = (RunPage, SweepPage, HammerPage, MaterialPage, DiagnosisPage)
