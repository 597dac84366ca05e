"""Modes of tables beside the model's, and the law over their range."""

from collections.abc import Sequence

from instrument.cli.output import Output
from instrument.facts.modal import FormulaRow, ModeFitted
from instrument.facts.rows import LawRow
from instrument.results.law_words import LAW_COLUMNS, law_cells

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
    title = "the law over the modes, +- one standard error (tables, tolerances)"
    out.table(title, list(LAW_COLUMNS), law_cells(law[:: max(1, len(law) // _ROWS)]))


def print_formulas(out: Output, rows: Sequence[FormulaRow]) -> None:
    """What the standards' formulas make of single modes, and why not to trust them."""
    if not rows:
        return
    out.say()
    if rows[0].method == "central-impedance":
        title = "by central impedance: the whole beam"
        columns = ["file", "mode", "f/Hz", "bending stiffness/(N m^2)", "loss factor"]
        shown = [
            [
                f"{r.file}",
                f"{r.mode}",
                f"{r.frequency_hz:.5g}",
                f"{r.bending_stiffness_n_m2:.5g}",
                f"{r.loss_factor:.4g}",
            ]
            for r in rows
        ]
        out.table(title, columns, shown)
        return
    columns = ["file", "mode", "f/Hz", "G'/MPa", "full model", "loss factor", "full model"]
    shown = [
        [
            f"{r.file}",
            f"{r.mode}",
            f"{r.frequency_hz:.5g}",
            *(f"{(G or 0.0) / 1e6:.4g}" for G in (r.storage_modulus_pa, r.full_storage_modulus_pa)),
            *(f"{eta or 0.0:.4g}" for eta in (r.loss_factor, r.full_loss_factor)),
        ]
        for r in rows
    ]
    out.table(f"by formula, mode by mode (ASTM E756, {rows[0].method})", columns, shown)
    for r in rows:
        for text in r.objections:
            out.say(f"note: mode {r.mode} by formula: {text}")
