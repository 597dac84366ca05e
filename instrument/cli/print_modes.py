"""Modes of tables beside the model's, and the law over their range."""

from collections.abc import Sequence

from instrument.cli.output import Output
from instrument.facts.modal import ModeFitted
from instrument.facts.rows import LawRow

_ROWS = 6


def print_modes(out: Output, modes: Sequence[ModeFitted]) -> None:
    """Measured and predicted, mode by mode."""
    rows = [
        [
            f"{m.file}",
            f"{m.mode}",
            *(f"{f:.5g}" for f in (m.frequency_hz, m.predicted_hz)),
            *(f"{eta:.4g}" for eta in (m.loss_factor, m.predicted_loss_factor)),
        ]
        for m in modes
    ]
    columns = ["file", "mode", "f/Hz", "predicted", "loss factor", "predicted"]
    out.table("mode by mode", columns, rows)


def print_modal_law(out: Output, law: Sequence[LawRow]) -> None:
    """A few rows of it."""
    every = law[:: max(1, len(law) // _ROWS)]
    rows = [
        [
            f"{r.frequency_hz:.1f}",
            f"{r.storage_modulus_pa / 1e6:.4f} +- {r.storage_modulus_standard_error_pa / 1e6:.4f}",
            f"{r.loss_factor:.4f} +- {r.loss_factor_standard_error:.4f}",
        ]
        for r in every
    ]
    title = "the law over the modes, +- one standard error (tables, tolerances)"
    out.table(title, ["frequency/Hz", "G'/MPa", "loss factor"], rows)
