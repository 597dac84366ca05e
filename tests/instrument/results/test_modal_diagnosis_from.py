"""What is said of a diagnosis of tables of modes."""

from dataclasses import replace

import numpy as np
from beam_tables import BEAM, read

from instrument.finding.modal import diagnose_tables
from instrument.results.modal_diagnosis_from import modal_diagnosis_from

TABLE = read(BEAM, 4)


def errors_of(found):
    result = modal_diagnosis_from(found, [TABLE], ["a.csv"])
    (none,) = (c for c in result.candidates if c.name == "none")
    return np.array([row.storage_modulus_standard_error_pa for row in none.law])


def test_what_a_formula_may_get_wrong_leaves_tolerances_in_a_candidates_law_as_they_are():
    diagnosed = diagnose_tables([TABLE], [replace(BEAM, exact=False)])
    sharp, blunt = (
        errors_of(replace(diagnosed, found=replace(diagnosed.found, temper=t))) for t in (1.0, 100.0)
    )
    assert np.all(blunt > sharp)
    # All of it multiplied would be ten times as much.
    assert np.all(blunt < 8 * sharp)
