"""A cantilever plate of any size on the simulated rig: from the file that names it to its plant."""

from drivers.simulated.plant import specimen as published
from drivers.simulated.plant.bare import OTHER_RATIO
from drivers.simulated.plant.built import refuse_effects
from drivers.simulated.plant.built_plate import (
    ReducedPlate,
    mounted_plate,
    really,
    reduced_plate,
    struck_plate,
)
from drivers.simulated.plant.effects import Effects
from drivers.simulated.plant.hung_plate import hung_plate, reduced_free_plate
from drivers.simulated.plant.law import ZN1, MaxwellLaw
from drivers.simulated.plant.layered_solid import Sheet
from drivers.simulated.plant.solid_plate import PlateStated
from drivers.simulated.plant.structure import Structure
from drivers.simulated.plates import Hang, Mount, Struck
from fitting.dynamics.unstated_damping import MODES
from fitting.specimen import PlateSpecimen
from instrument.models.cache import cached
from instrument.progress import Progress, quiet
from instrument.simulated_case.layers import core_sheet, face_sheet, series_of


def unlike_a_cantilever(plate: PlateSpecimen) -> str:
    """What the simulated rig cannot build of a plate; empty where it can."""
    faces = [face for face in (plate.substrate, plate.constraining) if face is not None]
    reasons = (
        (plate.boundary != "cantilever", f"boundary {plate.boundary}"),
        (plate.core is None or plate.constraining is None, "no constrained core"),
        (plate.pickup_m is None, "no [pickup]"),
        (bool(plate.patches), "patches"),
        (plate.both_sides, "a treatment on both sides"),
        (plate.core is not None and bool(plate.core.glue), "glue"),
        (any(face.rolled is not None for face in faces), "an orthotropic face"),
        (plate.force_m is not None, "a force that drives it"),
        (bool(plate.masses), "[[mass]] (effects.added_mass puts one on)"),
    )
    return next((said for wrong, said in reasons if wrong), "")


def plate_mount(plate: PlateSpecimen, effects: Effects, progress: Progress = quiet) -> Mount:
    """How it is mounted; its solid from the cache, or built. Raises `ValueError`."""
    assert plate.core is not None
    assert plate.pickup_m is not None
    refuse_effects(plate.kind, effects)
    law = effects.core_law.law if effects.core_law else series_of(plate.core.law)
    stated, spot_m = really(plate_of(plate), effects), plate.pickup_m

    def build() -> ReducedPlate:
        with progress("building the simulated plate") as report:
            return reduced_plate(stated, law, report)

    reduced = cached("plate", [stated, law], ReducedPlate, build)
    return lambda effects, by_hand: mounted_plate(
        stated, reduced, law, _ratios(plate), spot_m, effects, by_hand
    )


def _ratios(plate: PlateSpecimen) -> tuple[float, ...]:
    """Of the treated plate: a file that states none has the bare plate's."""
    return plate.modal_ratios or (OTHER_RATIO,) * MODES


def plate_struck(plate: PlateSpecimen, effects: Effects, progress: Progress = quiet) -> Struck:
    """The substrate alone, under a hammer."""
    whole = plate_of(plate)
    bare = PlateStated(whole.length_m, whole.width_m, whole.sheets[:1])

    def build() -> ReducedPlate:
        with progress("building the simulated bare plate") as report:
            return reduced_plate(bare, report=report)

    reduced = cached("bare-plate", [bare], ReducedPlate, build)
    return lambda hit_m, response_m, sensor_kg: struck_plate(
        bare, reduced, plate.modal_ratios, effects, hit_m, response_m, sensor_kg
    )


def plate_hung(plate: PlateSpecimen | None, effects: Effects, progress: Progress = quiet) -> Hang:
    """The treated plate without its clamp, or the published one; built when it is hung first, then kept.

    It is as long as it stands out of its clamp: this clamp holds it by its end alone.
    """
    if plate is None:
        layers = published.LAYERS
        sheets = tuple(Sheet(s.thickness_m, s.young_pa, s.poisson, s.density_kg_m3) for s in layers)
        whole, law = PlateStated(published.LENGTH_M, published.WIDTH_M, sheets), ZN1
    else:
        assert plate.core is not None
        whole, law = plate_of(plate), series_of(plate.core.law)
    law = effects.core_law.law if effects.core_law else law
    stated = really(whole, effects)
    key = [stated, law, effects.partial_debond]

    def build() -> ReducedPlate:
        with progress("building the simulated plate as it hangs free") as report:
            return reduced_free_plate(stated, law, report, loose=effects.partial_debond)

    def hang(
        effects: Effects, law_now: MaxwellLaw, hit_m: tuple[float, float], read_m: tuple[float, float]
    ) -> Structure:
        reduced = cached("free-plate", key, ReducedPlate, build)
        return hung_plate(stated, reduced, law_now, effects, hit_m, read_m)

    return hang


def plate_of(plate: PlateSpecimen) -> PlateStated:
    """Its layers from below."""
    assert plate.core is not None
    assert plate.constraining is not None
    sheets = (face_sheet(plate.substrate), core_sheet(plate.core), face_sheet(plate.constraining))
    return PlateStated(plate.length_m, plate.width_m, sheets)
