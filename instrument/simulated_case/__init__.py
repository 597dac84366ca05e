"""A whole experiment on the simulated rig: the published plate, hammer test, sweep of three resonances."""

from pathlib import Path

FILES = ("experiment.toml", "rig.toml", "specimen.toml")


def case_file(name: str) -> Path:
    """Path of one of `FILES`."""
    return Path(__file__).parent / name
