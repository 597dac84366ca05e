"""What the model refuses. Each message names the number, the limit and the remedy.

FittingError
  OutsideModel    a question the specimen or the law cannot answer
  TooFewPoints    data that cannot carry the question
"""


class FittingError(ValueError):
    """Root of all refusals in `fitting`."""


class OutsideModel(FittingError):
    """The specimen or the law has no answer there."""


class TooFewPoints(FittingError):
    """The data cannot carry the question."""
