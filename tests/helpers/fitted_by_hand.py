"""A fit of which only what a test says of it is there, its covariance among it."""

from types import SimpleNamespace

from fitting.arrays import Array
from fitting.diagnosis.inference.refitted import Refitted


class FittedByHand(SimpleNamespace):
    """Says of its unknowns what a fit does. All that it knows is from readings."""

    each, of, unknown_errors = Refitted.each, Refitted.of, Refitted.unknown_errors

    def tempered_covariance(self, temper: float) -> Array:
        """Wider by that much."""
        return temper * self.covariance
