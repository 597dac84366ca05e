"""Impact tests: records, what is wrong with a hit, spectra, and the damping they give."""
