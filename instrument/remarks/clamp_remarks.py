"""What is to be said of how a specimen is held: clamps hold a beam's width, and two of them pull."""

from fitting.digits import two_digits
from fitting.plate.plate_numbers import tolerance
from fitting.specimen import PlateSpecimen
from fitting.structures import AnySpecimen, Beam

_PULLED = 12.30 / 4.730**4
"""Of w^2, for N L^2/(E I): the first mode of a beam clamped at both ends (L^2 int phi'^2 over int phi^2;
Blevins, Formulas for Natural Frequency and Mode Shape, table 8-1)."""
_WORTH_SAYING = 1e-3
"""Of a resonance."""
_UNGRIPPED, _OF_MODULUS = 7.0, 0.01
"""Times thickness over length, how much lower G' of a free layer is found that ends at its clamp: of 2 mm on
steel and 3 mm on aluminium, 200 mm long, as solids, 7 and 11 %; and the least share worth saying."""


def remarks_on_clamps(specimen: AnySpecimen) -> tuple[str, ...]:
    """What clamps do that nobody states."""
    if isinstance(specimen, Beam):
        ends = (*_on_ends_of_treatment(specimen), *_on_end_of_free_layer(specimen))
        return (*_on_held_width(specimen), *_on_pulled_beam(specimen), *ends)
    return _on_pulled_plate(specimen) if isinstance(specimen, PlateSpecimen) else ()


def _on_pulled_beam(beam: Beam) -> tuple[str, ...]:
    if "two clamps" not in beam.offers:
        return ()
    return (_pulled("two clamps", beam, beam.length_m, beam.tolerance("axial")),)


def _on_ends_of_treatment(beam: Beam) -> tuple[str, ...]:
    """A layer that neither clamp grips imitates a softer core with less loss (docs/evidence/beams.md)."""
    if "two clamps" not in beam.offers or beam.constraining is None or beam.exact:
        return ()
    return (
        "both clamps are taken to grip the constraining layer: where it ends short of both nothing shows, "
        "and the first loss factor is found up to 60 % too low; look, or clamp one end alone",
    )


def _on_end_of_free_layer(beam: Beam) -> tuple[str, ...]:
    """It takes about its own thickness to be strained as its metal is."""
    if beam.core is None or beam.constraining is not None or beam.exact:
        return ()
    if not beam.boundary.startswith("clamped"):
        return ()
    lower = _UNGRIPPED * beam.core.thickness_m / beam.length_m
    if lower < _OF_MODULUS:
        return ()
    return (
        "the clamp is taken to grip the free layer with its metal: where the layer ends at the clamp G' is "
        f"found some {100 * lower:.0f} % too low, and nothing shows",
    )


def _on_pulled_plate(plate: PlateSpecimen) -> tuple[str, ...]:
    """Where opposite edges are clamped, of the shorter way between them."""
    sides = {"x": plate.length_m, "y": plate.width_m}
    if not plate.pulled_along:
        return ()
    shorter = min(sides[along] for along in plate.pulled_along)
    return (_pulled("clamps on opposite edges", plate, shorter, tolerance(plate, "axial")),)


def _pulled(by_what: str, specimen: Beam | PlateSpecimen, length_m: float, tolerance_pa: float) -> str:
    faces = [face for face in (specimen.substrate, specimen.constraining) if face is not None]
    thickness = sum(face.thickness_m for face in faces)
    rigidity = sum(face.young_pa * face.thickness_m**3 for face in faces) / 12
    higher = _PULLED / 2 * 1e6 * thickness * length_m**2 / rigidity
    within = "nothing, it is exact" if specimen.exact else f"{two_digits(1e-6 * tolerance_pa)} MPa"
    return (
        f"{by_what}, and a kelvin between a {specimen.kind} and its frame, pull it or press it "
        f"along: 1 MPa in its faces makes the first resonance up to {two_digits(100 * higher)} % higher, and "
        f"looks like a stiffer core with less loss; allowed for is {within} (axial_mpa); "
        "clamp one end alone if you can"
    )


def _on_held_width(beam: Beam) -> tuple[str, ...]:
    if beam.held_width:
        return ()
    higher = 2 * beam.held_width_m / beam.span_m
    if higher < _WORTH_SAYING:
        return ()
    as_if = f"as a span {1e3 * beam.held_width_m:.2g} mm shorter would"
    return (
        f"a clamp that holds the beam's width makes resonances up to {100 * higher:.2g} % higher, {as_if}: "
        "allowed for, not counted ([beam] held_width = true)",
    )
