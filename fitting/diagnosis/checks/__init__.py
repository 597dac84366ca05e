"""Whether a fit holds: what it leaves, whether it would leave such data, what it predicts of the rest."""
