"""What stands on the shaker, whatever it is: its motion relative to the base, and what is read."""

from dataclasses import dataclass

from drivers.simulated.plant.law import MaxwellLaw
from drivers.simulated.plant.structure import Structure


@dataclass(frozen=True)
class Mounted:
    """In its reduced coordinates."""

    structure: Structure
    """Branch 0 is the core. Loads: base heave (per m/s^2) and pitch (per rad/s^2). Readings: spot, tip."""
    spot_x_m: float
    """Lever of the spot under pitch."""
    core_volume_m3: float

    @property
    def core_law(self) -> MaxwellLaw:
        """At the reference temperature and small strain."""
        return self.structure.branches[0].law
