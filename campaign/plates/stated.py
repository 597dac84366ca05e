"""What the specimen file says of a plate: drawn about the truth as a careful lab knows it, all at once."""

import tomllib
from dataclasses import dataclass, replace
from math import degrees, exp, radians

import numpy as np

from campaign.plates.geometry import DampingLayer, Metal, TruePlate
from fitting.gravity import PUBLISHED_G_M_S2
from fitting.specimen import PlateSpecimen
from instrument.files.specimen_file import SpecimenDocument, specimen_of
from instrument.impact.mobility import GAIN

_LEAST_APART_POISSON = 0.499


@dataclass(frozen=True)
class CampaignTolerances:
    """Standard deviations of stated numbers about the truth: relative (in the logarithm), m, s or rad."""

    young: float = 0.01
    substrate_thickness: float = 0.005
    constraining_thickness: float = 0.015
    core_thickness: float = 0.03
    density: float = 0.005
    core_density: float = 0.02
    poisson: float = 0.02
    length_m: float = 3e-4
    width_m: float = 1e-4
    pickup_m: float = 3e-4
    damping: float = 0.1
    gain: float = 0.003
    delay_s: float = 3e-6
    phase_rad: float = radians(0.1)

    def lines(self) -> list[str]:
        """Lines of the table `[tolerances]`."""
        percent = {}
        for face in ("substrate", "constraining"):
            percent[f"{face}_young"] = self.young
            percent[f"{face}_thickness"] = getattr(self, f"{face}_thickness")
            percent[f"{face}_density"] = self.density
            percent[f"{face}_poisson"] = self.poisson
        percent |= {"core_thickness": self.core_thickness, "core_density": self.core_density}
        percent |= {"core_poisson": self.poisson, "damping": self.damping, "gain": self.gain}
        lines = [f"{name}_percent = {100 * share:g}" for name, share in percent.items()]
        lengths = {"length": self.length_m, "width": self.width_m, "pickup": self.pickup_m}
        lines += [f"{name}_mm = {1e3 * metres:g}" for name, metres in lengths.items()]
        return [*lines, f"delay_us = {1e6 * self.delay_s:g}", f"phase_deg = {degrees(self.phase_rad):g}"]


CAREFUL = CampaignTolerances()
STRUCK = replace(CAREFUL, gain=GAIN)
"""Of mobilities: a hammer's force is known less well than a base's acceleration."""


def draw_stated(
    rng: np.random.Generator, true: TruePlate, tolerances: CampaignTolerances = CAREFUL
) -> TruePlate:
    """The plate as it is believed to be."""
    t = tolerances

    def off(std: float) -> float:
        return std * float(rng.standard_normal())

    assert true.core is not None
    assert true.constraining is not None
    length, width = true.length_m + off(t.length_m), true.width_m + off(t.width_m)
    x, y = (at + off(t.pickup_m) for at in true.spot_m)
    return replace(
        true,
        length_m=length,
        width_m=width,
        substrate=stated_metal(rng, true.substrate, t.substrate_thickness, t),
        core=stated_core(rng, true.core, t),
        constraining=stated_metal(rng, true.constraining, t.constraining_thickness, t),
        spot_m=(min(x, length), min(y, width)),
        ratios=tuple(r * exp(off(t.damping)) for r in true.ratios),
    )


def stated_metal(rng: np.random.Generator, m: Metal, thickness: float, t: CampaignTolerances) -> Metal:
    """A face as it is believed to be; `thickness` is the tolerance of its own."""
    stds = (thickness, t.young, t.poisson, t.density)
    off = [exp(std * float(rng.standard_normal())) for std in stds]
    return Metal(m.thickness_m * off[0], m.young_pa * off[1], m.poisson * off[2], m.density_kg_m3 * off[3])


def stated_core(rng: np.random.Generator, c: DampingLayer, t: CampaignTolerances) -> DampingLayer:
    """The core but for its law as it is believed to be."""
    stds = (t.poisson, t.core_thickness, t.core_density)
    poisson, thickness, density = (exp(std * float(rng.standard_normal())) for std in stds)
    believed = min(c.poisson * poisson, _LEAST_APART_POISSON)
    return DampingLayer(c.thickness_m * thickness, believed, c.density_kg_m3 * density)


def layer_lines(name: str, layer: Metal | DampingLayer) -> list[str]:
    """Its table of the specimen file, without a law."""
    lines = [f"[{name}]", f"thickness_mm = {digits(1e3 * layer.thickness_m)}"]
    if isinstance(layer, Metal):
        lines.append(f"young_gpa = {digits(1e-9 * layer.young_pa)}")
    return [
        *lines,
        f"poisson = {digits(layer.poisson)}",
        f"density_kg_m3 = {digits(layer.density_kg_m3)}",
        "",
    ]


def law_lines(middle_hz: float, stiffer: float = 1.0) -> list[str]:
    """Of `[core.law]`: where a fit starts, not the answer."""
    tau = 1 / (2 * np.pi * 8 * middle_hz)
    moduli = [f"g0_mpa = {0.4 * stiffer:g}", f"ginf_mpa = {8.0 * stiffer:g}"]
    return ["[core.law]", 'kind = "fractional-zener"', *moduli, f"tau_s = {tau:.3g}", "alpha = 0.7", ""]


def plate_lines(plate: TruePlate, boundary: str, middle_hz: float) -> list[str]:
    """Of `[plate]`, its layers and the law."""
    lines = ["[plate]", f"length_mm = {digits(1e3 * plate.length_m)}"]
    lines += [f"width_mm = {digits(1e3 * plate.width_m)}", f'boundary = "{boundary}"', ""]
    layers = {"substrate": plate.substrate, "constraining": plate.constraining, "core": plate.core}
    for name, layer in layers.items():
        assert layer is not None
        lines += layer_lines(name, layer)
    return [*lines, *law_lines(middle_hz)]


def damping_lines(plate: TruePlate) -> list[str]:
    """Lines of the table `[damping]`."""
    ratios = ", ".join(digits(100 * r) for r in plate.ratios)
    return ["[damping]", f"modal_percent = [{ratios}]", ""]


def toml(plate: TruePlate, tolerances: CampaignTolerances | None, middle_hz: float) -> str:
    """The text of the specimen's file.

    No tolerances: all is exact. The law is where a fit starts, not the answer.
    """
    lines = [*plate_lines(plate, "cantilever", middle_hz), *damping_lines(plate), "[pickup]"]
    lines += [f"x_mm = {digits(1e3 * plate.spot_m[0])}", f"y_mm = {digits(1e3 * plate.spot_m[1])}", ""]
    lines += ["[base]", f"acceleration_m_s2 = {PUBLISHED_G_M_S2}", "", "[tolerances]"]
    lines += ["exact = true"] if tolerances is None else tolerances.lines()
    return "\n".join(lines) + "\n"


def digits(value: float) -> str:
    """Enough of them that rounding is no error of its own."""
    return f"{value:.7g}"


def specimen_from(text: str) -> PlateSpecimen:
    """What `viscorig` makes of the file."""
    return specimen_of(SpecimenDocument.model_validate(tomllib.loads(text)))
