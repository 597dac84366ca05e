"""The next step of an adaptive sweep: a pure function of the points, the specimen and the choice before.

A first pass lies around the resonances of the stated law. From then on law, bend and stated numbers are
fitted to what there is, from where the last choice left them; the candidate that lowers the criterion of
`fitting.planning.choice` fastest comes next, or, for a stated share of the rig time, one that separates
causes. What is being measured while this is decided counts as taken. Candidates are laid out for one law
and kept until the law has moved far: a choice says what the next one's are, so that they can be made ahead.
"""

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from threadpoolctl import threadpool_limits

from fitting.arrays import Array
from fitting.data.noise import Noise
from fitting.diagnosis.inference.begin import begin
from fitting.diagnosis.inference.refitted import Refitted
from fitting.digits import two_digits
from fitting.errors import FittingError
from fitting.laws import CoreLaw
from fitting.planning.aims import Aims
from fitting.planning.causes import Causes
from fitting.planning.choice import NEAR_LIMIT, choose, limit_of
from fitting.planning.measured import Measured, fit_on_grid, noise_seen, on_grid
from fitting.planning.sensitivity import Sensitivity, sensitivity
from fitting.sweep import Sweep
from instrument.planning.grid import Grid, Ground, far
from instrument.session.points import sweep_of
from instrument.stream.derived import PointMeasured, StepsChosen
from instrument.stream.raw import ChoiceStarted

COARSE = (0.93, 1.0, 1.07)
"""Places of the first pass, in resonances of the stated law."""
LEAST_A_REGION = 5
"""Steps in every region before a sweep ends: fewer check no law."""
_MOVED = 0.1
"""Relative change of the modulus from which candidates are laid out anew."""
_SAID = 1.2
"""Times that errors are widened by a misfit, from which it is said."""


@dataclass(frozen=True)
class Goal:
    """When an adaptive sweep ends."""

    target: float
    """Relative standard error of G' and eta, anywhere in the band."""
    causes_share: float
    """Share of the rig time that goes to telling causes apart."""
    most_s: float
    """Most seconds of rig time."""


@dataclass(frozen=True)
class Layout:
    """What a grid is laid out by; a choice passes it on to the next."""

    law: tuple[float, ...]
    stated: tuple[float, ...]
    measured_hz: tuple[float, ...]


def choose_steps(
    started: ChoiceStarted,
    points: list[PointMeasured],
    before: StepsChosen | None,
    ground: Ground,
    goal: Goal,
) -> StepsChosen:
    """The steps that are to be measured next. The same for the same arguments, to the bit."""
    used = [p for p in points if p.purpose == "step" and p.step <= started.last_step]
    if not used or before is None:
        return _first_pass(started, ground)
    # One thread: sums in another order would differ in the last bit.
    with threadpool_limits(1):
        try:
            return _chosen(started, used, before, ground, goal)
        except (FittingError, ArithmeticError, np.linalg.LinAlgError) as error:
            why = f"no law can be fitted: {' '.join(str(error).split())}"
            return StepsChosen(started.number, started.last_step, (), (), "", True, why, None, None)


def _first_pass(started: ChoiceStarted, ground: Ground) -> StepsChosen:
    low, high = ground.band_hz
    around = [share * p.real for p in ground.centres_hz for share in COARSE]
    f = np.unique(np.round([low, *(x for x in around if low < x < high), high], 3))
    f = f[~np.isin(f, started.declined_hz)]
    why = f"first pass: {len(f)} steps around {len(ground.centres_hz)} resonances of the stated law"
    number, last = started.number, started.last_step
    regions = tuple(int(k) for k in ground.region(f))
    return StepsChosen(
        number=number,
        last_step=last,
        frequencies_hz=tuple(f.tolist()),
        segments=regions,
        teaches="coarse",
        ended=not len(f),
        why=why,
        worst_percent=None,
        limit_percent=None,
        grid_law=_logs(ground.law),
        grid_stated=(0.0,) * len(ground.problem(np.array(ground.band_hz)).nuisances.each),
        grid_hz=tuple(f.tolist()),
    )


def _chosen(
    started: ChoiceStarted,
    used: list[PointMeasured],
    before: StepsChosen,
    ground: Ground,
    goal: Goal,
) -> StepsChosen:
    sweep = sweep_of(used)
    law, z = _start(sweep, before, ground)
    layout = _layout(started, used, before, ground)
    grid = _grid(ground, layout)
    c = grid.candidates
    measured = on_grid(sweep, c.frequency_hz)
    fitted = fit_on_grid(grid.problem, measured, grid.errors, grid.velocity_m_s, ground.bare, law, z)
    taken = measured.taken.astype(float)
    if started.pending_hz is not None:
        taken[_place(c.frequency_hz, started.pending_hz)] = 1.0
    spent = sum(p.dwell_s + p.settle_s for p in used)
    s = _sensitivity(grid, measured, fitted, ground)
    ahead = _Ahead(
        grid, s, fitted, taken=taken, ground=ground, goal=goal, spent_s=spent, declined_hz=started.declined_hz
    )
    causes_s = before.causes_s
    index, teaches, why = ahead.next(causes_s)
    steps = () if index is None else (index,)
    there = _there(started, used).union(c.frequency_hz[list(steps)].tolist())
    further = _next_layout(layout, fitted.law, fitted.z, there, ground)
    return StepsChosen(
        number=started.number,
        last_step=started.last_step,
        frequencies_hz=tuple(float(c.frequency_hz[k]) for k in steps),
        segments=tuple(int(c.region[k]) for k in steps),
        teaches=teaches,
        ended=index is None and started.pending_hz is None,
        why=why,
        worst_percent=100 * ahead.worst,
        limit_percent=100 * ahead.limit,
        law=_logs(fitted.law),
        stated=tuple(fitted.z.tolist()),
        grid_law=further.law,
        grid_stated=further.stated,
        grid_hz=further.measured_hz,
        causes_s=causes_s + (float(c.seconds[index]) if index is not None and teaches == "causes" else 0.0),
    )


def _start(sweep: Sweep, before: StepsChosen, ground: Ground) -> tuple[CoreLaw, Array]:
    """Where the last choice left law and stated numbers; or a fit from the stated law."""
    if before.law:
        return ground.law.with_logs(np.array(before.law)), np.array(before.stated)
    assert ground.specimen.core is not None
    once = on_grid(sweep, f := np.unique(sweep.frequency_hz))
    problem = ground.problem(f)
    seen = replace(problem.sweep, velocity_m_s=once.response_m_s)
    noise = Noise(once.std_m_s, "stated")
    begun = begin(replace(problem, sweep=seen), ground.reduced, noise, ground.bare, ground.specimen.core.law)
    found = begun.none.law.plain
    # The bend over what was measured may have other knots than over the band: it begins straight.
    straight = np.concatenate([found.values, ground.law.values[len(found.names) :]])
    return ground.law.with_values(straight), begun.none.z


def _layout(started: ChoiceStarted, used: list[PointMeasured], before: StepsChosen, ground: Ground) -> Layout:
    """What the choice before says, with a person's own steps among the candidates."""
    layout = Layout(before.grid_law, before.grid_stated, before.grid_hz)
    there = _there(started, used)
    if there.issubset(_grid(ground, layout).candidates.frequency_hz.tolist()):
        return layout
    return replace(layout, measured_hz=tuple(sorted(there.union(layout.measured_hz))))


def _next_layout(layout: Layout, law: CoreLaw, z: Array, there: set[float], ground: Ground) -> Layout:
    """The same, unless the law has moved far from what it was made for."""
    if not far(law, ground.law.with_logs(np.array(layout.law)), ground.band_hz, _MOVED):
        return layout
    return Layout(_logs(law), tuple(z.tolist()), tuple(sorted(there)))


def _there(started: ChoiceStarted, used: list[PointMeasured]) -> set[float]:
    """Frequencies measured, or begun."""
    pending = set() if started.pending_hz is None else {started.pending_hz}
    return {p.frequency_hz for p in used} | pending


def lay_out(chosen: StepsChosen, ground: Ground) -> None:
    """Make what the choice after this one is going to ask for, so that it has it at once."""
    if chosen.grid_law and not chosen.ended:
        with threadpool_limits(1):
            _grid(ground, Layout(chosen.grid_law, chosen.grid_stated, chosen.grid_hz))


@lru_cache(maxsize=4)
def _grid(ground: Ground, layout: Layout) -> Grid:
    law = ground.law.with_logs(np.array(layout.law))
    return Grid.of(ground, law, np.array(layout.stated), layout.measured_hz)


def _sensitivity(grid: Grid, measured: Measured, fitted: Refitted, ground: Ground) -> Sensitivity:
    """At the candidates, their noise as that of the points shows it."""
    dwell, kept = grid.candidates.dwell_s, measured.taken
    noise = noise_seen(measured.response_m_s[kept], measured.std_m_s[kept], dwell[kept])
    std = np.where(kept, measured.std_m_s, noise.std_m_s(grid.velocity_m_s, dwell))
    return sensitivity(
        grid.problem,
        ground.reduced,
        fitted.law,
        z=fitted.z,
        noise=std,
        dwell_s=dwell,
        bare=ground.bare,
        errors=grid.errors,
    )


class _Ahead:
    """What is known, and what a further step would add."""

    def __init__(
        self,
        grid: Grid,
        s: Sensitivity,
        fitted: Refitted,
        *,
        taken: Array,
        ground: Ground,
        goal: Goal,
        spent_s: float,
        declined_hz: tuple[float, ...],
    ) -> None:
        self._grid, self._s, self._taken, self._goal = grid, s, taken, goal
        self._aims = Aims.over(fitted.law, *ground.band_hz)
        # As `identify`: a misfit widens every error, a good fit narrows none.
        self._wider = float(np.sqrt(max(1.0, np.nan_to_num(fitted.chi2_per_dof, nan=1.0))))
        self.worst = self._wider * float(self._aims.errors(s.covariance(taken)).max())
        self.limit = self._wider * limit_of(s, self._aims)
        c, left = grid.candidates, goal.most_s - spent_s
        possible = (c.seconds <= left) & ~np.isin(c.frequency_hz, declined_hz)
        self._seconds = np.where(possible, c.seconds, np.inf)

    def next(self, causes_s: float) -> tuple[int | None, str, str]:
        """Candidate, what it teaches, why."""
        goal, c = self._goal, self._grid.candidates
        free = np.isfinite(self._seconds) & (self._taken == 0)
        said = f"{two_digits(100 * self.worst)} % so far{self._remark()}"
        if not free.any():
            return None, "", f"time or candidates are used up; {said}"
        wanted = self.worst > max(goal.target, NEAR_LIMIT * self.limit if self.limit > goal.target else 0.0)
        owed = causes_s < goal.causes_share * float(c.seconds @ self._taken)
        if owed and (not wanted or int(self._taken.sum()) % 2):
            causes = Causes(self._s, self._grid.signatures)
            found = causes.choose(self._seconds, self._taken, np.inf, most=1)
            if len(found):
                return int(found[0]), "causes", f"separates what the model may lack; {said}"
        if wanted:
            target = max(goal.target, NEAR_LIMIT * self.limit) / self._wider
            chosen = choose(self._s, self._aims, self._seconds, target, taken=self._taken, most=1)
            if len(chosen.taken):
                return int(chosen.taken[0]), "law", f"brings the worst error down fastest; {said}"
        thin = self._thin(free)
        if thin is not None:
            return thin, "law", f"region {c.region[thin]} has too few steps to check the law; {said}"
        met = "the target is met" if self.worst <= goal.target else "no step would help much"
        return None, "", f"{met}; {said}"

    def _thin(self, free: Array) -> int | None:
        """The clearest candidate for its time of a region that has too few steps."""
        c, s = self._grid.candidates, self._s
        worth = np.abs(s.velocity_m_s) / (s.sigma_m_s * self._seconds)
        for region in np.unique(c.region):
            inside = np.flatnonzero((c.region == region) & free)
            if len(inside) and self._taken[c.region == region].sum() < LEAST_A_REGION:
                return int(inside[np.argmax(worth[inside])])
        return None

    def _remark(self) -> str:
        said = ""
        if self.limit > self._goal.target:
            target, limit = 100 * self._goal.target, 100 * self.limit
            said += f"; {target:g} % is out of reach, everything measured would leave {two_digits(limit)} %"
        if self._wider > _SAID:
            said += f"; the points scatter {self._wider:.2g} times what is expected, errors are widened by it"
        return said


def _place(grid_hz: Array, frequency_hz: float) -> int:
    return int(np.searchsorted(grid_hz, frequency_hz * (1 - 1e-12)))


def _logs(law: CoreLaw) -> tuple[float, ...]:
    return tuple(np.log(law.values).tolist())
