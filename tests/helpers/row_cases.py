"""Rows of a batch made by hand: laws that are the same but for a factor."""

import numpy as np

from instrument.batch.run import BatchRow
from instrument.batch.task import BatchTask

FREQUENCIES_HZ = np.geomspace(15.0, 290.0, 12)
KNOWN = 0.01
"""Standard error of each row's law, relative."""


def row(number, factor, temperature_c=None, **outcome):
    """A law `factor` times the common one in G'; eta is common."""
    f = FREQUENCIES_HZ
    storage, loss = 1e6 * factor * (f / 60) ** 0.3, np.full(len(f), 0.4)
    law = {
        "frequency_hz": f,
        "storage_modulus_pa": storage,
        "loss_factor": loss,
        "storage_modulus_standard_error_pa": KNOWN * storage,
        "loss_factor_standard_error": KNOWN * loss,
    }
    facts = {"failed": "", "verdict": "none", "law": {k: v.tolist() for k, v in law.items()}}
    facts |= dict.fromkeys(("lowest_hz", "highest_hz", "points", "converged", "law_kind"))
    facts |= dict.fromkeys(("rms_percent", "chi2_per_dof", "borrowed_model"))
    facts |= {"leave_one_out_rms_percent": 1.0, "held_out_rms_percent": None, "effects": [], "warnings": []}
    facts |= {"parameters": {}, "standard_errors": {}, "lowest_hz": f[0], "highest_hz": f[-1]}
    return BatchRow(BatchTask(f"{number}.csv", temperature_c=temperature_c), {**facts, **outcome})


def rows(count, spread, seed=1, **how):
    rng = np.random.default_rng(seed)
    off = spread * rng.standard_normal(count) + KNOWN * rng.standard_normal(count)
    return [row(k, float(np.exp(o)), **how) for k, o in enumerate(off)]
