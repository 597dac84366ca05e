"""Results made by hand: what is said of them does not depend on how they were found."""

from instrument.facts.identification import IdentificationResult

LAW_ROW = {
    "frequency_hz": 100.0,
    "storage_modulus_pa": 4e5,
    "loss_factor": 0.9,
    "storage_modulus_standard_error_pa": 1e3,
    "loss_factor_standard_error": 0.01,
}

IDENTIFY_KEYS = {
    "parameters", "standard_errors", "correlations", "points", "rms_percent", "max_percent",
    "leave_one_out_rms_percent", "held_out", "held_out_rms_percent", "iterations", "evaluations",
    "seconds", "setup_seconds", "converged", "criterion_met", "warnings", "law",
}  # fmt: skip
"""Of its JSON, whatever the data are."""


def identification(**keys):
    """The least that an identification says, and what is asked for."""
    least = {
        "law_kind": "constant",
        "parameters": {"g_pa": 4e5},
        "standard_errors": {"g_pa": 1e3},
        "correlations": {"g_pa": {"g_pa": 1.0}},
        "points": [],
        "rms_percent": 1.0,
        "max_percent": 2.0,
        "law": [LAW_ROW],
    }
    return IdentificationResult.model_validate({**least, **keys})
