"""What `identify` and `diagnose` share before they fit: the models of a specimen for one sweep."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from fitting.arrays import Array
from fitting.bare_modes import CarriedSensor
from fitting.diagnosis.evidence import BareModes
from fitting.diagnosis.problem import DiagnosisProblem
from fitting.effects import all_spans, span_modules
from fitting.effects.enriched_plate import EnrichedReducedPlate
from fitting.effects.enriching import enriched
from fitting.effects.full_plate import FullPlate
from fitting.errors import OutsideModel
from fitting.identification.bare_plate import CLAMP, MatchedModes, match_modes
from fitting.mesh import Mesh
from fitting.rational import RationalSweep, rational_sweep
from fitting.reduced import ReducedPlate
from fitting.specimen import Specimen
from fitting.sweep import Sweep
from fitting.tolerances import tolerance
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
    """The task of some of its points."""

    @property
    def specimen(self) -> Specimen:
        """As stated, the damping ratios as the hammer test has them."""
        assert isinstance(self.problem.specimen, Specimen)
        return self.problem.specimen


def set_up(
    sweep: Sweep,
    specimen: Specimen,
    hammer: Hammer | None = None,
    progress: Progress = quiet,
    *,
    with_effects: bool = True,
    models: Models | None = None,
    like: Specimen | None = None,
) -> SetUp:
    """Models for a sweep, made or loaded. `models` where they are to hold over a domain of their own.

    `like` is a specimen that differs in stated values by a few percent at most: its models serve this one.
    Raises `TooFewPoints` where the hammer test is not of this plate.
    """
    bare = None
    if hammer is not None:
        modes = match_modes(specimen, *hammer)
        specimen = replace(specimen, modal_ratios=modes.ratios)
        bare = bare_of(modes, specimen)
    if like is not None:
        check_like(specimen, like)
    count = max(_USUAL_MODES, len(specimen.modal_ratios))
    usual = replace(like or specimen, modal_ratios=(_USUAL_RATIO,) * count, masses=())
    # Masses are put on by the fit, which needs the motions that they stir.
    with_effects = with_effects or bool(specimen.masses)
    models = models or Models.of(usual, sweep.frequency_hz, progress)
    factor = np.zeros(len(usual.modal_ratios))
    factor[: len(specimen.modal_ratios)] = np.array(specimen.modal_ratios) / _USUAL_RATIO
    reduced = models.reduced
    # Only modes even in y are in the reduced plate.
    reduced = replace(reduced, d=reduced.d * factor[reduced.mode])
    if with_effects:
        plate = _spanned(models)
        plate = replace(plate, d=plate.d * factor)
    else:
        plate = _plain(reduced, usual)

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


def check_like(specimen: Specimen, like: Specimen) -> None:
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


def _form(specimen: Specimen) -> tuple[object, ...]:
    """What stated numbers do not move."""
    faces = (f.rolled for f in (specimen.substrate, specimen.constraining) if f is not None)
    glue = specimen.core.glue if specimen.core is not None else ()
    return specimen.patches, specimen.both_sides, glue, *faces


def _numbers(specimen: Specimen, like: Specimen) -> list[tuple[str, float, float]]:
    found = [(n, getattr(specimen, n), getattr(like, n)) for n in ("length_m", "width_m")]
    for layer in ("substrate", "constraining"):
        ours, theirs = getattr(specimen, layer), getattr(like, layer)
        if ours is not None and theirs is not None:
            names = ("thickness_m", "young_pa", "density_kg_m3")
            found += [(f"{layer} {n}", getattr(ours, n), getattr(theirs, n)) for n in names]
    if specimen.core is not None and like.core is not None:
        found.append(("core thickness_m", specimen.core.thickness_m, like.core.thickness_m))
    return found


def _plain(reduced: ReducedPlate, specimen: Specimen) -> EnrichedReducedPlate:
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
            return enriched(full, models.plate.carried @ reduced.V, all_spans(models.specimen), report)

    return cached("spanned", [models.without_law, models.domain], EnrichedReducedPlate, build, span_modules())


def bare_of(modes: MatchedModes, specimen: Specimen) -> BareModes:
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
