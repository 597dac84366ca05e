"""The direct method for any structure, one file or several: their fits under one law, in one posterior."""

from collections.abc import Sequence
from time import perf_counter

import numpy as np
from numpy.typing import NDArray
from threadpoolctl import threadpool_limits

from fitting.data.aside import Reasons
from fitting.data.noise import Noise
from fitting.diagnosis.checks.overstated_noise import with_own_noise
from fitting.diagnosis.checks.prediction import held_out
from fitting.diagnosis.checks.stretches import parts_held_out, words_of_stretches
from fitting.diagnosis.inference.begin import Begun, ended
from fitting.diagnosis.inference.freer_law import loosened
from fitting.diagnosis.joint import fit_of
from fitting.diagnosis.several.joining import joined
from fitting.identification.bare_plate import fit_bare_plate
from fitting.identification.fit import Fit
from fitting.identification.result import Identification
from fitting.identification.validation import Validation, rms
from fitting.progress import Report
from fitting.specimen import PlateSpecimen
from instrument.finding.exchanged import exchanged, leaves_much
from instrument.finding.files_at_work import FilesAtWork
from instrument.finding.methods import IdentificationMethod, Joint
from instrument.models.files import File
from instrument.models.set_up import Hammer
from instrument.processes.other_processes import executor
from instrument.progress import Progress
from instrument.remarks.as_given import remarks_on_bend
from instrument.remarks.file_remarks import remarks_on_files, remarks_on_rest, remarks_on_scale
from instrument.remarks.theory import check_each_theory

_ROUNDS, _SETTLED = 6, 0.1
"""Fits in which a misfit is found: at most so many, the last of them changing it by less than that share.

The first fit takes noise alone for what readings are worth, which bends a law to anything: what it leaves is
not what a law leaves.
"""


class FilesMethod(IdentificationMethod):
    """Each file with its own specimen and channels, one law for all. Raises `OutsideModel` without cores."""

    def __init__(self, files: Sequence[File], hammer: Hammer | None, progress: Progress) -> None:
        self.files, self.progress = files, progress
        self.given = joined([f.sweep for f in files])
        plate = files[0].specimen
        self.questioned = files[0].sweep, plate
        if hammer is not None and isinstance(plate, PlateSpecimen):
            self.bare = fit_bare_plate(plate, *hammer)
        self._work = FilesAtWork(files, progress, with_effects=False, hammer=hammer)
        self._misfit: tuple[str, ...] = ()
        self._theory: tuple[str, ...] = ()

    def fitted(self) -> Fit:
        """By noise, or where that does not explain what one law leaves, by what it leaves."""
        began, work = perf_counter(), self._work
        with threadpool_limits(1, "blas"), self.progress("fitting"):
            work.problem()
            ready = perf_counter()
            work.set_disturbances_aside()
            begun, self.noise = work.fit(to_its_end=False)
            scatters = work.with_misfit(begun)
            if scatters:
                begun, self.noise = self._by_misfit()
            else:
                # What a misfit says of a law's form is a guess.
                begun = loosened(with_own_noise(ended(begun), self.noise))
            other = exchanged(self.files) if scatters or leaves_much(begun) else None
            self._misfit = (work.about_misfit(),) if scatters else ()
            if other is not None:
                self._misfit = (f"{other.words}. The law means nothing",)
            fit = fit_of(begun)
        self.joint, self.sweep = Joint(begun, None), begun.problem.sweep
        self.why_aside: Reasons = np.concatenate(work.why_aside)
        self.aside = work.aside
        self.setup_seconds, self.seconds = ready - began, perf_counter() - ready
        return fit

    def _by_misfit(self) -> tuple[Begun, Noise]:
        """The fit by readings that are worth what it leaves of them."""
        work = self._work
        with executor() as workers:
            for _ in range(_ROUNDS):
                before = rms(np.array(work.misfit))
                work.with_misfit(work.fit(workers, to_its_end=False)[0])
                if abs(rms(np.array(work.misfit)) / before - 1) < _SETTLED:
                    break
            return work.fit(workers)

    def theory(self, fit: Fit) -> None:
        """Check it for each file's specimen. Raises `OutsideModel` where the theory does not hold for one."""
        specimens, bands_hz = [f.specimen for f in self.files], [f.sweep.frequency_hz for f in self.files]
        self._theory = check_each_theory(specimens, fit.law, bands_hz)

    def remarks(self, fit: Fit) -> tuple[str, ...]:
        """On the law that was found, on every file, on what takes no part."""
        return (
            *remarks_on_scale(self.files[0].specimen, fit.law, self.sweep.frequency_hz),
            *remarks_on_bend(fit.law, self._begun.problem.freedom),
            *remarks_on_files(self.files),
            *self._theory,
            *(one.words(self.files) for one in self.aside),
            *words_of_stretches(self.sweep, self._parts()),
        )

    def validated(self, fit: Fit, report: Report) -> Validation:
        """From the posterior itself."""
        begun = self._begun
        found = held_out(begun.problem, begun.evidence, begun.none, self._parts())
        return found.without_noise if self.noise.source == "misfit" else found

    @property
    def doubts(self) -> tuple[str, ...]:
        """Where no one law follows the files within their noise."""
        return self._misfit

    def remarks_on_rest(self, result: Identification) -> tuple[str, ...]:
        """Where far more is left than noise, though what may be off explains it."""
        return () if self._misfit else remarks_on_rest(result.rms_percent, result.validation.held_out)

    @property
    def _begun(self) -> Begun:
        assert self.joint is not None
        return self.joint.begun

    def _parts(self) -> NDArray[np.intp]:
        return parts_held_out(self._begun.problem, self._begun.none.law)
