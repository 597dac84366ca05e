"""Does the diagnosis find what is there? Sweeps of the 3D plant with known effects, diagnosed and scored."""
