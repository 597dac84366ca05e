"""What `identify` and `diagnose` say of a case: functions of a module, for other processes."""

from campaign.beams.cases import BeamCase
from campaign.plates.answers import Answer, Band, answer_from, band_from
from instrument.models.files import File
from instrument.models.together import diagnose_together, identify_together
from instrument.results.together_from import diagnosed_together_from, identified_together_from


def identified(case: BeamCase) -> Band:
    """The law with its errors."""
    files = [File(case.sweep, case.specimen)]
    return band_from(identified_together_from(identify_together(files), files).law)


def diagnosed(case: BeamCase) -> Answer:
    """With the whole catalogue."""
    files = [File(case.sweep, case.specimen)]
    return answer_from(diagnosed_together_from(diagnose_together(files), files))
