"""The two methods of identification: directly, all in one posterior; and the paper's, on real modes."""

from abc import ABC, abstractmethod
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array, Mask
from fitting.data.noise import Noise
from fitting.depth.quantities import Quantities
from fitting.depth.sweep_task import SweepTask
from fitting.diagnosis.checks.overstated_noise import with_own_noise
from fitting.diagnosis.checks.prediction import held_out
from fitting.diagnosis.checks.stretches import parts_held_out
from fitting.diagnosis.inference.begin import Begun, begin
from fitting.diagnosis.inference.freer_law import loosened
from fitting.diagnosis.joint import fit_of
from fitting.digits import written_out
from fitting.discrepancy.theory_error import TheoryError
from fitting.errors import OutsideModel
from fitting.identification import paper
from fitting.identification.bare_plate import BarePlateFit, fit_bare_plate, with_bare_plate
from fitting.identification.fit import Fit
from fitting.identification.result import LOST_PERCENT, differences_percent
from fitting.identification.validation import Validation, rms, validate
from fitting.laws import CoreLaw
from fitting.progress import Report
from fitting.reduced.reduced_plate import ReducedPlate
from fitting.specimen import Specimen
from fitting.sweep import Sweep
from instrument.models.clamp_remarks import remarks_on_clamps
from instrument.models.remarks import (
    remarks_on_bend,
    remarks_on_damping,
    remarks_on_patches,
    remarks_on_tolerances,
)
from instrument.models.set_up import Hammer, SetUp, set_up
from instrument.models.specimen_models import Models
from instrument.models.theory import theory_over
from instrument.progress import Progress


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


@dataclass(frozen=True)
class IdentificationProblem:
    """What is to be identified."""

    sweep: Sweep
    specimen: Specimen
    noise: Noise
    hammer: Hammer | None = None
    """The hammer test of the bare plate."""
    like: Specimen | None = None
    """As `set_up` takes it."""


class IdentificationMethod(ABC):
    """One way from a sweep to a law: set up, fitted, and held against data that were left out."""

    models: Models | None = None
    """The reduced models, once they are made."""
    joint: Joint | None = None
    """What a second look at the same fit needs, once it is fitted; None where the method has none."""

    def __init__(self, problem: IdentificationProblem, progress: Progress) -> None:
        self.problem, self.progress = problem, progress
        self.bare: BarePlateFit | None = None
        if problem.hammer is not None:
            self.bare = fit_bare_plate(problem.specimen, *problem.hammer)

    @abstractmethod
    def remarks(self) -> tuple[str, ...]:
        """On what is stated."""

    @abstractmethod
    def set_up(self) -> Models:
        """Make the models, or load them."""

    def widen(self, law: CoreLaw) -> None:
        """Certify the models of the next `set_up` for a law that ended outside."""
        assert self.models is not None
        wider = self.models.domain.widened(law, self.problem.sweep.frequency_hz)
        self.models = replace(self.models, domain=wider)

    @abstractmethod
    def fit(self, start: CoreLaw, report: Report) -> Fit:
        """The law, from `start` on."""

    def remarks_on(self, fit: Fit) -> tuple[str, ...]:
        """On the law that was found."""
        return ()

    def theory(self, fit: Fit) -> TheoryError | None:
        """What the layer-wise theory gets wrong under the law found. Raises `OutsideModel` where too much."""
        return None

    @abstractmethod
    def parts(self) -> NDArray[np.intp]:
        """What is held out together, after the fit. Shape (points,)."""

    @abstractmethod
    def validated(self, fit: Fit, report: Report) -> Validation:
        """Each part predicted from the others."""


class DirectMethod(IdentificationMethod):
    """Law, stated numbers within their tolerances, model error and hammer test in one posterior."""

    def remarks(self) -> tuple[str, ...]:
        """On tolerances, patches, clamps and ratios."""
        plate = self.problem.specimen
        return (
            *remarks_on_tolerances(plate),
            *remarks_on_patches(plate),
            *remarks_on_clamps(plate),
            *remarks_on_damping(plate, tested=self.problem.hammer is not None),
        )

    def set_up(self) -> Models:
        """The plate as stated and what moves it."""
        t = self.problem
        self._ready: SetUp = set_up(
            t.sweep, t.specimen, t.hammer, self.progress, with_effects=False, models=self.models, like=t.like
        )
        self.models = self._ready.models
        return self.models

    def fit(self, start: CoreLaw, report: Report) -> Fit:
        """In one posterior."""
        ready, noise = self._ready, self.problem.noise
        begun = begin(ready.problem, ready.reduced, noise, ready.bare, start)
        self.joint = Joint(loosened(with_own_noise(begun, noise)), ready.reduced)
        return fit_of(self._begun)

    @property
    def _begun(self) -> Begun:
        assert self.joint is not None
        return self.joint.begun

    def remarks_on(self, fit: Fit) -> tuple[str, ...]:
        """On how far it bends."""
        return remarks_on_bend(fit.law, self._begun.problem.freedom)

    def theory(self, fit: Fit) -> TheoryError:
        """Over the sweep. Where the fit is lost besides, the error's line says so."""
        sweep = self.problem.sweep
        try:
            return theory_over(self.problem.specimen, fit.law, sweep.frequency_hz)
        except OutsideModel as error:
            off = rms(differences_percent(sweep, fit.velocity_m_s))
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


class PaperMethod(IdentificationMethod):
    """The paper's Eq. (20) to (25) on real modes; the hammer test has moved the plate before."""

    def __init__(self, problem: IdentificationProblem, progress: Progress) -> None:
        super().__init__(problem, progress)
        if self.bare is not None:
            self.problem = replace(problem, specimen=with_bare_plate(problem.specimen, self.bare))

    def remarks(self) -> tuple[str, ...]:
        """On tolerances, which have no part in it."""
        if self.problem.specimen.exact:
            return ()
        return ("the paper's method takes what is stated for exact: tolerances are not in its band",)

    def set_up(self) -> Models:
        """Real modes at the sweep's frequencies."""
        t = self.problem
        if self.models is None:
            self.models = Models.of(t.specimen, t.sweep.frequency_hz, self.progress)
        models = self.models
        self._paper = paper.PaperProblem.of(t.sweep, models.real_modes, models.specimen.reads)
        return models

    def fit(self, start: CoreLaw, report: Report) -> Fit:
        """Step by step, as the paper has it."""
        return paper.fit_paper(self._paper, start, lambda step: report(step / paper.MOST_STEPS))

    def parts(self) -> NDArray[np.intp]:
        """Segments alone. Shape (points,)."""
        return self.problem.sweep.segment

    def validated(self, fit: Fit, report: Report) -> Validation:
        """By fits to the other segments."""
        sweep, noise = self.problem.sweep, self.problem.noise

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
