"""Tables of modes as a lab would hand them in: of plates as 3D solids, their numbers stated only nearly."""

from functools import lru_cache

import numpy as np
import scipy.linalg as la

from campaign.law import TrueLaw
from campaign.plates.geometry import plate_named
from campaign.plates.grid import Fineness
from campaign.plates.reduced import reduced
from campaign.plates.solid import Build, Solid
from campaign.plates.stated import CAREFUL, draw_stated, specimen_from, toml
from fitting.mode_tables.table import ModalTable

TRUTH = TrueLaw("fractional-zener", (0.35e6, 12e6, 4e-5, 0.62))
"""Of every plate here; the file that a fit is given names another one."""
FINE = Fineness(9, 6, (0.2, 1.0), (0.5,))
"""Within 0.1 % in f and 0.04 % in eta of twice as many bricks, in a third of the time."""


@lru_cache(maxsize=8)
def solid(name, build=None, points_m=()):
    """K_0, K_1, M of a plate of bricks on a basis of its own."""
    plate = reduced(Solid(plate_named(name), build or Build(), FINE), points_m=points_m)
    return plate.K_0, plate.whole_core, plate.M


def solid_modes(name, law=TRUTH, count=6, build=None):
    """Frequencies and loss factors, the law at each mode's own frequency, by iteration."""
    K_0, K_1, M = solid(name, build)
    found, omega = [], 500.0
    for k in range(count):
        for _ in range(60):
            values = np.sort_complex(la.eigvals(K_0 + complex(law.modulus(omega)) * K_1, M))
            before, omega = omega, float(np.sqrt(values[k].real))
            if abs(omega / before - 1) < 1e-10:
                break
        found.append((omega / (2 * np.pi), values[k].imag / values[k].real))
    return np.array(found).T


def read_off(modes, rng, f_std=1e-3, loss_std=0.03):
    """A table with noise, which it states."""
    f, eta = modes
    f_std, loss_std = f_std * f, loss_std * eta
    return ModalTable(
        np.arange(1.0, len(f) + 1),
        f + f_std * rng.standard_normal(len(f)),
        eta + loss_std * rng.standard_normal(len(f)),
        f_std,
        loss_std,
    )


def stated(name, rng):
    """The plate as its file says, within a careful lab's tolerances; without what is left of damping."""
    plate = draw_stated(rng, plate_named(name))
    text = toml(plate, CAREFUL, 150.0)
    head, _, rest = text.partition("[damping]")
    return specimen_from(head + "[pickup]" + rest.partition("[pickup]")[2])
