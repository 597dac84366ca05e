"""A campaign on the published plate: sweeps of its 3D plant, whose stated numbers are exact."""
