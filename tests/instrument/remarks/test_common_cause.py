"""A cause that all files have in common may cost the law more than one of a single file."""

from dataclasses import replace

import pytest
from diagnosis_cases import diagnosed, sweep

from fitting.diagnosis.several.of_files import ALIKE, EACH
from fitting.diagnosis.verdict.result import FoundEffect, ParameterEstimate
from instrument.remarks.common_cause import remarks_on_common_causes

NAN = float("nan")


def found(file, *, storage=1.0, loss=1.0):
    """A gain of a file, or of all of them, with errors of the law so many times as large as without."""
    result = diagnosed(sweep()).result
    of = {} if file is None else {"file": ParameterEstimate(float(file), NAN, "1")}
    gain = FoundEffect("gain_error", {"factor": ParameterEstimate(1.03, 0.01, "1"), **of})
    band = result.before.band
    after = replace(
        band,
        storage_modulus_standard_error_pa=storage * band.storage_modulus_standard_error_pa,
        loss_factor_standard_error=loss * band.loss_factor_standard_error,
    )
    return replace(result, effects=(gain,), after=replace(result.after, band=after))


@pytest.mark.parametrize(
    ("storage", "loss", "said"),
    [
        (2.0, 1.0, "2 times as wide in G' as without"),
        (2.0, 3.0, "2 times as wide in G' and 3 times as wide in the loss factor as without"),
        (1.4, 1.4, None),
        (NAN, NAN, None),
    ],
)
def test_a_common_cause_that_widens_the_band_is_said(storage, loss, said):
    remarks = remarks_on_common_causes(found(ALIKE, storage=storage, loss=loss), 2)
    assert len(remarks) == (said is not None)
    assert all(
        r.startswith(f"with gain_error in every file the law's band is {said}: what all files have")
        for r in remarks
    )


@pytest.mark.parametrize("file", [EACH, 1, 2, None])
def test_a_cause_that_is_not_common_is_not(file):
    assert remarks_on_common_causes(found(file, storage=5.0), 2) == ()


def test_one_file_has_nothing_in_common():
    assert remarks_on_common_causes(found(ALIKE, storage=5.0), 1) == ()
    assert remarks_on_common_causes(found(ALIKE, storage=5.0), 2)
