"""What to measure: a plan before anything is mounted, the next step of a sweep that chooses its own."""
