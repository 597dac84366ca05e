"""The JSON of an identification made by hand."""

import numpy as np
from conftest import TABLE_4

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
    if not posterior:
        found["standard_errors"] = dict.fromkeys(NAMES)
        found["correlations"] = {a: dict.fromkeys(NAMES) for a in NAMES}
    return found
