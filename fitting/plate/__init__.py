"""The layer-wise finite elements of a plate: its matrices, and these as sums of fixed parts."""
