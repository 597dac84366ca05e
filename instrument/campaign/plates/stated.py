"""What the specimen file says of a plate: drawn about the truth as a careful lab knows it, all at once."""

import tomllib
from dataclasses import dataclass, replace
from math import exp

import numpy as np

from fitting.gravity import PUBLISHED_G_M_S2
from fitting.specimen import Specimen
from instrument.campaign.plates.geometry import DampingLayer, Metal, TruePlate
from instrument.files.specimen_file import SpecimenDocument, specimen_of

_LEAST_APART_POISSON = 0.499


@dataclass(frozen=True)
class CampaignTolerances:
    """Standard deviations of stated numbers about the truth: relative (in the logarithm), m or s."""

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

    def lines(self) -> list[str]:
        """Of `[tolerances]`."""
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
        return [*lines, f"delay_us = {1e6 * self.delay_s:g}"]


CAREFUL = CampaignTolerances()


def draw_stated(
    rng: np.random.Generator, true: TruePlate, tolerances: CampaignTolerances = CAREFUL
) -> TruePlate:
    """The plate as it is believed to be."""
    t = tolerances

    def off(std: float) -> float:
        return std * float(rng.standard_normal())

    def metal(m: Metal, thickness: float) -> Metal:
        return Metal(
            m.thickness_m * exp(off(thickness)),
            m.young_pa * exp(off(t.young)),
            m.poisson * exp(off(t.poisson)),
            m.density_kg_m3 * exp(off(t.density)),
        )

    def core(c: DampingLayer) -> DampingLayer:
        poisson = min(c.poisson * exp(off(t.poisson)), _LEAST_APART_POISSON)
        return DampingLayer(
            c.thickness_m * exp(off(t.core_thickness)), poisson, c.density_kg_m3 * exp(off(t.core_density))
        )

    assert true.core is not None
    assert true.constraining is not None
    length, width = true.length_m + off(t.length_m), true.width_m + off(t.width_m)
    x, y = (at + off(t.pickup_m) for at in true.spot_m)
    return replace(
        true,
        length_m=length,
        width_m=width,
        substrate=metal(true.substrate, t.substrate_thickness),
        core=core(true.core),
        constraining=metal(true.constraining, t.constraining_thickness),
        spot_m=(min(x, length), min(y, width)),
        ratios=tuple(r * exp(off(t.damping)) for r in true.ratios),
    )


def toml(plate: TruePlate, tolerances: CampaignTolerances | None, middle_hz: float) -> str:
    """The specimen file. No tolerances: all is exact. The law is where a fit starts, not the answer."""
    core, faces = plate.core, (("substrate", plate.substrate), ("constraining", plate.constraining))
    assert core is not None
    lines = ["[plate]", f"length_mm = {_digits(1e3 * plate.length_m)}"]
    lines += [f"width_mm = {_digits(1e3 * plate.width_m)}", 'boundary = "cantilever"', ""]
    for name, face in faces:
        assert face is not None
        lines += [f"[{name}]", f"thickness_mm = {_digits(1e3 * face.thickness_m)}"]
        lines += [f"young_gpa = {_digits(1e-9 * face.young_pa)}", f"poisson = {_digits(face.poisson)}"]
        lines += [f"density_kg_m3 = {_digits(face.density_kg_m3)}", ""]
    lines += ["[core]", f"thickness_mm = {_digits(1e3 * core.thickness_m)}"]
    lines += [f"poisson = {_digits(core.poisson)}", f"density_kg_m3 = {_digits(core.density_kg_m3)}", ""]
    tau = 1 / (2 * np.pi * 8 * middle_hz)
    lines += ["[core.law]", 'kind = "fractional-zener"', "g0_mpa = 0.4", "ginf_mpa = 8.0"]
    lines += [f"tau_s = {tau:.3g}", "alpha = 0.7", "", "[damping]"]
    ratios = ", ".join(_digits(100 * r) for r in plate.ratios)
    lines += [f"modal_percent = [{ratios}]", "", "[pickup]"]
    lines += [f"x_mm = {_digits(1e3 * plate.spot_m[0])}", f"y_mm = {_digits(1e3 * plate.spot_m[1])}", ""]
    lines += ["[base]", f"acceleration_m_s2 = {PUBLISHED_G_M_S2}", "", "[tolerances]"]
    lines += ["exact = true"] if tolerances is None else tolerances.lines()
    return "\n".join(lines) + "\n"


def _digits(value: float) -> str:
    """Enough of them that rounding is no error of its own."""
    return f"{value:.7g}"


def specimen_from(text: str) -> Specimen:
    """What `viscorig` makes of the file."""
    return specimen_of(SpecimenDocument.model_validate(tomllib.loads(text)))
