"""Files on their way to one law: which points take part, and what readings are worth.

Stretches that a fixture's own resonance spoils are set aside. Where what is left of some files is far above
their noise, or a fixture resonates, that misfit becomes part of what the readings are worth.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from fitting.arrays import Mask
from fitting.data.aside import DISTURBED, INSENSITIVE, LOST, Reasons, reasons
from fitting.data.noise import Noise, noises_of
from fitting.data.strays import strays
from fitting.diagnosis.executor import ALONE, Executor
from fitting.diagnosis.inference.begin import Begun, begin
from fitting.diagnosis.inference.evidence import BareModes
from fitting.diagnosis.problem.base import DiagnosisProblem
from fitting.diagnosis.problem.glitch import Glitch, glitches
from fitting.diagnosis.problem.small_problem import DEAF, SmallProblem
from fitting.diagnosis.several.of_files import Place
from fitting.diagnosis.several.several_problem import SeveralProblem
from fitting.digits import two_digits
from fitting.errors import OutsideModel
from fitting.identification.doubt import BIASED, Doubt
from fitting.laws import CoreLaw
from fitting.reduced.reduced_plate import ReducedPlate
from fitting.specimen import PlateSpecimen
from fitting.structures import Beam, ShearPair
from fitting.sweep import Sweep
from instrument.models.files import File, name_of, numbers_of, plates_of
from instrument.models.set_up import Hammer
from instrument.progress import Progress

_NO_RIG = 0.1
"""Of a reading: a misfit beyond it is another specimen, unit or sign."""
_MISFIT = 3.0
"""Chi-square per degree of freedom from which a misfit is more than noise."""


@dataclass(frozen=True)
class SetAside:
    """A stretch of one file that takes no part."""

    file: int
    """From 1."""
    glitch: Glitch

    def words(self, files: Sequence[File]) -> str:
        """Where, in a sentence; a `Doubt` where what is left may be disturbed as well."""
        name = name_of(files, self.file)
        of = f"{name}: " if name else ""
        found = f"{of}{self.glitch.low_hz:.0f} to {self.glitch.high_hz:.0f} Hz is a local disturbance"
        largest = f"(up to {100 * self.glitch.largest:.2g} %), as of a fixture's resonance"
        if self.glitch.at_peak:
            largest += " or of pads that slip or soften, which move most there (another level would tell)"
        aside = f"{self.glitch.points} points set aside"
        if not self.glitch.at_end:
            return f"{found} {largest}: {aside}"
        return Doubt(
            f"{found} {largest} or of a sensor that is loose, up to where the curve ends, so that the rest "
            f"may have it too, unseen: {aside}; {BIASED}, see 'viscorig diagnose'"
        )


@dataclass
class FilesAtWork:
    """The files as far as they are understood."""

    files: Sequence[File]
    progress: Progress
    with_effects: bool
    hammer: Hammer | None = None
    """Of the bare plate, which is then that of every file."""
    bare: BareModes | None = None
    used: list[Mask] = field(default_factory=list)
    why_aside: list[Reasons] = field(default_factory=list)
    """Of every file why readings are not in use."""
    misfit: list[float] = field(default_factory=list)
    aside: list[SetAside] = field(default_factory=list)
    lawless: bool = False
    """Whether noise does not explain what one law leaves."""
    made: dict[int, tuple[bytes, SmallProblem]] = field(default_factory=dict)
    """Of every file that is of a small structure, for which of its points."""
    start: CoreLaw = field(init=False)
    """What fits begin with."""

    def __post_init__(self) -> None:
        self.used = [np.ones(len(f.sweep), bool) for f in self.files]
        self.why_aside = [reasons(~used, "") for used in self.used]
        for k, f in enumerate(self.files):
            self.leave_out(k, reasons(strays(f.sweep) > 0, LOST))
        self.misfit = [0.0] * len(self.files)
        self.start = _start_of(self.files)

    def leave_out(self, k: int, why: Reasons) -> None:
        """Of a file what has a reason; what was left out before keeps its own. Shape (points,)."""
        new = self.used[k] & (why != "")
        self.why_aside[k][new] = why[new]
        self.used[k] = self.used[k] & ~new

    def problem(self) -> tuple[SeveralProblem, Noise]:
        """Of the points in use."""
        sweeps = [file.sweep.take(used) for file, used in zip(self.files, self.used, strict=True)]
        plates, self.bare = plates_of(
            self.files, sweeps, self.hammer, self.progress, with_effects=self.with_effects
        )
        members: list[DiagnosisProblem] = []
        reduced: list[ReducedPlate | None] = []
        noises = []
        for k, (file, sweep, noise) in enumerate(zip(self.files, sweeps, noises_of(sweeps), strict=True)):
            if isinstance(file.specimen, PlateSpecimen):
                member, of_it = plates[k]
                members.append(member)
                reduced.append(of_it)
            else:
                small = replace(self._small(k, sweep, file.specimen), misfit=self.misfit[k])
                noise = small.noise(noise)
                members.append(small)
                reduced.append(None)
            noises.append(noise)
        known = all(n.is_known for n in noises)
        std = [
            n.std_m_s if known else np.abs(m.sweep.response_m_s) for n, m in zip(noises, members, strict=True)
        ]
        source = noises[0].source if known else "unknown"
        if known and any(self.misfit):
            source = "misfit"
        places = [Place(n, f.pickup) for n, f in zip(numbers_of(self.files), self.files, strict=True)]
        return SeveralProblem.of_members(members, reduced, places), Noise(np.concatenate(std), source)

    def _small(self, k: int, sweep: Sweep, specimen: Beam | ShearPair) -> SmallProblem:
        """Of the points in use; made anew where these are others."""
        used = self.used[k].tobytes()
        if k not in self.made or self.made[k][0] != used:
            self.made[k] = used, SmallProblem.of_small(sweep, specimen)
        return self.made[k][1]

    def set_disturbances_aside(self) -> None:
        """Leave out what no core explains of any shear pair's curves."""
        for k, (file, used) in enumerate(zip(self.files, self.used, strict=True)):
            if not isinstance(file.specimen, ShearPair):
                continue
            small = self._small(k, file.sweep.take(used), file.specimen)
            disturbed, stretches = glitches(small, self.start)
            self.aside += [SetAside(numbers_of(self.files)[k], g) for g in stretches]
            self._leave_out_of_used(k, disturbed, DISTURBED)

    def fit(self, executor: Executor = ALONE, *, to_its_end: bool = True) -> tuple[Begun, Noise]:
        """By what is in use. `to_its_end`: as far as is reported; else as far as a misfit is told from."""
        problem, noise = self.problem()
        begun = begin(problem, None, noise, self.bare, self.start, executor, to_its_end=to_its_end)
        return begun, noise

    def _leave_out_of_used(self, k: int, aside: Mask, why: str) -> None:
        """Of those in use. Shape (points in use,)."""
        out = np.zeros(len(self.used[k]), bool)
        out[np.flatnonzero(self.used[k])[aside]] = True
        self.leave_out(k, reasons(out, why))

    def with_misfit(self, begun: Begun) -> bool:
        """Take what the fit leaves as what readings are worth; False where noise explains it.

        So it is of every file where one law does not do, and of one in which a fixture resonates: what was
        set aside has tails, and a fit that follows them calls them law and channels.
        """
        self.lawless |= begun.evidence.scale_known and begun.none.chi2_per_dof > _MISFIT
        assert isinstance(begun.problem, SeveralProblem)
        v, law = begun.none.velocity_m_s, begun.none.law
        for k, (m, part) in enumerate(zip(begun.problem.members, begun.problem.starts_at, strict=True)):
            if not isinstance(m, SmallProblem) or not isinstance(m.specimen, ShearPair):
                continue
            stretches = [one for one in self.aside if one.file == numbers_of(self.files)[k]]
            if not self.lawless and not stretches:
                continue
            has_phase, read = m.sweep.has_phase, m.sweep.response_m_s
            off = (read if has_phase else np.abs(read)) / (v[part] if has_phase else np.abs(v[part])) - 1
            squares = np.sum(np.abs(off) ** 2) + sum(
                one.glitch.points * one.glitch.rms**2 for one in stretches
            )
            self.misfit[k] = np.sqrt(squares / (len(off) + sum(one.glitch.points for one in stretches)) / 2)
            hears = np.abs(m.feels(law, v[part])) > DEAF
            if hears.sum() > len(law.names) and not self._deaf_taken:
                self._leave_out_of_used(k, ~hears, INSENSITIVE)
        self._deaf_taken = True
        return any(self.misfit)

    def about_misfit(self) -> str:
        """What was taken for the error of readings, in a sentence."""
        sizes = ", ".join(two_digits(100 * m) for m in self.misfit)
        if max(self.misfit) > _NO_RIG:
            return (
                f"one law leaves {sizes} % of the readings, more than any rig is off: is every file with "
                "its own specimen, and are mass, units and signs as the files have them? If not, the law "
                "means nothing"
            )
        once = f"({sizes} %), once for every 0.12 in ln f, is taken for the error of"
        if not self.lawless:
            return (
                "where a fixture resonates readings are off beyond what is set aside too: the rms of that "
                f"and of what is left {once} the rest"
            )
        if len(self.files) == 1:
            return (
                f"the readings follow no law within their noise: their rms misfit {once} the readings, and "
                "for a gain and a phase; see 'viscorig diagnose'"
            )
        return (
            f"the files follow no one law within their noise: each file's rms misfit {once} its readings, "
            "for files whose cores differ by a few percent, and for a gain and a phase that all have in "
            "common; see 'viscorig diagnose'"
        )

    _deaf_taken: bool = False


def _start_of(files: Sequence[File]) -> CoreLaw:
    """The law of the first file's specimen. Raises `OutsideModel`."""
    laws = [f.specimen.core.law for f in files if f.specimen.core is not None]
    if len(laws) < len(files):
        raise OutsideModel("a bare specimen has no core to identify, expected a core in every one")
    if len({law.kind for law in laws}) > 1:
        raise OutsideModel("the specimens name different core laws, expected one: it is one material")
    return laws[0]
