"""Readings of a sweep: how noisy they are, which are none, which belong together."""
