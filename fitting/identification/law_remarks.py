"""What the values of a law say by themselves: a wrong sign or unit, or that the data hardly feel the core."""

import numpy as np

from fitting.arrays import Array

CORE_PA = (1e4, 2e8)
"""G' of what is used as a core: soft gels and foams have 10 kPa, rubbers 0.3 to 10 MPa, damping polymers to
some 100 MPa in their transition, where they damp; a glass of 1 GPa does not (the data sheets in Nashif, Jones
and Henderson, Vibration Damping, 1985). What lies outside is nearly always a wrong unit."""
_LARGE, _MOST = 0.3, 9.0
"""Of a value, from which its standard error is one of its logarithm alone: 1.3 up is not 0.3 down."""


def gain_of_energy(frequency_hz: Array, loss_factor: Array) -> list[str]:
    """A line where the loss factor is negative. Shape (frequencies,) each."""
    k = int(np.argmin(loss_factor))
    if not loss_factor[k] < 0:
        return []
    return [
        f"the loss factor is negative ({loss_factor[k]:.2g} at {frequency_hz[k]:.3g} Hz), which no "
        "material has by itself: are phases those of e^{+i omega t}, and do both channels read alike?"
    ]


def beyond_cores(storage_modulus_pa: Array) -> list[str]:
    """A line where G' is outside `CORE_PA` at most frequencies. Shape (frequencies,)."""
    (low, high), storage = CORE_PA, storage_modulus_pa
    if low <= np.median(storage) <= high:
        return []
    return [
        f"G' is {1e-6 * storage.min():.3g} to {1e-6 * storage.max():.3g} MPa; cores have {1e-6 * low:g} to "
        f"{1e-6 * high:g} MPa: are frequencies in Hz, accelerations in m/s^2, masses in kg, thicknesses in "
        "mm, areas in mm^2, and all discs counted?"
    ]


def hardly_known(name: str, frequency_hz: Array, value: Array, standard_error: Array) -> list[str]:
    """A line where errors are no longer small parts of a value. Shape (frequencies,) each.

    The data say next to nothing of the core there.
    """
    share = np.nan_to_num(standard_error / np.abs(value))
    k = int(np.argmax(share))
    if not share[k] > _LARGE:
        return []
    return [
        f"{name} is known within a factor of {np.exp(min(share[k], _MOST)):.2g} only at "
        f"{frequency_hz[k]:.3g} Hz: an error as large is one of its logarithm, take the "
        "interval by --uncertainty profile; the readings hardly feel the core there"
    ]
