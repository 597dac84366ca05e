"""The page of the diagnosis."""

from gui.pages.diagnosis.page import DiagnosisPage

__all__ = ["DiagnosisPage"]
