"""How a law is found; for one plate directly, all in one posterior, or as the paper does, on real modes."""

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass, replace
from time import perf_counter
from typing import ClassVar, Literal

import numpy as np
from numpy.typing import NDArray
from threadpoolctl import threadpool_limits

from fitting.arrays import Array, Mask
from fitting.data.aside import LOST, Reasons, reasons
from fitting.data.noise import Noise, noise_of
from fitting.data.strays import strays
from fitting.depth.quantities import Quantities
from fitting.depth.sweep_task import SweepTask
from fitting.diagnosis.checks.overstated_noise import with_own_noise
from fitting.diagnosis.checks.prediction import held_out
from fitting.diagnosis.checks.stretches import parts_held_out, words_of_stretches
from fitting.diagnosis.inference.begin import Begun, begin
from fitting.diagnosis.inference.freer_law import loosened
from fitting.diagnosis.joint import fit_of
from fitting.digits import written_out
from fitting.discrepancy.theory_error import TheoryError
from fitting.errors import OutsideModel
from fitting.identification import paper
from fitting.identification.bare_plate import BarePlateFit, fit_bare_plate, with_bare_plate
from fitting.identification.fit import Fit
from fitting.identification.result import LOST_PERCENT, Identification, differences_percent
from fitting.identification.validation import Validation, rms, validate
from fitting.laws import CoreLaw
from fitting.progress import Report
from fitting.reduced.reduced_plate import ReducedPlate
from fitting.specimen import PlateSpecimen
from fitting.structures import AnySpecimen
from fitting.sweep import Sweep
from instrument.finding.files_at_work import SetAside
from instrument.models.files import File
from instrument.models.set_up import Hammer, SetUp, set_up
from instrument.models.specimen_models import Models
from instrument.progress import Progress
from instrument.remarks.as_given import (
    remarks_on_bend,
    remarks_on_damping,
    remarks_on_law,
    remarks_on_noise,
    remarks_on_patches,
    remarks_on_strays,
    remarks_on_tolerances,
)
from instrument.remarks.clamp_remarks import remarks_on_clamps
from instrument.remarks.theory import stiffer_than_stated, theory_over

Method = Literal["direct", "paper"]

_MOST_WIDENINGS = 2
"""Of the reduced model's domain, whole decades each: a law that runs further off is no core's."""


@dataclass(frozen=True)
class Joint:
    """The joint fit itself and the plate it was made with."""

    begun: Begun
    reduced: ReducedPlate | None
    """As stated; None where several were fitted together."""

    @property
    def task(self) -> SweepTask:
        """For a deeper look at its uncertainty."""
        return SweepTask.begun_with(self.begun)

    def quantities(self, frequency_hz: Array) -> Quantities:
        """What intervals may be asked for. Shape (frequencies,)."""
        return Quantities.of(self.task, frequency_hz)


class IdentificationMethod(ABC):
    """One way from files to a law: fitted, and held against data that were left out."""

    given: Sweep
    """All points, file after file."""
    questioned: tuple[Sweep, AnySpecimen]
    """The first readings with what they are of, which are asked about where a fit leaves much."""
    why_aside: Reasons
    """Of every point given why it took no part, once it is fitted. Shape (points,)."""
    sweep: Sweep
    """The points in use, once it is fitted."""
    noise: Noise
    """What they are worth, once it is fitted."""
    aside: Sequence[SetAside] = ()
    """Stretches of files that take no part, once it is fitted."""
    bare: BarePlateFit | None = None
    """What the hammer test of the bare plate gives by itself."""
    joint: Joint | None = None
    """What a second look at the same fit needs, once it is fitted; None where the method has none."""
    setup_seconds = 0.0
    """Models made or loaded."""
    seconds = 0.0
    """Seconds that the fit took."""

    @abstractmethod
    def fitted(self) -> Fit:
        """Make the models or load them, and find the law."""

    def theory(self, fit: Fit) -> TheoryError | None:
        """What the layer-wise theory gets wrong under the law found. Raises `OutsideModel` where too much."""
        return None

    @abstractmethod
    def remarks(self, fit: Fit) -> tuple[str, ...]:
        """On what is stated, and on the law that was found."""

    @abstractmethod
    def validated(self, fit: Fit, report: Report) -> Validation:
        """Each part predicted from the others."""

    @property
    def doubts(self) -> tuple[str, ...]:
        """What is said before all other warnings, after the fit."""
        return ()

    def remarks_on_rest(self, result: Identification) -> tuple[str, ...]:
        """On what the fit leaves of the readings, after all other warnings."""
        return ()


class PlateMethod(IdentificationMethod):
    """One plate read at one spot. Raises `OutsideModel` for a bare one.

    The reduced model is certified where the fit ends; beyond that it is widened and the fit repeated.
    """

    name: ClassVar[Method]
    models: Models | None = None
    """The reduced models, once they are made."""

    def __init__(self, file: File, stated: PlateSpecimen, hammer: Hammer | None, progress: Progress) -> None:
        if stated.core is None:
            raise OutsideModel("a bare plate has no core to identify, expected [core] and [constraining]")
        self.given, self.why_aside = file.sweep, reasons(strays(file.sweep) > 0, LOST)
        self.sweep = file.sweep.take(self.why_aside == "")
        self.stated, self.start, self.like = stated, stated.core.law, file.like
        self.noise, self.hammer, self.progress = noise_of(self.sweep), hammer, progress
        self.plate = stated
        if hammer is not None:
            self.bare = fit_bare_plate(stated, *hammer)
            self.plate = self.with_bare_plate(self.bare)
        self.questioned = self.sweep, self.plate
        self._provisional: tuple[str, ...] = ()

    def with_bare_plate(self, bare: BarePlateFit) -> PlateSpecimen:
        """The plate as it is fitted."""
        return self.stated

    def fitted(self) -> Fit:
        """The specimen's own law is where it begins."""
        f = self.sweep.frequency_hz
        for widened in range(_MOST_WIDENINGS + 1):
            began = perf_counter()
            models = self.set_up()
            ready = perf_counter()
            with threadpool_limits(1, "blas"), self.progress(f"fitting ({self.name})") as report:
                fit = self.fit(self.start.to_fit(f), report)
            self.setup_seconds += ready - began
            self.seconds += perf_counter() - ready
            if not models.uncertified(fit.law, f):
                break
            if widened == _MOST_WIDENINGS:
                self._provisional = (
                    "the law found lies where the reduced model is not certified: take it as provisional",
                )
            self.widen(fit.law)
        return fit

    @abstractmethod
    def set_up(self) -> Models:
        """Make the models, or load them."""

    def widen(self, law: CoreLaw) -> None:
        """Certify the models of the next `set_up` for a law that ended outside."""
        assert self.models is not None
        wider = self.models.domain.widened(law, self.sweep.frequency_hz)
        self.models = replace(self.models, domain=wider)

    @abstractmethod
    def fit(self, start: CoreLaw, report: Report) -> Fit:
        """The law, from `start` on."""

    def remarks(self, fit: Fit) -> tuple[str, ...]:
        """On readings and law as given, on what is stated, on the fit."""
        f = self.sweep.frequency_hz
        return (
            *remarks_on_strays(self.given),
            *remarks_on_law(self.start, f),
            *remarks_on_noise(self.sweep),
            *self.remarks_on_stated(),
            *self._provisional,
            *self.remarks_on_bend(fit),
            *words_of_stretches(self.sweep, self.parts()),
            *filter(None, [stiffer_than_stated(self.stated, fit.law, f)]),
        )

    @abstractmethod
    def remarks_on_stated(self) -> tuple[str, ...]:
        """On what is stated."""

    def remarks_on_bend(self, fit: Fit) -> tuple[str, ...]:
        """On how far the law that was found bends."""
        return ()

    @abstractmethod
    def parts(self) -> NDArray[np.intp]:
        """What is held out together, after the fit. Shape (points,)."""


class DirectMethod(PlateMethod):
    """Law, stated numbers within their tolerances, model error and hammer test in one posterior."""

    name = "direct"

    def remarks_on_stated(self) -> tuple[str, ...]:
        """On tolerances, patches, clamps and ratios."""
        plate = self.plate
        return (
            *remarks_on_tolerances(plate),
            *remarks_on_patches(plate),
            *remarks_on_clamps(plate),
            *remarks_on_damping(plate, tested=self.hammer is not None),
        )

    def set_up(self) -> Models:
        """The plate as stated and what moves it."""
        self._ready: SetUp = set_up(
            self.sweep,
            self.plate,
            self.hammer,
            self.progress,
            with_effects=False,
            models=self.models,
            like=self.like,
        )
        self.models = self._ready.models
        return self.models

    def fit(self, start: CoreLaw, report: Report) -> Fit:
        """In one posterior."""
        ready, noise = self._ready, self.noise
        begun = begin(ready.problem, ready.reduced, noise, ready.bare, start)
        self.joint = Joint(loosened(with_own_noise(begun, noise)), ready.reduced)
        return fit_of(self._begun)

    @property
    def _begun(self) -> Begun:
        assert self.joint is not None
        return self.joint.begun

    def remarks_on_bend(self, fit: Fit) -> tuple[str, ...]:
        """Where it bends further than materials usually do."""
        return remarks_on_bend(fit.law, self._begun.problem.freedom)

    def theory(self, fit: Fit) -> TheoryError:
        """Over the sweep. Where the fit is lost besides, the error's line says so."""
        try:
            return theory_over(self.plate, fit.law, self.sweep.frequency_hz)
        except OutsideModel as error:
            off = rms(differences_percent(self.sweep, fit.velocity_m_s))
            if off < LOST_PERCENT:
                raise
            raise OutsideModel(
                f"{error}; nor does the fit follow the data (rms {written_out(off, 3)} %): check units, "
                "level and pickup"
            ) from None

    def parts(self) -> NDArray[np.intp]:
        """Points, segments, or stretches of a segment. Shape (points,)."""
        return parts_held_out(self._begun.problem, self._begun.none.law)

    def validated(self, fit: Fit, report: Report) -> Validation:
        """From the posterior itself."""
        return held_out(self._begun.problem, self._begun.evidence, self._begun.none, self.parts())


class PaperMethod(PlateMethod):
    """The paper's Eq. (20) to (25) on real modes; the hammer test has moved the plate before."""

    name = "paper"

    def with_bare_plate(self, bare: BarePlateFit) -> PlateSpecimen:
        """Moved to where the test has it."""
        return with_bare_plate(self.stated, bare)

    def remarks_on_stated(self) -> tuple[str, ...]:
        """On tolerances, which have no part in it."""
        if self.plate.exact:
            return ()
        return ("the paper's method takes what is stated for exact: tolerances are not in its band",)

    def set_up(self) -> Models:
        """Real modes at the sweep's frequencies."""
        if self.models is None:
            self.models = Models.of(self.plate, self.sweep.frequency_hz, self.progress)
        models = self.models
        self._paper = paper.PaperProblem.of(self.sweep, models.real_modes, models.specimen.reads)
        return models

    def fit(self, start: CoreLaw, report: Report) -> Fit:
        """Step by step, as the paper has it."""
        return paper.fit_paper(self._paper, start, lambda step: report(step / paper.MOST_STEPS))

    def parts(self) -> NDArray[np.intp]:
        """Segments alone. Shape (points,)."""
        return self.sweep.segment

    def validated(self, fit: Fit, report: Report) -> Validation:
        """By fits to the other segments."""
        sweep, noise = self.sweep, self.noise

        def differences(points: Mask) -> NDArray[np.float64]:
            learnt = paper.refit(self._paper.take(points), fit.law)
            return differences_percent(sweep, self._paper.velocity([learnt])[0])

        size = np.abs(sweep.response_m_s)
        return validate(
            segment=self.parts(),
            points_needed=len(fit.law.names),
            differences_percent=differences,
            progress=report,
            noise_percent=100 * noise.std_m_s / size if noise.is_known else np.full(len(sweep), np.nan),
        )
