"""The result of `viscorig predict`, of the response itself."""

from collections.abc import Sequence

from fitting.arrays import Array, Complex
from instrument.facts.prediction import PointPredicted, PredictionResult
from instrument.results.fitted_response import FittedResponse


def prediction_from(frequency_hz: Array, velocity_m_s: Complex, *remarks: str) -> PredictionResult:
    """Of a specimen's own law. Shape (points,) each."""
    rows = zip(frequency_hz.tolist(), velocity_m_s, strict=True)
    return PredictionResult(points=tuple(_point(f, z) for f, z in rows), notes=tuple(r for r in remarks if r))


def of_spots(each: Sequence[PredictionResult]) -> PredictionResult:
    """Spot after spot, numbered where there are several."""
    if len(each) == 1:
        return each[0]
    points = tuple(point.but(pickup=k) for k, one in enumerate(each) for point in one.points)
    return each[0].but(points=points)


def prediction_from_fit(found: FittedResponse, *remarks: str) -> PredictionResult:
    """Of a law and a plate that were fitted, with standard errors."""
    plain = prediction_from(found.frequency_hz, found.velocity_m_s, *remarks)
    errors = zip(
        found.amplitude_standard_error_m_s.tolist(), found.phase_standard_error_rad.tolist(), strict=True
    )
    points = tuple(
        point.but(velocity_standard_error_m_s=size, phase_standard_error_rad=turn)
        for point, (size, turn) in zip(plain.points, errors, strict=True)
    )
    return plain.but(points=points)


def _point(f: float, z: complex) -> PointPredicted:
    return PointPredicted(
        frequency_hz=f,
        velocity_re_m_s=float(z.real),
        velocity_im_m_s=float(z.imag),
        velocity_m_s=float(abs(z)),
    )
