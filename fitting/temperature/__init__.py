"""One law in reduced frequency from sweeps or tables of modes at several temperatures."""
