"""What `identify` and `diagnose` say of a case: functions of a module, for other processes."""

from campaign.beams.cases import BeamCase
from campaign.plates.answers import Answer, Band, answer_from, band_from
from instrument.finding.diagnosis import diagnose
from instrument.finding.identification import identify
from instrument.models.files import File
from instrument.results.diagnosis_from import diagnosis_from
from instrument.results.identification_from import identification_from


def identified(case: BeamCase) -> Band:
    """The law with its errors."""
    files = [File(case.sweep, case.specimen)]
    return band_from(identification_from(identify(files)).law)


def diagnosed(case: BeamCase) -> Answer:
    """With the whole catalogue."""
    files = [File(case.sweep, case.specimen)]
    return answer_from(diagnosis_from(diagnose(files)))
