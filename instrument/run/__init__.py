"""A run: rig, runner, operator, live fit and diagnosis, and the same again from a recording."""
