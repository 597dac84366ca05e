"""Sweeps and records as other programs write them."""

import numpy as np
from uff_files import ratio_set

from instrument.files.sweep_file import read_sweep
from instrument.interchange.importing import import_file

F = np.array([15.0, 18.5, 20.0, 21.0, 30.0])
V = np.array([0.1 + 0.02j, 0.2 - 0.1j, -0.05 - 0.3j, -0.1j, 0.02 + 0.01j])
BASE = np.full(5, 4.0 + 1.0j)
RATIO = V / BASE


def sweep_of(path, out):
    import_file(path, out)
    return read_sweep(out)


def over_base(columns):
    v = columns["velocity_re_m_s"] + 1j * columns["velocity_im_m_s"]
    return v / (columns["base_accel_re_m_s2"] + 1j * columns["base_accel_im_m_s2"])


def frf_set(data, over, under, **more):
    return ratio_set(F, data, over, under) | more


def time_set(data, code, **more):
    x = np.arange(len(data)) / 1000.0
    return frf_set(data, code, 0, x=x, func_type=1, abscissa_spacing=1, abscissa_spec_data_type=17) | more


def lms(values, label, x_label="Hz", start=10.0, step=0.5):
    """A function as LMS Test.Lab exports it."""
    return {
        "x_values": {
            "start_value": start,
            "increment": step,
            "number_of_values": float(len(values)),
            "quantity": {"label": x_label},
        },
        "y_values": {"values": values, "quantity": {"label": label}},
        "function_record": {"type": "FRF"},
    }
