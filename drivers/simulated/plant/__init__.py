"""The plate that the simulated rig shakes: a reduced 3D solid model with an exact time response."""
