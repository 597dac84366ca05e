"""Abaqus: *ELASTIC with instantaneous moduli, *VISCOELASTIC, TIME=PRONY."""

from instrument.cards.card import Card


def abaqus(card: Card) -> str:
    """Keywords of a material; add *DENSITY."""
    p = card.prony
    lines = [
        *card.header(),
        card.about_series(),
        "moduli are instantaneous: E0 = 2 (1 + nu) G0; shares g, k are of G0, K0",
        "Abaqus has no units of its own: this is Pa and s; densities in kg/m^3 go with it",
    ]
    return "\n".join(
        [
            *(f"** {line}" for line in lines),
            "*MATERIAL, NAME=VISCOELASTIC_CORE",
            "*ELASTIC, MODULI=INSTANTANEOUS",
            f"{card.young_pa(p.g_0_pa):.9E}, {card.poisson:.9g}",
            "*VISCOELASTIC, TIME=PRONY",
            *(f"{g:.9E}, {g:.9E}, {tau:.9E}" for g, tau in zip(p.shares, p.tau_s, strict=True)),
            "",
        ]
    )
