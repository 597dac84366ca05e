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


def test_an_effect_at_the_end_of_what_is_plausible_is_said_and_leaves_the_law_in_doubt():
    diagnosed = diagnose_tables([read(replace(BEAM, length_m=0.38), 4)], [BEAM])
    found = diagnosed.found
    accepted = found.judgement.accepted
    assert accepted is not None
    for name, said in ("", ()), ("tether", ("tether ends at the limit of what is plausible",)):
        judgement = replace(found.judgement, accepted=replace(accepted, too_large=name))
        result = modal_diagnosis_from(
            replace(diagnosed, found=replace(found, judgement=judgement)), [TABLE], ["a.csv"]
        )
        warned = [w for w in result.warnings if "plausible" in w]
        assert tuple(w.partition(":")[0] for w in warned) == said
        assert set(warned) <= set(result.doubts)


def test_a_row_that_is_as_likely_is_said_beside_the_verdict_and_asked_to_be_read_again():
    diagnosed = diagnose_tables([TABLE], [BEAM])
    plain = modal_diagnosis_from(diagnosed, [TABLE], ["a.csv"])
    beside = modal_diagnosis_from(replace(diagnosed, rival="mode 1 does not go"), [TABLE], ["a.csv"])
    assert beside.explanation[-1].startswith(
        "About as likely one row of the table is not as it should be: mode 1"
    )
    assert beside.next_measurement.startswith("That mode's peak once more")
    assert beside.explanation[:-1] == plain.explanation
    assert beside.verdict == plain.verdict


def test_a_row_that_is_likelier_than_any_effect_leaves_the_law_in_doubt():
    plain = diagnose_tables([TABLE], [BEAM])
    odd = modal_diagnosis_from(replace(plain, misread="mode 1 does not go"), [TABLE], ["a.csv"])
    assert odd.doubts[0] == "mode 1 does not go"
    assert odd.doubts[1:] == modal_diagnosis_from(plain, [TABLE], ["a.csv"]).doubts
    # It is in the explanation, and not among the remarks once more.
    assert not any("mode 1" in said for said in odd.warnings)
