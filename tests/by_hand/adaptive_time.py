"""Rig time to a target: the adaptive sweep beside a fixed sweep of three resonances, on simulated specimens.

python tests/by_hand/adaptive_time.py --cases 20

Both measure the same specimens with the same noise, by the same rules of settling and dwell; time is
virtual. The adaptive sweep is walked by its own plan and choices, as on a rig. The fixed one has as many
steps around each of the first three resonances as `--points` says, in ascending order; it is identified
after every few steps, and has met the target at the first at which its stated errors are within it,
everywhere in the adaptive sweep's band. Where it never does, its whole time counts.
"""

import argparse
from collections.abc import Iterator
from dataclasses import dataclass, field
from time import process_time

import numpy as np
from planned_cases import PlannedCase, planned_case

from fitting.arrays import Array
from fitting.gravity import PUBLISHED_G_M_S2
from fitting.sweep import Sweep
from instrument.finding.identification import identify
from instrument.models.files import File
from instrument.planning.choosing import Goal, choose_steps, lay_out
from instrument.planning.costs import decay_of
from instrument.planning.grid import Ground
from instrument.planning.outlook import outlook_of
from instrument.session.points import sweep_of
from instrument.stepped_sine.adaptive import AdaptivePlanner
from instrument.stepped_sine.plan import ChoiceWanted, Result
from instrument.stepped_sine.settings import SweepSettings
from instrument.stream.derived import LoopChecked, PointMeasured, StepsChosen
from instrument.stream.raw import ChoiceStarted, StepBegan

LEVEL_G = 1.0
SPAN = 0.25
"""Of a resonance's frequency, low to high: of a fixed segment."""
VERBOSE = False
EVERY = 6
"""Steps between two identifications of the fixed sweep."""


@dataclass
class Rig:
    """Reads a simulated specimen in virtual time."""

    case: PlannedCase
    settings: SweepSettings
    poles_hz: Array
    rng: np.random.Generator
    seconds: float = 0.0
    points: list[PointMeasured] = field(default_factory=list)
    _last: complex = 0j

    def measure(self, step: int, frequency_hz: float, segment: int, sweep: int) -> PointMeasured:
        """One step: settle from what the plate did before, and read."""
        s, f = self.settings, frequency_hz
        dwell = s.dwell_s(f)
        one = self.case.measured(
            np.array([f]), np.array([segment]), np.array([dwell]), np.array([self.seconds]), LEVEL_G, self.rng
        )
        v = complex(one.velocity_m_s[0])
        # What rings is at most what was there and what is to come.
        excess = (abs(v) + abs(self._last)) / abs(v) / s.settle.tolerance
        wait = min(np.log(max(excess, 1.0)) / decay_of(self.poles_hz)(f), s.settle.most_s)
        settle = s.control.ramp_s + 2 * s.block_s(f) + float(wait)
        self.seconds += settle + dwell
        self._last = v
        assert one.std_m_s is not None
        point = _point(step, segment, sweep, f, dwell, settle, v, float(one.std_m_s[0]))
        self.points.append(point)
        return point

    @property
    def sweep(self) -> Sweep:
        """All points so far."""
        return sweep_of(self.points)


def _point(
    step: int, segment: int, sweep: int, f: float, dwell: float, settle: float, v: complex, std: float
) -> PointMeasured:
    a = LEVEL_G * PUBLISHED_G_M_S2
    return PointMeasured(
        step, "step", segment, sweep, f, a, 0, dwell, settle, 1.0, a, 0.0, 1e-9, v.real, v.imag, std,
        0.0, 0.0, 0.0, "", None, None, (),
    )  # fmt: skip


@dataclass(frozen=True)
class Ended:
    """A sweep."""

    seconds: float
    reached: bool
    points: int
    worst: float
    """Largest standard error that `identify` states of it over the band."""
    z: Array
    """Errors of G' and eta over the stated ones. Shape (2, frequencies)."""


def adaptive(case: PlannedCase, ground: Ground, goal: Goal, rig: Rig) -> tuple[float, float, list[float]]:
    """Walk the plan; time to the target and to the end, and how long each choice took."""
    planner = AdaptivePlanner(
        rig.settings, decay_of(rig.poles_hz), None, level_m_s2=LEVEL_G * PUBLISHED_G_M_S2
    )
    plan, result = planner.adaptive(), None
    choices: dict[int, StepsChosen] = {}
    took: list[float] = []
    reached = np.inf
    started: ChoiceStarted | None = None
    known: list[PointMeasured] = []
    while True:
        try:
            action = plan.send(result)
        except StopIteration:
            return reached, rig.seconds, took
        result = None
        if isinstance(action, StepBegan):
            result = _step(rig, action)
        elif isinstance(action, ChoiceStarted):
            started, known = action, list(rig.points)
        elif isinstance(action, ChoiceWanted):
            assert started is not None
            began = process_time()
            result = choose_steps(started, known, choices.get(action.number - 1), ground, goal)
            took.append(process_time() - began)
            choices[action.number] = result
            # As a run does, while the step is measured.
            lay_out(result, ground)
            if VERBOSE:
                print(action.number, f"{rig.seconds:.1f} s", result.frequencies_hz, result.why)
            worst = result.worst_percent
            if worst is not None and worst <= 100 * goal.target and not np.isfinite(reached):
                reached = rig.seconds


def _step(rig: Rig, action: StepBegan) -> Result:
    if action.purpose == "loop-check":
        return LoopChecked(action.step, action.frequency_hz, 1.0, 1e3)
    return rig.measure(action.step, action.frequency_hz, action.segment, action.sweep)


def stated(case: PlannedCase, sweep: Sweep, f: Array) -> tuple[float, Array]:
    """Largest standard error of G' and eta by `identify`, and errors over the stated ones."""
    band = identify([File(sweep, case.specimen)]).result.band
    rows = np.array([band.storage_modulus_pa, band.loss_factor])
    errors = np.array([band.storage_modulus_standard_error_pa, band.loss_factor_standard_error])
    inside = (f >= band.frequency_hz[0] * (1 - 1e-3)) & (f <= band.frequency_hz[-1] * (1 + 1e-3))
    x = np.log(band.frequency_hz)
    found, error = (np.array([np.interp(np.log(f), x, r) for r in a]) for a in (rows, errors))
    truth = case.law_at(f)
    worst = float((error / found).max()) if inside.all() else np.inf
    return worst, (found - truth) / error


def fixed(
    case: PlannedCase, rig: Rig, centres: Array, points: int, f: Array, target: float
) -> Iterator[Ended]:
    """The fixed sweep, identified as it goes, until it meets the target or ends."""
    steps = [
        (float(x), k)
        for k, p in enumerate(centres, start=1)
        for x in np.round(np.linspace(p * (1 - SPAN / 2), p * (1 + SPAN / 2), points), 3)
    ]
    for number, (x, segment) in enumerate(steps, start=1):
        rig.measure(number, x, segment, 1)
        late = number > 2 * points and (number - 2 * points) % EVERY == 0
        if late or number == len(steps):
            worst, z = stated(case, rig.sweep, f)
            yield Ended(rig.seconds, worst <= target, number, worst, z)


def main() -> None:
    """Run the cases, print each and the whole."""
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    options.add_argument("--cases", type=int, default=20)
    options.add_argument("--first", type=int, default=0)
    options.add_argument("--target", type=float, default=2.0)
    options.add_argument("--points", type=int, default=41)
    given = options.parse_args()
    target, ratios, z, z_fixed, every = given.target / 100, [], [], [], []
    for seed in range(given.first, given.first + given.cases):
        case, settings = planned_case(seed), SweepSettings()
        outlook = outlook_of(case.specimen, settings)
        centres = outlook.poles_hz.real[
            (outlook.poles_hz.real > outlook.band_hz[0]) & (outlook.poles_hz.real < outlook.band_hz[1])
        ][:3]
        # What the fixed sweep covers is what both are asked for.
        band = (round(float(centres[0]) * (1 - SPAN / 2), 2), round(float(centres[-1]) * (1 + SPAN / 2), 2))
        ground = Ground.of(case.specimen, settings, band, LEVEL_G * PUBLISHED_G_M_S2)
        f = np.geomspace(*band, 21)
        rig = Rig(case, settings, outlook.poles_hz, np.random.default_rng([seed, 82]))
        reached, end, took = adaptive(case, ground, Goal(target, 0.25, 1800.0), rig)
        worst, off = stated(case, rig.sweep, f)
        other = Rig(case, settings, outlook.poles_hz, np.random.default_rng([seed, 83]))
        met = None
        for met in fixed(case, other, centres, given.points, f, target):
            if met.reached:
                break
        assert met is not None
        ratio = end / met.seconds
        ratios.append(ratio)
        z.append(off)
        z_fixed.append(met.z)
        every += took
        print(
            f"{seed:3} {case.truth.plate.name:4} {case.truth.law.kind:18} "
            f"adaptive {len(rig.points):3} steps {end:5.0f} s leaves {100 * worst:4.2f} % "
            f"(target met after {reached:4.0f} s) | "
            f"fixed {met.points:3} steps {met.seconds:5.0f} s leaves {100 * met.worst:4.2f} % | "
            f"ratio {ratio:.2f} | z max {np.abs(off).max():.2f} | "
            f"choice {np.median(took):.2f} s, most {max(took):.2f} s",
            flush=True,
        )
    print(f"ratio: median {np.median(ratios):.2f}, worst {max(ratios):.2f}")
    for what, rows in (("adaptive", z), ("fixed", z_fixed)):
        each = np.concatenate([x.ravel() for x in rows])
        outside, rms = np.mean(np.abs(each) > 1.96), np.sqrt(np.mean(each**2))
        print(f"{what}: truth outside 1.96 stated errors in {outside:.3f} of the band, rms {rms:.2f}")
    late = np.quantile(every, 0.95)
    print(
        f"a choice: median {np.median(every):.2f} s, 95 % {late:.2f} s, most {max(every):.2f} s of processor"
    )


if __name__ == "__main__":
    main()
