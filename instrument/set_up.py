"""What `identify` and `diagnose` share before they fit: the models of a specimen for one sweep."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from fitting.bare_modes import Sensor
from fitting.diagnosis.evidence import BareModes
from fitting.diagnosis.task import Task
from fitting.effects import SPANS
from fitting.effects.full_plate import FullPlate
from fitting.effects.spanned import SpannedPlate, span_plate
from fitting.identification.bare_plate import CLAMP, MatchedModes, match_modes
from fitting.plate import Mesh
from fitting.rational import RationalSweep, rational_sweep
from fitting.reduced import ReducedPlate
from fitting.specimen import Specimen
from fitting.sweep import Sweep
from fitting.tolerances import tolerance
from instrument.cache import cached
from instrument.models import Models
from instrument.progress import Progress, quiet

Array = NDArray[np.float64]
Hammer = tuple[Array, Array] | tuple[Array, Array, Sensor | None]
"""The bare plate's frequencies in Hz and ratios, and the sensor that sat on it."""

_USUAL_RATIO = 2e-3
_USUAL_MODES = 12


@dataclass(frozen=True)
class SetUp:
    """Models for one sweep."""

    task: Task
    reduced: ReducedPlate
    models: Models
    """Of the specimen with usual damping ratios: those are put in afterwards."""
    bare: BareModes | None

    @property
    def specimen(self) -> Specimen:
        """As stated, the damping ratios as the hammer test has them."""
        return self.task.specimen


def set_up(
    sweep: Sweep,
    specimen: Specimen,
    hammer: Hammer | None = None,
    progress: Progress = quiet,
    *,
    with_effects: bool = True,
    models: Models | None = None,
) -> SetUp:
    """Models for a sweep, made or loaded. `models` where they are to hold over a domain of their own.

    Raises `TooFewPoints` where the hammer test is not of this plate.
    """
    bare = None
    if hammer is not None:
        modes = match_modes(specimen, *hammer)
        specimen = replace(specimen, modal_ratios=modes.ratios)
        bare = _bare(modes, tolerance(specimen, "length"))
    usual = replace(specimen, modal_ratios=(_USUAL_RATIO,) * max(_USUAL_MODES, len(specimen.modal_ratios)))
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

    return SetUp(Task.of(sweep, specimen, plate, rational), reduced, models, bare)


def _plain(reduced: ReducedPlate, specimen: Specimen) -> SpannedPlate:
    """The reduced plate as one that carries no effects; a mode it does not have is not damped."""
    assert specimen.pickup_m is not None
    mesh = Mesh(specimen.length_m, specimen.width_m, *specimen.mesh)
    plain = SpannedPlate.plain(reduced, mesh, specimen.pickup_m)
    count = len(specimen.modal_ratios)
    U, d = np.zeros((len(reduced.load), count)), np.zeros(count)
    U[:, reduced.mode], d[reduced.mode] = reduced.U, reduced.d
    return replace(plain, U=U, d=d)


def _spanned(models: Models) -> SpannedPlate:
    reduced = models.reduced

    def build() -> SpannedPlate:
        full = FullPlate(models.plate, models.damping)
        with models.progress("spanning what effects change") as report:
            return span_plate(full, models.plate.even @ reduced.V, SPANS, report)

    spans = sorted({type(span).__module__ for span in SPANS})
    return cached("spanned", [models.without_law, models.domain], SpannedPlate, build, spans)


def _bare(modes: MatchedModes, line_m: float) -> BareModes:
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
        line_m=line_m,
    )
