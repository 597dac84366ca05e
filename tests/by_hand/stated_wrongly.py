"""One stated number after the other mistyped or mismeasured, far outside its tolerance: what is said of it?

    python tests/by_hand/stated_wrongly.py
    python tests/by_hand/stated_wrongly.py --on plates --seed 3000000 --only density --only x1.2
    python tests/by_hand/stated_wrongly.py --on beams --seed 1
    python tests/by_hand/stated_wrongly.py --on pairs

The sweeps are clean, and made by something that shares no formula with the fit: `practice` by a solid plate
(tests/data/practice-002.csv), `plates` and `beams` by the solids of `python -m campaign`, `pairs` by the wave
in the pad. Of each case: verdict, what is named with what cannot be told from it, probability of what is
named and of none; errors of G' and eta in standard errors at three frequencies, of the diagnosis and of
`identify` alone; which remarks `identify` makes.
"""

import argparse
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "helpers"))

import shear_pair_cases
from data_folder import DATA

from campaign.beams.cases import draw_case as draw_beam
from campaign.plates.answers import Answer, Band, answer_from, band_from
from campaign.plates.cases import draw_case as draw_plate
from fitting.errors import FittingError
from fitting.identification.as_stated import pulled_together
from fitting.identification.fit import Fit
from fitting.laws import LAWS
from fitting.numerics.chances import chi2_above
from fitting.specimen import PlateSpecimen
from fitting.stated.tolerances import STATED
from fitting.sweep import Sweep
from instrument.errors import BadInput
from instrument.files.specimen_file import read_specimen
from instrument.files.sweep_file import read_sweep
from instrument.finding.diagnosis import diagnose
from instrument.finding.files_at_work import File
from instrument.finding.identification import identify
from instrument.results.diagnosis_from import diagnosis_from
from instrument.results.identification_from import identification_from
from instrument.simulated_case import case_file

LAYERS = ("substrate", "constraining", "core")
FIELDS = {"density": "density_kg_m3", "thickness": "thickness_m", "young": "young_pa", "poisson": "poisson"}
PRACTICE = LAWS["fractional-zener"](200279.795979838, 5134151.076189923, 8.9994e-05, 0.73160059)
"""What the solid of practice-002 was made with."""
MODEST, GROSS = 4.0, (1.2, 2.0)
"""In tolerances; factors."""
FAR = 3.0
"""Standard errors beyond which a law is wrong."""


@dataclass(frozen=True)
class Given:
    """What a laboratory hands in, and the truth it does not know."""

    sweep: Sweep
    specimen: Any
    hammer: Any
    at_hz: tuple[float, ...]
    G: Any
    """In Pa. Shape (frequencies,)."""


Changed = tuple[str, Callable[[Given], Given]]


def practice(seed: int) -> Given:
    """The clean practice sweep of the published plate, known within typical tolerances."""
    at = (20.0, 100.0, 280.0)
    sweep = read_sweep(DATA / "practice-002.csv").sweep(9.81)
    specimen = replace(read_specimen(case_file("specimen.toml")), tolerances={}, exact=False)
    return Given(sweep, specimen, None, at, PRACTICE.modulus(2 * np.pi * np.array(at)))


def of_bench(draw: Callable[[str, int], Any]) -> Callable[[int], Given]:
    """A clean case of a campaign of solids."""

    def given(seed: int) -> Given:
        case = draw("none", seed)
        truth = case.truth
        return Given(case.sweep, case.specimen, case.hammer, truth.resonances_hz, truth.modulus_pa)

    return given


def pair(seed: int) -> Given:
    """One mass on two discs, by a closed form."""
    specimen = shear_pair_cases.pair(shear_pair_cases.MASSES_KG[2])
    sweep = shear_pair_cases.sweep(specimen, seed=seed)
    low, high = sweep.frequency_hz.min(), sweep.frequency_hz.max()
    at = tuple(np.geomspace(1.2 * low, high / 1.2, 3).tolist())
    return Given(sweep, specimen, None, at, specimen.core.law.modulus(2 * np.pi * np.array(at)))


SOURCES = {"practice": practice, "plates": of_bench(draw_plate), "beams": of_bench(draw_beam), "pairs": pair}


def stated(**fields: Any) -> Callable[[Given], Given]:
    """The specimen says so."""
    return lambda one: replace(one, specimen=replace(one.specimen, **fields))


def layer(name: str, field: str, factor: float) -> Callable[[Given], Given]:
    """A layer's number is stated so many times as large."""

    def change(one: Given) -> Given:
        of = getattr(one.specimen, name)
        number = factor * getattr(of, field)
        number = min(number, 0.499) if field == "poisson" else number
        return stated(**{name: replace(of, **{field: number})})(one)

    return change


def read(factor: complex = 1.0, clock: float = 1.0) -> Callable[[Given], Given]:
    """The channel reads, or the axis of frequencies counts, so many times as much."""

    def change(one: Given) -> Given:
        s, v = one.sweep, one.sweep.velocity_m_s
        v = v * (factor if s.has_phase else abs(factor))
        std = None if s.std_m_s is None else abs(factor) * s.std_m_s
        sweep = replace(s, velocity_m_s=v, std_m_s=std, frequency_hz=clock * s.frequency_hz)
        return replace(one, sweep=sweep)

    return change


def tolerance(specimen: Any, name: str) -> float:
    """Of a number, as stated or typical."""
    return float(specimen.tolerances.get(name, STATED[name].typical))


def mistakes(specimen: Any) -> Iterator[Changed]:
    """Every one that is asked about."""
    yield "as stated", lambda one: one
    for name in LAYERS:
        of = getattr(specimen, name, None)
        for short, field in FIELDS.items() if of is not None else ():
            if not hasattr(of, field):
                continue
            off = np.exp(MODEST * tolerance(specimen, f"{name}_{short}"))
            for factor in (off, *GROSS) if short != "poisson" else (off, GROSS[0]):
                yield f"{name}_{short} x{factor:.3g}", layer(name, field, factor)
    yield from channels()
    yield from {"plate": of_plate, "beam": of_beam, "shear-pair": of_pair}[specimen.kind](specimen)


def channels() -> Iterator[Changed]:
    """What is read, whatever it is read of."""
    for name, factor in (("x2", 2.0), ("x0.5", 0.5), ("rms for peak", 0.5**0.5), ("sign flipped", -1.0)):
        yield f"gain {name}", read(factor)
    for clock in (1.02, 0.976):
        yield f"frequencies x{clock:g}", read(clock=clock)


def of_plate(s: Any) -> Iterator[Changed]:
    """Sides, spot, damping, and metals mistaken for each other."""
    x, y = s.pickup_m
    length, width = s.length_m, s.width_m
    for off in (MODEST * 3e-4, 0.05 * length):
        yield f"length +{1e3 * off:.3g} mm", stated(length_m=length + off)
        yield f"width +{1e3 * off:.3g} mm", stated(width_m=width + off)
    for off in (MODEST * 3e-4, 10e-3):
        yield f"pickup_x +{1e3 * off:.3g} mm", stated(pickup_m=(min(x + off, length), y))
        yield f"pickup_y +{1e3 * off:.3g} mm", stated(pickup_m=(x, min(y + off, width)))
    yield "pickup_x from the free end", stated(pickup_m=(length - x, y))
    yield "pickup_y from the other edge", stated(pickup_m=(x, width - y))
    if (y, x) != (x, y) and y <= length and x <= width:
        yield "pickup x and y exchanged", stated(pickup_m=(y, x))
    yield "modal ratios x3", stated(modal_ratios=tuple(3 * r for r in s.modal_ratios))
    yield "modal ratios backwards", stated(modal_ratios=s.modal_ratios[::-1])
    yield from of_metals(s)


def of_beam(s: Any) -> Iterator[Changed]:
    """Length, spot, and metals mistaken for each other."""
    for off in (MODEST * 3e-4, 0.05 * s.length_m):
        yield f"length +{1e3 * off:.3g} mm", stated(length_m=s.length_m + off)
    if s.pickup_m is not None:
        for off in (MODEST * 3e-4, 10e-3):
            yield f"pickup +{1e3 * off:.3g} mm", stated(pickup_m=min(s.pickup_m + off, s.length_m))
        yield "pickup from the other end", stated(pickup_m=s.length_m - s.pickup_m)
    yield from of_metals(s)


def of_pair(s: Any) -> Iterator[Changed]:
    """Mass, discs and their area."""
    for factor in GROSS:
        yield f"mass x{factor:g}", stated(mass_kg=factor * s.mass_kg)
        yield f"area x{factor:g}", stated(area_m2=factor * s.area_m2)
    yield "one disc for two", stated(discs=1)


def of_metals(s: Any) -> Iterator[Changed]:
    """Another metal's numbers, or another layer's."""
    if s.constraining is None:
        return
    yield "layers exchanged", stated(substrate=s.constraining, constraining=s.substrate)
    for name in ("substrate", "constraining"):
        of = getattr(s, name)
        steel = of.density_kg_m3 > 5000
        density, young = (2700.0, 70e9) if steel else (7850.0, 207e9)
        metal = "aluminium" if steel else "steel"
        yield f"{name} density of {metal}", stated(**{name: replace(of, density_kg_m3=density)})
        other = replace(of, density_kg_m3=density, young_pa=young)
        yield f"{name} all of {metal}", stated(**{name: other})


def off(found: Band, one: Given) -> str:
    """Errors in standard errors, those of G', then those of eta."""
    x, at, eta = np.log(found.frequency_hz), np.log(one.at_hz), one.G.imag / one.G.real
    storage, loss, of_storage, of_loss = (
        np.interp(at, x, values)
        for values in (found.storage_pa, found.loss, found.storage_error_pa, found.loss_error)
    )
    z = [*((storage - one.G.real) / of_storage), *((loss - eta) / of_loss)]
    mark = "WRONG" if np.nanmax(np.abs(z)) > FAR else "     "
    return mark + " " + " ".join(f"{v:+6.1f}" for v in z)


def chance_of(fit: Fit) -> float:
    """That numbers stated rightly are moved together so far."""
    z = np.array([number.pull for number in fit.adjusted])
    if not len(z) or fit.posterior is None:
        return float("nan")
    return float(chi2_above(*pulled_together(z, fit.posterior[-len(z) :, -len(z) :])))


def remarked(warnings: tuple[str, ...]) -> str:
    """Which of the remarks that matter were made."""
    known = {
        "further than": "pulled",
        "together": "together",
        "chi-square per degree": "misfit",
        "not follow the data": "lost",
        "cores have": "no core",
        "negative": "gains energy",
        "follow no law": "no law",
    }
    said = [short for words, short in known.items() if any(words in w for w in warnings)]
    return " ".join([",".join(said) or "silent", *(w for w in warnings if w.startswith("p = "))])


def identified(one: Given) -> tuple[Band, tuple[str, ...]]:
    """The law, and the remarks; of a plate how likely stated numbers are moved together as far."""
    found = identify([File(one.sweep, one.specimen)], hammer=one.hammer)
    said = found.result.warnings
    if isinstance(one.specimen, PlateSpecimen):
        said = (*said, f"p = {chance_of(found.result.fit):.2g}")
    return band_from(identification_from(found).law), said


def diagnosed(one: Given) -> Answer:
    """The verdict."""
    return answer_from(diagnosis_from(diagnose([File(one.sweep, one.specimen)], hammer=one.hammer)))


def asked(one: Given, *, law_alone: bool) -> list[str]:
    """What is said of it."""
    lines = []
    try:
        band, warnings = identified(one)
        lines.append(f"   identify {off(band, one)}  {remarked(warnings)}")
    except (BadInput, FittingError) as error:
        lines.append(f"   identify refuses: {str(error)[:110]}")
    if law_alone:
        return lines
    try:
        answer = diagnosed(one)
    except (BadInput, FittingError) as error:
        return [*lines, f"   diagnose refuses: {str(error)[:110]}"]
    likely = sorted(answer.probabilities.items(), key=lambda item: -item[1])[:4]
    each = ", ".join(f"{name} {100 * p:.3g} %" for name, p in likely)
    certain = "CERTAIN" if answer.verdict == "effect" else ""
    wrong = off(answer.after, one) if answer.after is not None else ""
    lines.append(f"   diagnose {wrong}  {answer.verdict} {certain} {'+'.join(answer.effects)}  [{each}]")
    return lines


def main() -> None:
    """Print each case."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--on", choices=SOURCES, default="practice")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument(
        "--only", action="append", default=[], help="Cases whose name has this, or this, in it."
    )
    parser.add_argument("--law-alone", action="store_true", help="Identify alone.")
    options = parser.parse_args()
    truth = SOURCES[options.on](options.seed)
    for name, change in mistakes(truth.specimen):
        if options.only and not any(word in name for word in options.only):
            continue
        began = time.process_time()
        lines = asked(change(truth), law_alone=options.law_alone)
        print(f"{name}  ({time.process_time() - began:.0f} s)", *lines, sep="\n", flush=True)


if __name__ == "__main__":
    main()
