"""One law in reduced frequency from sweeps at several temperatures."""
