"""What is wrong between an experiment's files, each of them well in itself: all of it, a line each."""

from collections.abc import Iterator

from drivers.simulated.climate import HIGHEST_C, LOWEST_C
from fitting.errors import OutsideModel
from fitting.gravity import PUBLISHED_G_M_S2
from fitting.specimen import PlateSpecimen
from instrument.check.bare_test import bare_test_objections
from instrument.check.forecast import Forecast, distinct, planned_segment, sections_of
from instrument.errors import BadInput
from instrument.files.acceleration import in_both
from instrument.files.beam_file import BeamDocument
from instrument.files.devices import ranges_of
from instrument.files.specimen_file import SpecimenDocument, read_specimen
from instrument.files.structure_file import ShearPairDocument
from instrument.models.set_up import check_like
from instrument.session.configuration import Experiment
from instrument.session.setup import sweep_settings
from instrument.simulated_case import case_file
from instrument.simulated_case.spot import spot_elsewhere
from instrument.simulated_case.stated import refuse_simulation
from instrument.simulated_case.structure import stands_on

_SAMPLES_A_CYCLE = 4.0
"""Below, a front-end's own filter is near."""


def experiment_objections(experiment: Experiment, forecast: Forecast, parts: tuple[str, ...]) -> list[str]:
    """Empty for an experiment whose `parts` (hammer, sweep) can be run."""
    found = [*_parts(experiment, parts)]
    try:
        refuse_simulation(experiment.rig, experiment.rig_path)
    except BadInput as error:
        found.append(str(error))
    found += _simulated_plate(experiment)
    if "hammer" in parts or experiment.document.diagnosis.follow_up != "none":
        found += _hammer(experiment)
    if "sweep" in parts:
        found += [*_temperature(experiment), *_sweep(experiment, forecast)]
    return found


def _simulated_plate(experiment: Experiment) -> Iterator[str]:
    """What stands on the simulated rig: another specimen would be fitted to its response."""
    simulation, specimen = experiment.rig.simulation, experiment.the_specimen()
    if simulation is None:
        return
    if simulation.specimen is not None:
        try:
            stands = stands_on(simulation, experiment.rig_path)
        except BadInput:
            # Said as the rig file's own fault.
            return
        if stands.kind != specimen.kind:
            yield (
                f"{experiment.specimen_path}: a {specimen.kind}, but on the simulated rig stands a "
                f"{stands.kind} ({simulation.specimen}): expected one kind"
            )
        elif isinstance(stands, PlateSpecimen) and isinstance(specimen, PlateSpecimen):
            try:
                check_like(specimen, stands)
            except OutsideModel as error:
                said = str(error).partition(", expected")[0]
                yield (
                    f"{experiment.specimen_path}: on the simulated rig stands another plate "
                    f"({simulation.specimen}): {said}; expected that one"
                )
        return
    if not isinstance(specimen, PlateSpecimen):
        yield (
            f"{experiment.specimen_path}: a {specimen.kind}, but the simulated rig has the published plate: "
            f'expected [simulation] specimen = "{experiment.specimen_path.name}" in '
            f"{experiment.rig_path.name}"
        )
        return
    published = read_specimen(case_file("specimen.toml"))
    spot_m = spot_elsewhere(specimen)
    # One that is simulated for the run is told the spot.
    if spot_m is not None and published.pickup_m is not None and not experiment.rig.is_simulated:
        x, y = (1e3 * v for v in spot_m)
        at_x, at_y = (1e3 * v for v in published.pickup_m)
        yield (
            f"{experiment.specimen_path}: pickup at {x:g}, {y:g} mm, but the simulated rig reads the "
            f"published plate at {at_x:g}, {at_y:g}: expected that, or address = "
            f'"simulated" for all devices in {experiment.rig_path.name}, which reads it anywhere'
        )
    try:
        check_like(specimen, published)
    except OutsideModel as error:
        said = str(error).partition(", expected")[0]
        yield (
            f"{experiment.specimen_path}: the simulated rig has the published plate (300.2 x 199.9 mm), no "
            f"other: {said}; expected that plate's specimen, or a real rig"
        )


def _parts(experiment: Experiment, parts: tuple[str, ...]) -> Iterator[str]:
    there = [p for p in parts if getattr(experiment.document, p) is not None]
    if not there:
        yield f"{experiment.path}: has no [{'] and no ['.join(parts)}], nothing would be measured"


def _temperature(experiment: Experiment) -> Iterator[str]:
    asked, chamber = experiment.document.temperature, experiment.rig.chamber
    if asked is None:
        return
    place = f"{experiment.path}: temperature.set_point_c = {asked.set_point_c:g}"
    if chamber is None:
        yield f"{place}: {experiment.rig_path} has no [chamber], expected one with a set point"
    elif not chamber.has_set_point:
        yield f"{place}: [chamber] of {experiment.rig_path} is a thermometer, expected one with a set point"
    elif experiment.rig.is_simulated and not LOWEST_C <= asked.set_point_c <= HIGHEST_C:
        yield f"{place}: the simulated chamber goes from {LOWEST_C:g} to {HIGHEST_C:g} degC, expected within"


def _hammer(experiment: Experiment) -> Iterator[str]:
    hammer, specimen = experiment.document.hammer, experiment.specimen
    if hammer is None:
        return
    if isinstance(specimen, BeamDocument) and specimen.beam.boundary == "centre-driven":
        yield f"{experiment.path}: [hammer]: a beam driven in its centre is not struck, expected no [hammer]"
        return
    if isinstance(specimen, ShearPairDocument):
        yield (
            f"{experiment.path}: [hammer]: the specimen is a shear-pair, expected an experiment without it: "
            "the hammer test is of a bare plate or beam"
        )
        return
    plate = specimen.plate if isinstance(specimen, SpecimenDocument) else specimen.beam
    kind = experiment.the_specimen().kind
    for name in ("force", "response"):
        if getattr(experiment.rig.channels, name) is None:
            yield f"{experiment.rig_path}: channels.{name}: missing, the hammer test needs it"
    off = False
    for key, at, side in (
        ("hit_x_mm", hammer.hit_x_mm, plate.length_mm),
        ("hit_y_mm", hammer.hit_y_mm, plate.width_mm),
        ("response_x_mm", hammer.response_x_mm, plate.length_mm),
        ("response_y_mm", hammer.response_y_mm, plate.width_mm),
    ):
        if at > side:
            off = True
            yield f"{experiment.path}: hammer.{key} = {at:g} is off the {kind}, expected 0 to {side:g}"
    whole = hammer.whole_length_mm
    if whole is not None and whole < plate.length_mm:
        yield (
            f"{experiment.path}: hammer.whole_length_mm = {whole:g} is less than stands out of the clamp, "
            f"expected {plate.length_mm:g} or more"
        )
    if not off:
        yield from bare_test_objections(experiment, hammer)


def _sweep(experiment: Experiment, forecast: Forecast) -> Iterator[str]:
    table, path = experiment.document.sweep, experiment.path
    if table is None:
        return
    if table.plan == "adaptive" and not isinstance(experiment.the_specimen(), PlateSpecimen):
        kind = experiment.the_specimen().kind
        yield f'{path}: sweep.plan = "adaptive": the specimen is a {kind}, expected a plate, or segments'
        return
    if table.plan == "adaptive" and experiment.the_specimen().core is None:
        yield f'{path}: sweep.plan = "adaptive": the specimen has no [core] to find a law of'
        return
    core = experiment.the_specimen().core
    if table.plan == "adaptive" and core is not None and not core.law.names:
        yield f'{path}: sweep.plan = "adaptive": core law {core.law.kind} has no numbers to be found'
        return
    ranges = distinct(ranges_of(experiment.rig.vibrometer))
    highest = experiment.rig.front_end.sample_rate_hz / _SAMPLES_A_CYCLE
    frequencies: list[tuple[str, float]] = []
    for number, segment in enumerate(sections_of(forecast, table), start=1):
        place = f"sweep.segments, number {number}" if table.segments else "sweep.adaptive"
        try:
            planned = planned_segment(forecast, segment, number, table, ranges)
            frequencies.append((place, max(planned.frequencies_hz)))
        except BadInput as error:
            yield f"{path}: {place}: {error}"
    if table.sentinel is not None and table.sentinel.frequency_hz is not None:
        frequencies.append(("sweep.sentinel", table.sentinel.frequency_hz))
    if table.calibration is not None:
        frequencies.append(("sweep.calibration", max(table.calibration.frequencies_hz)))
    for place, f in frequencies:
        if f > highest:
            yield (
                f"{path}: {place}: {f:g} Hz at {experiment.rig.front_end.sample_rate_hz:g} samples/s, "
                f"expected at most {highest:g} Hz"
            )
    limits = sweep_settings(experiment.document, experiment.rig).limits
    level = table.level_g * PUBLISHED_G_M_S2
    if level > limits.base_m_s2:
        limit = in_both(limits.base_m_s2)
        yield f"{path}: sweep.level_g = {table.level_g:g} is {in_both(level)}, limit {limit}"
