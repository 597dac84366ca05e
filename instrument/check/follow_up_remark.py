"""What is not done after the sweep of another structure than a plate."""

from fitting.specimen import PlateSpecimen
from instrument.session.configuration import Experiment


def follow_up_remarks(experiment: Experiment) -> list[str]:
    """A remark where measurements are to follow a diagnosis that none are known for; nothing otherwise."""
    specimen, wanted = experiment.the_specimen(), experiment.document.diagnosis.follow_up
    if isinstance(specimen, PlateSpecimen) or wanted == "none" or experiment.document.sweep is None:
        return []
    return [
        f'diagnosis.follow_up = "{wanted}" is for plates only: '
        f"nothing is measured after the sweep of a {specimen.kind}"
    ]
