"""What stands on the simulated shaker: from the file that `[simulation]` names to a beam's or pair's plant.

The file says what stands there; where it differs from the experiment's own specimen, that is hidden.
"""

from dataclasses import replace
from pathlib import Path

import numpy as np

from drivers.simulated.plant.built import (
    Reduced,
    beam_stated,
    mass_x_m,
    mounted_beam,
    mounted_pair,
    reduced_beam,
    reduced_pair,
    refuse_effects,
)
from drivers.simulated.plant.effects import Effects
from drivers.simulated.plant.mounted import Mounted
from drivers.simulated.plant.solid_beam import BeamStated
from drivers.simulated.plant.solid_pad import PairStated
from drivers.simulated.plant.struck_beam import struck_beam
from drivers.simulated.plates import Struck
from fitting.specimen import PlateSpecimen
from fitting.structures import Beam, ShearPair
from instrument.errors import BadInput
from instrument.files.rig_file import Simulation
from instrument.files.structure_file import read_structure
from instrument.models.cache import cached
from instrument.progress import Progress, quiet
from instrument.simulated_case.layers import core_sheet, face_sheet, series_of
from instrument.simulated_case.plate import unlike_a_cantilever


def stands_on(simulation: Simulation, rig_path: Path) -> Beam | ShearPair | PlateSpecimen:
    """What the rig file's `[simulation]` names. Raises `BadInput`."""
    assert simulation.specimen is not None
    path = rig_path.parent / simulation.specimen
    read = read_structure(path)
    if isinstance(read, PlateSpecimen):
        unlike = unlike_a_cantilever(read)
        if unlike:
            raise BadInput(
                f"{rig_path}: simulation.specimen: {path.name} has {unlike}, expected a cantilever plate "
                "with one constrained core, a beam or a shear pair"
            )
        return read
    if read.core is None:
        raise BadInput(f"{rig_path}: simulation.specimen: {path.name} has no [core], expected a damped one")
    if isinstance(read, Beam):
        if read.boundary == "free-free":
            raise BadInput(f"{rig_path}: simulation.specimen: a free beam stands on no shaker")
        if read.masses:
            raise BadInput(
                f"{rig_path}: simulation.specimen: {path.name} has [[mass]], expected none: "
                "effects.added_mass puts one on"
            )
        if read.pickup_m is None:
            raise BadInput(f"{path}: [pickup] is missing, expected x_mm of the measured spot")
    return read


def mounted_structure(specimen: Beam | ShearPair, effects: Effects, progress: Progress = quiet) -> Mounted:
    """On the shaker, with what it hides; its solid from the cache, or built. Raises `ValueError`."""
    assert specimen.core is not None
    refuse_effects(specimen.kind, effects)
    law = effects.core_law.law if effects.core_law else series_of(specimen.core.law)
    if isinstance(specimen, ShearPair):
        pair = pair_of(specimen, effects)
        return mounted_pair(pair, cached("pair", [pair], Reduced, lambda: reduced_pair(pair)), law, effects)
    beam = beam_stated(beam_of(specimen), effects)

    def build() -> Reduced:
        with progress("building the simulated beam") as report:
            return reduced_beam(beam, law, report, effects=effects)

    key = [beam, law, effects.clamp_compliance, mass_x_m(beam, effects)]
    return mounted_beam(beam, cached("beam", key, Reduced, build), law, effects)


def beam_of(beam: Beam) -> BeamStated:
    """Its layers from below."""
    assert beam.core is not None
    assert beam.pickup_m is not None
    assert beam.boundary != "free-free"
    substrate, core = face_sheet(beam.substrate), core_sheet(beam.core)
    above = [core, *([face_sheet(beam.constraining)] if beam.constraining is not None else [])]
    sheets = [*(reversed(above) if beam.both_sides else ()), substrate, *above]
    cores = tuple(k for k, sheet in enumerate(sheets) if sheet is core)
    return BeamStated(beam.length_m, beam.width_m, beam.boundary, tuple(sheets), cores, beam.pickup_m)


def beam_struck(beam: Beam, effects: Effects) -> Struck:
    """The substrate alone under a hammer, before its treatment; built anew where the sensor is moved."""
    whole = beam_of(beam)
    bare = replace(whole, sheets=(face_sheet(beam.substrate),), cores=())
    return lambda hit_m, response_m, sensor_kg: struck_beam(bare, effects, hit_m[0], response_m[0], sensor_kg)


def pair_of(pair: ShearPair, effects: Effects) -> PairStated:
    """Its discs; of which the area alone is stated, full ones."""
    thick = effects.core_thickness.scale if effects.core_thickness else 1.0
    # A = pi/4 (D^2 - d^2) and kappa^2 = (D^2 + d^2)/16.
    square = 4 * pair.area_m2 / np.pi
    total = 16 * pair.gyration_m**2 if pair.gyration_m is not None else square
    outer, inner = np.sqrt((total + square) / 2), np.sqrt(max(total - square, 0.0) / 2)
    core = pair.core
    # Rounding: a full disc has no hole of a nanometre.
    inner = float(inner) if inner > 1e-6 * outer else 0.0
    return PairStated(
        pair.mass_kg, pair.discs, thick * core.thickness_m, float(outer), inner, core.density_kg_m3
    )
