"""The JSON of an identification made by hand."""

import numpy as np
from paper_law import TABLE_4

from fitting.identification.known_curve import known_curve
from fitting.identification.result import LawBand
from instrument.results.rows_from import law_known_from

LOW, HIGH = 14.0, 300.0
ERRORS = np.array([0.03, 0.02, 0.04, 0.01])
NAMES = TABLE_4.names


def facts(law, *, low=LOW, high=HIGH, errors=ERRORS, posterior=True):
    """As `identify` says them, its parameters uncertain by `errors` in their logarithms, unrelated."""
    f = np.geomspace(low, high, 41)
    omega = 2 * np.pi * f
    G, eta = law.storage_and_loss(omega)
    by = law.jacobian(omega) * law.values[:, None]
    error_G = np.sqrt(errors**2 @ by.real**2)
    error_eta = np.sqrt(errors**2 @ ((by.imag - eta * by.real) / G) ** 2)
    keys = (
        "frequency_hz",
        "storage_modulus_pa",
        "loss_factor",
        "storage_modulus_standard_error_pa",
        "loss_factor_standard_error",
    )
    columns = [column.tolist() for column in (f, G, eta, error_G, error_eta)]
    found = {
        "law_kind": law.kind,
        "parameters": dict(zip(NAMES, law.values.tolist(), strict=True)),
        "standard_errors": dict(zip(NAMES, (errors * law.values).tolist(), strict=True)),
        "correlations": {a: {b: float(a == b) for b in NAMES} for a in NAMES},
        "law": [dict(zip(keys, row, strict=True)) for row in zip(*columns, strict=True)],
    }
    if posterior and np.isfinite(errors).all():
        found["law_known"] = said_of_curve(law, np.diag(errors**2), (), low, high)
    if not posterior:
        found["standard_errors"] = dict.fromkeys(NAMES)
        found["correlations"] = {a: dict.fromkeys(NAMES) for a in NAMES}
    return found


def said_of_curve(law, covariance, stated, low=LOW, high=HIGH):
    """How well the curve is known as a whole, as JSON has it."""
    nothing = np.zeros(0)
    band = LawBand(*(nothing,) * 5, known_curve(law, covariance, stated, low, high))
    return law_known_from(band).model_dump(mode="json")


THICK = {"name": "core_thickness", "stated": 1.0, "tolerance": 0.03, "unit": "mm"}
SPOT = {"name": "pickup_x", "stated": 200.0, "tolerance": 0.3, "unit": "mm"}
OF_ALL = np.array([-0.06, -0.06, 0.0, 0.0])
"""What a core thicker than stated by its tolerance does to the law's logarithms."""
OF_ONE = np.array([0.02, 0.02, 0.0, 0.0])
"""What a spot off by its tolerance does."""


def of_tolerances(law, **how):
    """As `identify` says them of a law whose core's thickness and whose spot are stated with tolerances."""
    by = np.stack([OF_ALL, OF_ONE], axis=1)
    C = np.block([[np.diag(ERRORS**2) + by @ by.T, by], [by.T, np.eye(2)]])
    said = facts(law, errors=np.sqrt(np.diag(C)[:4]), **how)
    known = said_of_curve(law, C, [THICK["name"], SPOT["name"]])
    return {**said, "adjusted": [THICK, SPOT], "law_known": known}
