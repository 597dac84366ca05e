"""What the bare plate's hammer test fixes: the substrate's stiffness, and a ratio for each mode.

Every natural frequency of a bare plate goes with the root of its Young's modulus. The clamp of the hammer
test is a mounting of its own: its compliance is a nuisance with a prior, and is not carried to the sweep.

    ln f_measured - ln f_model = 1/2 ln(E/E_stated) - kappa s_r + scatter

s_r is a mode's fall for a soft root, from the bending moment it hands to the clamp, scaled to one for mode 1.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array, Complex
from fitting.dynamics.air import air_lowering
from fitting.dynamics.bare_modes import CarriedSensor, bare_modes, clamp_softness
from fitting.errors import TooFewPoints
from fitting.plate.part_matrices import projected_parts
from fitting.plate.part_names import names_of
from fitting.plate.parts import coefficients
from fitting.plate.plate import Plate
from fitting.plate.plate_numbers import moved, tolerance
from fitting.specimen import PlateSpecimen

FREQUENCY_SCATTER = 5e-4
"""Standard deviation of ln f: remounting and reading 0.03 %, the plate model 0.04 %."""
_STIFFNESS = 0.2
"""Prior of the stiffness in a test by itself: wide enough to leave it to the test."""
CLAMP = 0.01
"""Prior standard deviation of kappa: a soft root may take 1 % off mode 1."""
_MOST_PRIORS = 5
"""Times `CLAMP` that a clamp may be found soft: further is another specimen, or none."""
_MATCH = 0.15
"""A measured mode further than this from every predicted one is left out."""
_SHIFTS = 121
"""Common shifts that are tried within `_MATCH`: 0.25 % apart, a thirtieth of how near a match has to be."""
_LENGTH_STEP_M = 1e-4
"""Of the difference quotient to the free length. A choice: small beside any plate's."""
_SPARE = 4
"""Modes of the model beyond those measured: a mode that the hammer missed leaves the others their
partners."""
_EDGE_DOUBT = 0.3
"""Share of `edge_softening` in doubt: torsion of a strip is not quite a plate's."""


@dataclass(frozen=True)
class BarePlateFit:
    """The substrate's stiffness as the hammer test has it."""

    young_scale: float
    """Over the stated one."""
    standard_error: float
    """Standard error of the logarithm of `young_scale`."""
    clamp_percent: float
    """What the root's compliance takes off mode 1."""
    measured_hz: Array
    fitted_hz: Array
    ratios: tuple[float, ...]
    """For the modes in order: the measured one where there is one, else the specimen's."""
    left_out_hz: tuple[float, ...]


@dataclass(frozen=True)
class MatchedModes:
    """Modes of the hammer test beside the model's; arrays of shape (modes,)."""

    measured_hz: Array
    model_hz: Array
    softness: Array
    """Fall for a root that yields in rotation, one for mode 1."""
    scatter: Array
    """Standard deviation of ln(measured / model)."""
    air: Array
    """Relative fall that unit density of air brings, to first order."""
    ratios: tuple[float, ...]
    """For the plate's modes in order: the measured one where there is one, else the specimen's."""
    left_out_hz: tuple[float, ...]
    stiffness: Complex
    """phi^T P_p phi for the parts of K_0 (`fitting.plate.parts`). Shape (modes, parts)."""
    inertia: Array
    """The same for M. Shape (modes, parts)."""
    sensor: Array
    """What the sensor adds to phi^T M phi. Shape (modes,)."""
    by_line: Array
    """Fall of ln f for a metre of free length more. Shape (modes,)."""

    @property
    def shift(self) -> Array:
        """ln(measured / model)."""
        return np.asarray(np.log(self.measured_hz / self.model_hz))


def match_modes(
    specimen: PlateSpecimen, measured_hz: Array, measured_ratios: Array, sensor: CarriedSensor | None = None
) -> MatchedModes:
    """A hammer test of `specimen.bare` beside its model; what was measured of shape (modes,) each.

    `sensor` is what sat on the plate in the test; the model's modes are those of the plate with it. Raises
    `TooFewPoints` where too few modes match, `OutsideModel`.
    """
    plate = Plate(specimen.bare)
    count = max(len(measured_hz), len(specimen.modal_ratios)) + _SPARE
    modes, edge = bare_modes(plate, count, sensor)
    model_hz = modes.omega * (1 - edge) / (2 * np.pi)
    order = np.argsort(measured_hz)
    pairs = _matched(measured_hz[order], model_hz)
    if len(pairs) < 2:
        raise TooFewPoints(
            f"{len(pairs)} of {len(measured_hz)} hammer modes lie within {100 * _MATCH:.0f} % of the "
            f"bare plate's ({', '.join(f'{f:.4g}' for f in model_hz[:5])}, ... Hz), expected 2 or more"
        )
    if 2 * len(pairs) <= len(measured_hz):
        raise TooFewPoints(
            f"only {len(pairs)} of {len(measured_hz)} hammer modes match the bare plate: is it this specimen?"
        )
    which, index = (np.array(side) for side in zip(*pairs, strict=True))
    shapes = modes.shapes[:, index]
    parts = np.einsum("pmm->mp", projected_parts(plate, shapes))
    counts = names_of(plate.specimen).counts
    of_K, of_M = parts[:, counts.K_0], parts[:, counts.M]
    row = plate.observe(sensor.x_m, sensor.y_m, sensor.words) if sensor is not None else np.zeros(plate.size)
    return MatchedModes(
        stiffness=of_K.astype(complex),
        inertia=of_M,
        sensor=(sensor.mass_kg if sensor is not None else 0.0) * (row @ shapes) ** 2,
        by_line=_by_line(specimen.bare, of_K, of_M),
        measured_hz=measured_hz[order][which],
        model_hz=model_hz[index],
        softness=clamp_softness(plate, modes)[index],
        scatter=np.hypot(FREQUENCY_SCATTER, _EDGE_DOUBT * edge[index]),
        air=air_lowering(plate, modes, 1.0)[index],
        ratios=_ratios(specimen, index, measured_ratios[order][which]),
        left_out_hz=tuple(float(x) for x in np.delete(measured_hz[order], which)),
    )


def fit_bare_plate(
    specimen: PlateSpecimen, measured_hz: Array, measured_ratios: Array, sensor: CarriedSensor | None = None
) -> BarePlateFit:
    """Stiffness and ratios, by `match_modes` from a hammer test, shape (modes,).

    Raises `TooFewPoints` where too few modes match or want too soft a clamp, `OutsideModel`.
    """
    m = match_modes(specimen, measured_hz, measured_ratios, sensor)
    scale, error, kappa = _solve(
        m.shift, m.softness, m.scatter, max(_STIFFNESS, tolerance(specimen, "substrate_young"))
    )
    if abs(kappa) > _MOST_PRIORS * CLAMP:
        raise TooFewPoints(
            f"the hammer modes want a clamp that moves mode 1 by {-100 * kappa:+.1f} %, "
            f"expected at most {100 * _MOST_PRIORS * CLAMP:.0f} %: is it this specimen?"
        )
    return BarePlateFit(
        young_scale=scale,
        standard_error=error,
        # Softness is one for mode 1.
        clamp_percent=100 * kappa,
        measured_hz=m.measured_hz,
        fitted_hz=m.model_hz * np.sqrt(scale) * np.exp(-kappa * m.softness),
        ratios=m.ratios,
        left_out_hz=m.left_out_hz,
    )


def with_bare_plate(specimen: PlateSpecimen, fit: BarePlateFit) -> PlateSpecimen:
    """The specimen with the hammer test's stiffness, what is left of its tolerance, and its ratios."""
    substrate = replace(specimen.substrate, young_pa=specimen.substrate.young_pa * fit.young_scale)
    tolerances = {**specimen.tolerances, "substrate_young": fit.standard_error}
    return replace(specimen, substrate=substrate, tolerances=tolerances, modal_ratios=fit.ratios)


def _matched(measured: Array, model: Array) -> list[tuple[int, int]]:
    """Pairs (measured, model), each at most once, the stiffness' common shift taken out first."""
    shift = _common_shift(measured, model)
    pairs: list[tuple[int, int]] = []
    for k, f in enumerate(measured):
        distance = np.abs(np.log(f / model) - shift)
        best = int(np.argmin(distance))
        if distance[best] < _MATCH / 2 and best not in {index for _, index in pairs}:
            pairs.append((k, best))
    return pairs


def _common_shift(measured: Array, model: Array) -> float:
    """The shift of ln f within the tolerance of a match that brings most modes onto the model's."""
    scored_fits = np.linspace(-_MATCH, _MATCH, _SHIFTS)
    distance = np.abs(np.log(measured[:, None, None] / model[None, :, None]) - scored_fits).min(axis=1)
    return float(scored_fits[np.argmin(np.minimum(distance, _MATCH / 2).sum(axis=0))])


def _solve(shift: Array, softness: Array, scatter: Array, tolerance: float) -> tuple[float, float, float]:
    """E/E_stated, the standard error of its logarithm, kappa: least squares with two priors."""
    J = np.column_stack([np.full(len(shift), 0.5), -softness]) / scatter[:, None]
    A = J.T @ J + np.diag([1 / tolerance**2, 1 / CLAMP**2])
    found = np.linalg.solve(A, J.T @ (shift / scatter))
    left = shift / scatter - J @ found
    covariance = np.linalg.inv(A) * max(1.0, float(left @ left) / max(1, len(shift) - 2))
    return float(np.exp(found[0])), float(np.sqrt(covariance[0, 0])), float(found[1])


def _by_line(bare: PlateSpecimen, of_K: Array, of_M: Array) -> Array:
    """-d ln f / d length, by Rayleigh's quotient. Shape (modes,)."""
    logs = []
    for step in (_LENGTH_STEP_M, -_LENGTH_STEP_M):
        c = coefficients(moved(bare, ["length"], [step]), bare)
        logs.append(np.log((of_K @ c.K_0.real) / (of_M @ c.M)) / 2)
    return np.asarray(-(logs[0] - logs[1]) / (2 * _LENGTH_STEP_M))


def _ratios(specimen: PlateSpecimen, index: NDArray[np.intp], ratio: Array) -> tuple[float, ...]:
    length = max(len(specimen.modal_ratios), int(index.max()) + 1)
    ratios = np.zeros(length)
    ratios[: len(specimen.modal_ratios)] = specimen.modal_ratios
    known = np.isfinite(ratio) & (ratio > 0)
    ratios[index[known]] = ratio[known]
    return tuple(float(r) for r in ratios)
