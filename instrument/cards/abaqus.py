"""Abaqus: *ELASTIC with instantaneous moduli, *VISCOELASTIC, TIME=PRONY."""

from instrument.cards.card import Card, commented


def abaqus(card: Card) -> str:
    """Keywords of a material; add *DENSITY."""
    p = card.prony
    lines = [
        *card.header(),
        card.about_series(),
        "moduli are instantaneous: E0 = 2 (1 + nu) G0; shares g, k are of G0, K0",
        "Abaqus has no units of its own: this is Pa and s; densities in kg/m^3 go with it",
    ]
    shift = card.law.shift
    trs = []
    if shift is not None and shift.shift == "wlf":
        # theta_0, C1, C2 with log10 A = -C1 (theta - theta_0) / (C2 + theta - theta_0), time over A.
        c1, c2 = (shift.shift_parameters[key] for key in ("c1", "c2_k"))
        trs = ["*TRS, DEFINITION=WLF", f"{shift.reference_c:.9g}, {c1:.9E}, {c2:.9E}"]
    return "\n".join(
        [
            *commented("**", lines),
            "*MATERIAL, NAME=VISCOELASTIC_CORE",
            "*ELASTIC, MODULI=INSTANTANEOUS",
            f"{card.young_pa(p.g_0_pa):.9E}, {card.poisson:.9g}",
            "*VISCOELASTIC, TIME=PRONY",
            *(f"{g:.9E}, {g:.9E}, {tau:.9E}" for g, tau in zip(p.shares, p.tau_s, strict=True)),
            *trs,
            "",
        ]
    )
