"""The vibrating beam standard's formulas: a layer's modulus and loss factor from single modes (ASTM E756-05).

Each says by itself where it is not to be trusted: differences of nearly equal numbers, too stiff a layer.
The limits are ours, set where 1 % of a frequency ratio moves the modulus by a fifth or more; the standard's
own wording was not at hand. Lengths are free lengths of clamped-free beams; frequencies of the bare and the
treated beam are of the same mode.
"""

from dataclasses import dataclass

import numpy as np

LEAST_OBERST, LEAST_VAN_OORT = 1.1, 1.1
"""(f_treated/f_bare)^2 (1 + density times thickness ratio) that a free layer must reach."""
LEAST_DIFFERENCE = 0.1
"""Of A - B in a sandwich: below it the modulus is a difference of nearly equal numbers."""
LARGEST_MODULUS_RATIO = 0.1
"""Layer over beam: beyond it the layer is no damping layer."""
FIRST_MODE = 2
"""The standard leaves the first mode out."""


@dataclass(frozen=True)
class LayerFound:
    """Of one mode: Young's modulus of a free layer, shear modulus of a core."""

    modulus_pa: float
    loss_factor: float
    objections: tuple[str, ...] = ()
    """Why it is not to be trusted; empty where it is."""


def mode_coefficient(mode: int) -> float:
    """C_n of a clamped-free beam, f = C_n h/l^2 sqrt(E/(12 rho)): (beta_n l)^2 / 2 pi."""
    known = (0.55959, 3.5069, 9.8194, 19.242, 31.809)
    return known[mode - 1] if mode <= len(known) else float(np.pi / 2 * (mode - 0.5) ** 2)


def young_of_bare(
    mode: int, frequency_hz: float, length_m: float, thickness_m: float, density_kg_m3: float
) -> float:
    """E = 12 rho l^4 f^2 / (H^2 C_n^2), in Pa."""
    return 12 * density_kg_m3 * length_m**4 * frequency_hz**2 / (thickness_m * mode_coefficient(mode)) ** 2


def oberst(
    young_pa: float,
    thickness_ratio: float,
    density_ratio: float,
    frequency_ratio: float,
    loss_factor: float,
    mode: int = FIRST_MODE,
) -> LayerFound:
    """One free layer: its ratios to the bare beam, f_treated/f_bare, the treated beam's loss factor."""
    T, D = thickness_ratio, density_ratio
    alpha, beta = frequency_ratio**2 * (1 + D * T), 4 + 6 * T + 4 * T**2
    root = (alpha - beta) ** 2 - 4 * T**2 * (1 - alpha)
    E_1 = young_pa / (2 * T**3) * ((alpha - beta) + np.sqrt(max(root, 0.0)))
    M = E_1 / young_pa
    above = (1 + M * T) * (1 + 4 * M * T + 6 * M * T**2 + 4 * M * T**3 + M**2 * T**4)
    eta_1 = loss_factor * above / (M * T * (3 + 6 * T + 4 * T**2 + 2 * M * T**3 + M**2 * T**4))
    return LayerFound(float(E_1), float(eta_1), _objections(alpha, LEAST_OBERST, M, mode))


def van_oort(
    young_pa: float,
    thickness_ratio: float,
    density_ratio: float,
    frequency_ratio: float,
    loss_factor: float,
    mode: int = FIRST_MODE,
) -> LayerFound:
    """The same layer on both sides (modified Oberst): ratios are of one layer."""
    T, D = thickness_ratio, density_ratio
    alpha, shape = frequency_ratio**2 * (1 + 2 * D * T), 8 * T**3 + 12 * T**2 + 6 * T
    E_1 = young_pa * (alpha - 1) / shape
    eta_1 = loss_factor * (1 + young_pa / (E_1 * shape))
    return LayerFound(float(E_1), float(eta_1), _objections(alpha, LEAST_VAN_OORT, E_1 / young_pa, mode))


def sandwich(
    *,
    young_pa: float,
    face_thickness_m: float,
    core_thickness_m: float,
    density_ratio: float,
    length_m: float,
    mode: int,
    bare_hz: float,
    treated_hz: float,
    loss_factor: float,
) -> LayerFound:
    """A core between two equal faces, by Ross, Kerwin and Ungar: its shear modulus."""
    H, H_1 = face_thickness_m, core_thickness_m
    T = H_1 / H
    B = 1 / (6 * (1 + T) ** 2)
    A = (treated_hz / bare_hz) ** 2 * (2 + density_ratio * T) * B / 2
    lossy = A * loss_factor
    top = A - B - 2 * (A - B) ** 2 - 2 * lossy**2
    bottom = (1 - 2 * A + 2 * B) ** 2 + 4 * lossy**2
    G_1 = top / bottom * 2 * np.pi * mode_coefficient(mode) * young_pa * H * H_1 / length_m**2
    said = _objections(np.inf, 0.0, G_1 / young_pa, mode)
    if A - B < LEAST_DIFFERENCE * B:
        said += (f"A - B = {A - B:.3g} is a difference of nearly equal numbers (A {A:.3g}, B {B:.3g})",)
    return LayerFound(float(G_1), float(lossy / top), said)


def _objections(alpha: float, least: float, ratio: float, mode: int) -> tuple[str, ...]:
    said = []
    if mode < FIRST_MODE:
        said.append("the standard leaves the first mode out")
    if alpha < least:
        said.append(f"(f/f_n)^2 (1 + D T) = {alpha:.3g}, near one; expected {least:g} or more")
    if not 0 < ratio < LARGEST_MODULUS_RATIO:
        said.append(f"modulus over the beam's {ratio:.3g}, expected between 0 and {LARGEST_MODULUS_RATIO:g}")
    return tuple(said)
