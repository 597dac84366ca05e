"""COMSOL: a text file for an interpolation function (spreadsheet), the series in its comments."""

from instrument.cards.card import Card, commented


def comsol(card: Card) -> str:
    """Columns f, G', G''; lines with % are comments."""
    p = card.prony
    lines = [
        *card.header(),
        card.about_series(),
        f"generalised Maxwell: long-term shear modulus G_inf = {p.g_inf_pa:.9E} Pa; branches (Pa, s):",
        *(f"branch {G:.9E} {tau:.9E}" for G, tau in zip(p.g_pa, p.tau_s, strict=True)),
        card.about_table(),
        "interpolation function, argument f (Hz): Gp (Pa), Gpp (Pa), eta",
        "f Gp Gpp eta",
    ]
    rows = zip(card.law.frequency_hz, card.storage, card.loss, card.law.loss_factor, strict=True)
    return "\n".join([*commented("%", lines), *(" ".join(f"{v:.9E}" for v in row) for row in rows), ""])
