"""An effect that a law was found beside, as its file says it."""

from collections.abc import Mapping

from pydantic import BaseModel

from instrument.facts.diagnosis import ParameterFound
from instrument.results.diagnosis_words import some_parameters


class NamedEffect(BaseModel):
    """Of the JSON of `diagnose`, or of `identify --shift`."""

    name: str
    parameters: Mapping[str, ParameterFound] = {}

    @property
    def words(self) -> str:
        """Its name and, where the file says it, its size."""
        return f"{self.name} ({some_parameters(self.parameters)})" if self.parameters else self.name
