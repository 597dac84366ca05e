"""Where on the plate a proposed measurement is made: the plate as it is held, with what goes where."""

from collections.abc import Sequence
from dataclasses import replace

from fitting.specimen import PlateSpecimen
from fitting.structures import AnySpecimen
from instrument.facts.follow_up import FollowUp
from instrument.results.sketch import Mark, View, sketch_of


def offer_view(specimen: AnySpecimen, offers: Sequence[FollowUp]) -> View | None:
    """Of the first that says a place; None where none does, and of what is no plate."""
    if not isinstance(specimen, PlateSpecimen):
        return None
    for offer in offers:
        marks = _marks(offer)
        if marks:
            return _view(specimen, offer, marks)
    return None


def _view(specimen: PlateSpecimen, offer: FollowUp, marks: list[Mark]) -> View:
    free = offer.held == "free"
    plate = replace(specimen, boundary="free") if free else specimen
    # Where the laser is aimed anew it is not where it was.
    if offer.spot_mm is not None:
        plate = replace(plate, pickup_m=None, further_pickups_m=())
    (view,) = sketch_of(plate, marks)
    held = "hung free, the edge that was clamped on the left" if free else "in its clamp"
    return replace(view, title=f"Seen from above, {held}: {offer.todo}")


def _marks(offer: FollowUp) -> list[Mark]:
    found = []
    if offer.spot_mm is not None:
        found.append(Mark(*offer.spot_mm, "laser", "spot"))
    if offer.struck_mm is not None:
        found.append(Mark(*offer.struck_mm, "hit", "hit"))
    if offer.mass_at_mm is not None and offer.mass_kg is not None:
        found.append(Mark(*offer.mass_at_mm, f"{1e3 * offer.mass_kg:g} g", "mass"))
    return found
