"""Natural frequencies and damping ratios from a frequency response function, three ways."""
