"""Universal files as other programs write them: data set 58, by pyuff."""

import warnings

import numpy as np
import pyuff

_CODES = {"displacement": 8, "velocity": 11, "acceleration": 12}
_FORCE = 13


def write_frf(path, frfs, *, binary=True):
    """FRFs as data set 58, double precision; uneven lines are kept as they are."""
    write_sets(path, *[_frf_set(name, frf, binary=binary) for name, frf in frfs.items()])


def write_hits(path, hits, *, binary=True, ordinate_axis_units_lab=None, further=()):
    """Each hit as its force, then its responses, then records of `further` data types."""
    labels, sets = ordinate_axis_units_lab or {}, []

    def add(name, code, samples, hit, quantity=""):
        made = _time_set(name, code, samples, hit.sample_rate_hz, binary=binary)
        sets.append(made | ({"ordinate_axis_units_lab": labels[quantity]} if quantity in labels else {}))

    for hit in hits:
        add("force", _FORCE, hit.force_n, hit, "force")
        for c in hit.responses:
            add(c.name, _CODES[c.motion], c.samples, hit, c.motion)
        for code in further:
            add("tacho", code, hit.force_n, hit)
    write_sets(path, *sets)


def ratio_set(frequency_hz, data, over, under):
    """One spectrum over another, by their codes: 8 displacement, 11 velocity, 12 acceleration, 13 force."""
    return _common("NONE", binary=True) | {
        "func_type": 4,
        "abscissa_spacing": 0,
        "abscissa_min": 0.0,
        "abscissa_inc": 0.0,
        "abscissa_spec_data_type": 18,
        "ordinate_spec_data_type": over,
        "orddenom_spec_data_type": under,
        "data": np.asarray(data),
        "x": frequency_hz,
    }


def write_sets(path, *sets):
    """Instead of what was there."""
    path.unlink(missing_ok=True)
    # The library's "overwrite" wipes a binary set's header; closing its file it leaves to the collector.
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ResourceWarning)
        pyuff.UFF(str(path)).write_sets(list(sets), mode="add")


def _frf_set(name, frf, *, binary):
    steps = np.diff(frf.frequency_hz)
    even = bool(np.allclose(steps, steps[0], rtol=1e-9))
    return _common(name, binary=binary) | {
        "func_type": 4,
        "ord_data_type": 6,
        "abscissa_spacing": 1 if even else 0,
        "num_pts": len(frf.frequency_hz),
        "abscissa_min": float(frf.frequency_hz[0]),
        "abscissa_inc": float(steps[0]) if even else 0.0,
        "abscissa_spec_data_type": 18,
        "ordinate_spec_data_type": _CODES[frf.motion],
        "orddenom_spec_data_type": _FORCE,
        "data": frf.H,
        "x": frf.frequency_hz,
    }


def _time_set(name, code, samples, rate, *, binary):
    return _common(name, binary=binary) | {
        "func_type": 1,
        "ord_data_type": 4,
        "abscissa_spacing": 1,
        "num_pts": len(samples),
        "abscissa_min": 0.0,
        "abscissa_inc": float(1 / rate),
        "abscissa_spec_data_type": 17,
        "ordinate_spec_data_type": code,
        "orddenom_spec_data_type": 0,
        "data": np.asarray(samples, float),
        "x": np.arange(len(samples)) / rate,
    }


def _common(name, *, binary):
    return {
        "type": 58,
        "binary": int(binary),
        "id1": name,
        "id2": "NONE",
        "id3": "NONE",
        "id4": "NONE",
        "id5": "NONE",
        "rsp_node": 1,
        "rsp_dir": 3,
        "ref_node": 1,
        "ref_dir": 3,
        "z_axis_value": 0.0,
    }
