"""A plate of the campaign as a coarse solid, which is made in a second."""

from campaign.plates.geometry import plate_named
from campaign.plates.grid import Fineness

COARSE = Fineness(5, 3, (0.5, 2.0), (1.0,))
P2 = plate_named("P2")
MODULI = (0.4e6, 1.6e6)
