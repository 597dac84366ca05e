"""What `identify` and `diagnose` share before they fit: the models of a specimen for one sweep."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from fitting.arrays import Array
from fitting.diagnosis.inference.evidence import BareModes
from fitting.diagnosis.problem.base import DiagnosisProblem
from fitting.dynamics.bare_modes import CarriedSensor
from fitting.dynamics.unstated_damping import with_unstated_damping
from fitting.effects import all_spans, span_modules
from fitting.errors import OutsideModel
from fitting.identification.bare_plate import CLAMP, MatchedModes, match_modes
from fitting.plate.mesh import Mesh
from fitting.plate.plate_numbers import tolerance
from fitting.reduced.rational import RationalSweep, RationalSweeps, rational_sweep, rational_sweeps
from fitting.reduced.reduced_plate import ReducedPlate
from fitting.specimen import PlateSpecimen
from fitting.sweep import Sweep
from fitting.widened.enriched_plate import EnrichedReducedPlate
from fitting.widened.enriching import enriched
from fitting.widened.full_plate import FullPlate
from instrument.models.cache import cached
from instrument.models.specimen_models import Models
from instrument.progress import Progress, quiet

Hammer = tuple[Array, Array] | tuple[Array, Array, CarriedSensor | None]
"""The bare plate's frequencies in Hz and ratios, and the sensor that sat on it."""

_USUAL_RATIO = 2e-3
"""Of critical damping, on which the models are made; a specimen's own ratios are factors on it."""
_USUAL_MODES = 12
"""With viscous damping, at least, so that specimens with fewer ratios share a model."""
_LIKE = 0.15
"""How far a stated value may be off that of another specimen whose models are used."""


@dataclass(frozen=True)
class SetUp:
    """Models for one sweep."""

    problem: DiagnosisProblem
    reduced: ReducedPlate
    models: Models
    """Of the specimen with usual damping ratios: those are put in afterwards."""
    bare: BareModes | None
    remade: Callable[[Sweep], DiagnosisProblem]
    """The problem of some of its points."""

    @property
    def specimen(self) -> PlateSpecimen:
        """As stated, the damping ratios as the hammer test has them."""
        assert isinstance(self.problem.specimen, PlateSpecimen)
        return self.problem.specimen


def set_up(
    sweep: Sweep,
    specimen: PlateSpecimen,
    hammer: Hammer | None = None,
    progress: Progress = quiet,
    *,
    with_effects: bool = True,
    models: Models | None = None,
    like: PlateSpecimen | None = None,
) -> SetUp:
    """Models for a sweep, made or loaded. `models` where they are to hold over a domain of their own.

    `like` is a specimen that differs in stated values by a few percent at most: its models serve this one.
    Raises `TooFewPoints` where the hammer test is not of this plate.
    """
    specimen, bare = with_hammer(specimen, hammer)
    if like is not None:
        check_like(specimen, like)
    # Masses are put on by the fit, which needs the motions that they stir.
    with_effects = with_effects or bool(specimen.masses)
    models = models or Models.of(_usual(like or specimen, specimen), sweep.frequency_hz, progress)
    reduced, plate = _damped(models, specimen, with_effects=with_effects)

    def rational(omega: Array) -> RationalSweep:
        def build() -> RationalSweep:
            with progress("preparing the frequency grid") as report:
                return rational_sweep(reduced, omega, report)

        depends_on = [models.without_law, models.domain, list(specimen.modal_ratios), omega]
        return cached("rational", depends_on, RationalSweep, build)

    def remade(some: Sweep) -> DiagnosisProblem:
        return DiagnosisProblem.of(some, specimen, plate, lambda omega: rational_sweep(reduced, omega), like)

    problem = DiagnosisProblem.of(sweep, specimen, plate, rational, like)
    return SetUp(problem, reduced, models, bare, remade)


def with_hammer(specimen: PlateSpecimen, hammer: Hammer | None) -> tuple[PlateSpecimen, BareModes | None]:
    """The specimen with the ratios of its bare plate's test, and what else that says.

    Those that neither file nor test have are in it with a wide tolerance.

    Raises `TooFewPoints` where the test is not of this plate.
    """
    if hammer is None:
        return with_unstated_damping(specimen), None
    modes = match_modes(specimen, *hammer)
    tested = with_unstated_damping(replace(specimen, modal_ratios=modes.ratios), specimen)
    return tested, bare_of(modes, tested)


def set_up_spots(
    sweeps: Sequence[Sweep],
    specimens: Sequence[PlateSpecimen],
    progress: Progress = quiet,
    *,
    with_effects: bool = True,
) -> list[tuple[DiagnosisProblem, ReducedPlate]]:
    """Models for several sweeps of one plate, driven or read at several points: one basis for all of them.

    The specimens differ in these points alone.
    """
    first = specimens[0]
    with_effects = with_effects or bool(first.masses)
    places = [s.force_m for s in specimens if s.force_m is not None]
    places += [s.pickup_m for s in specimens if s.pickup_m is not None]
    spots = tuple(dict.fromkeys(place for place in places if place != first.force_m))
    usual = _usual(first, first)
    shared = replace(usual, pickup_m=spots[0], further_pickups_m=(*spots[1:], *usual.further_pickups_m))
    models = Models.of(shared, np.concatenate([s.frequency_hz for s in sweeps]), progress)
    reduced, plate = _damped(models, first, with_effects=with_effects)
    known: dict[bytes, RationalSweeps] = {}

    def side(place: tuple[float, float] | None) -> int:
        return 0 if place in (None, first.force_m) else 1 + spots.index(place)

    def rational(omega: Array) -> RationalSweeps:
        def build() -> RationalSweeps:
            with progress("preparing the frequency grid") as report:
                return rational_sweeps(reduced, omega, report)

        key = omega.tobytes()
        if key not in known:
            depends_on = [models.without_law, models.domain, list(first.modal_ratios), omega]
            known[key] = cached("rationals", depends_on, RationalSweeps, build)
        return known[key]

    found = []
    for sweep, specimen in zip(sweeps, specimens, strict=True):
        between = side(specimen.force_m), side(specimen.pickup_m)
        assert specimen.pickup_m is not None
        problem = DiagnosisProblem.of(
            sweep,
            specimen,
            plate.at(specimen.force_m, specimen.pickup_m),
            partial(_between, rational, between),
        )
        found.append((problem, reduced.between(*between)))
    return found


def _between(
    rational: Callable[[Array], RationalSweeps], sides: tuple[int, int], omega: Array
) -> RationalSweep:
    return rational(omega).of(*sides)


def _usual(plate: PlateSpecimen, specimen: PlateSpecimen) -> PlateSpecimen:
    """A plate with usual damping ratios: as many models are made of, whatever the specimen's are.

    What a force does where masses sit on the specimen is among its motions: they are put on afterwards.
    """
    count = max(_USUAL_MODES, len(specimen.modal_ratios))
    places = tuple((m.x_m, m.y_m) for m in specimen.masses)
    return replace(plate, modal_ratios=(_USUAL_RATIO,) * count, masses=(), further_pickups_m=places)


def _damped(
    models: Models, specimen: PlateSpecimen, *, with_effects: bool
) -> tuple[ReducedPlate, EnrichedReducedPlate]:
    """The reduced plates of some models, with a specimen's own damping ratios."""
    factor = np.zeros(len(models.specimen.modal_ratios))
    factor[: len(specimen.modal_ratios)] = np.array(specimen.modal_ratios) / _USUAL_RATIO
    reduced = models.reduced
    # Only modes even in y are in the reduced plate.
    reduced = replace(reduced, d=reduced.d * factor[reduced.mode])
    if not with_effects:
        return reduced, _plain(reduced, models.specimen)
    plate = _spanned(models)
    return reduced, replace(plate, d=plate.d * factor)


def check_like(specimen: PlateSpecimen, like: PlateSpecimen) -> None:
    """Raise `OutsideModel` where one plate's model cannot serve the other."""
    for name, ours, theirs in _numbers(specimen, like):
        if abs(ours / theirs - 1) > _LIKE:
            raise OutsideModel(
                f"{name} is {100 * (ours / theirs - 1):+.1f} % off the model's, "
                f"expected within {100 * _LIKE:g} %"
            )
    if specimen.boundary != like.boundary:
        raise OutsideModel(f"boundary {specimen.boundary!r} is not the model's {like.boundary!r}")
    if _form(specimen) != _form(like):
        raise OutsideModel("patches, sides, glue or a face's own axes are not the model's, expected the same")
    if specimen.drive != like.drive:
        raise OutsideModel(f"driven by a {specimen.drive}, the model by a {like.drive}")


def _form(specimen: PlateSpecimen) -> tuple[object, ...]:
    """What stated numbers do not move."""
    faces = (f.rolled for f in (specimen.substrate, specimen.constraining) if f is not None)
    glue = specimen.core.glue if specimen.core is not None else ()
    return specimen.patches, specimen.both_sides, glue, *faces


def _numbers(specimen: PlateSpecimen, like: PlateSpecimen) -> list[tuple[str, float, float]]:
    found = [(n, getattr(specimen, f"{n}_m"), getattr(like, f"{n}_m")) for n in ("length", "width")]
    for layer in ("substrate", "constraining"):
        ours, theirs = getattr(specimen, layer), getattr(like, layer)
        if ours is not None and theirs is not None:
            names = {"thickness": "thickness_m", "Young's modulus": "young_pa", "density": "density_kg_m3"}
            found += [(f"{layer} {said}", getattr(ours, n), getattr(theirs, n)) for said, n in names.items()]
    if specimen.core is not None and like.core is not None:
        found.append(("core thickness", specimen.core.thickness_m, like.core.thickness_m))
    return found


def _plain(reduced: ReducedPlate, specimen: PlateSpecimen) -> EnrichedReducedPlate:
    """The reduced plate as one that carries no effects; a mode it does not have is not damped."""
    assert specimen.pickup_m is not None
    mesh = Mesh(specimen.length_m, specimen.width_m, *specimen.mesh)
    plain = EnrichedReducedPlate.plain(reduced, mesh, specimen.pickup_m)
    count = len(specimen.modal_ratios)
    U, d = np.zeros((len(reduced.load), count)), np.zeros(count)
    U[:, reduced.mode], d[reduced.mode] = reduced.U, reduced.d
    return replace(plain, U=U, d=d)


def _spanned(models: Models) -> EnrichedReducedPlate:
    reduced = models.reduced

    def build() -> EnrichedReducedPlate:
        full = FullPlate(models.plate, models.damping)
        with models.progress("spanning what effects change") as report:
            spans = all_spans(models.specimen)
            return enriched(full, models.plate.carried @ reduced.V, spans, report, models.reach_hz)

    depends_on = [models.without_law, models.domain, models.reach_hz]
    return cached("spanned", depends_on, EnrichedReducedPlate, build, [*span_modules(), enriched.__module__])


def bare_of(modes: MatchedModes, specimen: PlateSpecimen) -> BareModes:
    """A hammer test beside the bare plate's model, for the joint fit."""
    return BareModes(
        shift=modes.shift,
        softness=modes.softness,
        scatter=modes.scatter,
        lowering_per_density=modes.air,
        clamp=CLAMP,
        stiffness=modes.stiffness,
        inertia=modes.inertia,
        sensor=modes.sensor,
        by_line=modes.by_line,
        line_m=tolerance(specimen, "length"),
        substrate=specimen.substrate,
    )
