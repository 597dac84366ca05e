"""Specimens whose every unknown is drawn from the fit's own priors, swept by the layer-wise model in full.

The plate is assembled anew with its stated numbers off by their tolerances and solved on all its degrees of
freedom; the fit's reduced plate, its derivatives and its grids have no part in it.
"""

import copy
from dataclasses import dataclass, replace
from functools import cache

import numpy as np

from campaign.plant.materials import draw_material
from fitting.diagnosis.inference.whitening import SHARE
from fitting.discrepancy.model_error import DRIFT, GAIN, model_error_at
from fitting.dynamics.damping import viscous_damping
from fitting.dynamics.direct import displacement_direct
from fitting.identification.result import REFERENCE_FREQUENCIES_HZ
from fitting.laws.bent_law import LOSS, REACH, STORAGE
from fitting.laws.fractional_zener import FractionalZener
from fitting.plate.plate import Plate
from fitting.plate.plate_numbers import moved, plate_numbers, tolerance
from fitting.specimen import PlateSpecimen
from fitting.stated.layers import Core, Face
from fitting.sweep import Sweep

NOISE = 0.003
POINTS, SEGMENTS = 16, 3
STATED_LAW = FractionalZener(g0_pa=0.27e6, ginf_pa=4.1e6, tau_s=1.21e-4, alpha=0.83)
"""Where every fit starts: no drawn law is this one."""


def _face(thickness_mm, young_gpa, density):
    return Face(1e-3 * thickness_mm, 1e9 * young_gpa, 0.3, density)


def _plate(sides_mm, boundary, substrate, core_mm, constraining, pickup, elements):
    a, b = (1e-3 * side for side in sides_mm)
    return PlateSpecimen(
        a,
        b,
        boundary,
        _face(*substrate),
        _face(*constraining),
        Core(1e-3 * core_mm, 0.49, 900.0, STATED_LAW),
        modal_ratios=(2.9e-3, 1.3e-3, 1.8e-3, 2.1e-3, 1.1e-3),
        pickup_m=(pickup[0] * a, pickup[1] * b),
        elements=elements,
    )


AL, STEEL = (68.9, 2700.0), (205.0, 7850.0)
PLATES = {
    "published": _plate((300.2, 199.9), "cantilever", (1.9, *AL), 0.5, (0.3, *STEEL), (0.2, 0.3), (10, 8)),
    "strip": _plate((260.0, 60.0), "cantilever", (1.2, *STEEL), 0.25, (0.5, *AL), (0.45, 0.5), (16, 4)),
    "clamped": _plate(
        (480.0, 340.0), "-".join(4 * ["clamped"]), (1.6, *AL), 0.4, (0.4, *AL), (0.35, 0.4), (16, 10)
    ),
    "short": _plate((230.0, 160.0), "cantilever", (1.5, *AL), 0.8, (0.5, *AL), (0.9, 0.3), (10, 8)),
}
"""Four unlike plates on coarse meshes, that truth and fit have in common."""


@cache
def frequencies(name):
    """Points and their segments: three resonances of the plate as stated, 18 % to both sides."""
    plate = Plate(PLATES[name])
    f = np.geomspace(10.0, 700.0, 300)
    x = displacement_direct(plate, viscous_damping(plate), 2 * np.pi * f, STATED_LAW.modulus(2 * np.pi * f))
    size = np.abs(x) * f
    peaks = 1 + np.flatnonzero((size[1:-1] > size[:-2]) & (size[1:-1] > size[2:]))
    each = [np.geomspace(0.82 * p, 1.18 * p, POINTS) for p in f[peaks[:SEGMENTS]]]
    return np.concatenate(each), np.repeat(np.arange(1, len(each) + 1), POINTS)


@dataclass(frozen=True)
class Drawn:
    """What a fit is given, and what it is not."""

    sweep: Sweep
    stated: PlateSpecimen
    parameters: dict[str, float]
    """Of the law before it is bent."""
    frequency_hz: np.ndarray
    modulus_pa: np.ndarray
    """Of the true, bent law at these frequencies."""

    def truth(self, name):
        """Of a quantity by the name that results give it."""
        what, _, at = name.partition(" at ")
        if not at:
            return self.parameters[what]
        k = int(np.argmin(np.abs(self.frequency_hz - float(at.removesuffix(" Hz")))))
        G = self.modulus_pa[k]
        return float(G.real if what == "storage_modulus_pa" else G.imag / G.real)


def draw(seed):
    """One specimen and its sweep."""
    rng = np.random.default_rng([seed, 68, 95])
    name = list(PLATES)[seed % len(PLATES)]
    stated = PLATES[name]
    f, segment = frequencies(name)
    plain = FractionalZener(*draw_material(rng).values)
    every = np.concatenate([f, REFERENCE_FREQUENCIES_HZ])
    G = _bent(plain.modulus(2 * np.pi * every), every, rng)
    v = _read(_off(stated, rng), stated, f, segment, G[: len(f)], rng)
    std = NOISE * np.abs(v)
    white = rng.normal(size=(2, len(v))) + 1j * rng.normal(size=(2, len(v)))
    v = v + SHARE * np.abs(v) * white[0] + std * white[1]
    level = np.full(len(f), stated.base_acceleration_m_s2)
    sweep = Sweep(f, v, level, segment, np.ones(len(f), dtype=np.intp), std_m_s=std)
    return name, Drawn(sweep, stated, dict(zip(plain.names, plain.values, strict=True)), every, G)


def _bent(G, f, rng):
    """G' and eta off the formula, by a smooth Gaussian process each."""
    x = np.log(f)
    K = np.exp(-0.5 * ((x[:, None] - x) / REACH) ** 2)
    values, vectors = np.linalg.eigh(K)
    root = vectors * np.sqrt(np.maximum(values, 0))
    g, e = STORAGE * root @ rng.normal(size=len(x)), LOSS * root @ rng.normal(size=len(x))
    return np.exp(g) * (G.real + 1j * np.exp(e) * G.imag)


def _off(stated, rng):
    """The plate as it is."""
    names, kinds = zip(*plate_numbers(stated), strict=True)
    steps = [tolerance(stated, kind) * rng.normal() for kind in kinds]
    true = moved(stated, names, steps)
    spot = tolerance(stated, "pickup") * rng.normal(size=2)
    factors = np.exp(tolerance(stated, "damping") * rng.normal(size=len(stated.modal_ratios)))
    return replace(
        true,
        pickup_m=(stated.pickup_m[0] + spot[0], stated.pickup_m[1] + spot[1]),
        modal_ratios=tuple(np.array(stated.modal_ratios) * factors),
    )


def _read(true, stated, f, segment, G, rng):
    """The phasors without their noise: what the model gets wrong is drawn segment by segment."""
    plate, omega = Plate(true), 2 * np.pi * f
    damping = viscous_damping(plate)
    x = np.empty(len(f), dtype=complex)
    channel = (1 + tolerance(stated, "gain") * rng.normal()) * np.exp(
        -1j * omega * tolerance(stated, "delay") * rng.normal()
    )
    for number in np.unique(segment):
        inside = segment == number
        here = f[inside]
        middle = np.array([np.sqrt(here[0] * here[-1])])
        at_middle = np.interp(middle, here, G[inside])
        size = model_error_at(true, middle, at_middle)
        loss = size.modal_loss[0] * size.loss[0] * rng.normal()
        # ln f moves by half of what ln K moves by; a loss is the imaginary part of ln K.
        factor = np.exp(2 * size.frequency[0] * rng.normal() + 1j * loss)
        stiffer = copy.copy(plate)
        stiffer.K_0 = plate.K_0 * factor
        along = np.linspace(-1, 1, len(here))
        gain = GAIN * (rng.normal() + 1j * rng.normal()) + DRIFT * along * (rng.normal() + 1j * rng.normal())
        x[inside] = (1 + gain) * displacement_direct(stiffer, damping, omega[inside], G[inside] * factor)
    v = 1j * omega * x
    if stated.reads == "absolute":
        v = v + 1 / (1j * omega)
    return v * channel * stated.base_acceleration_m_s2
