"""What is known of a measured point: each quantity once, with its names, its unit and how it is read.

The session file, the sweep CSV that is exported and read again, the .mat file, the report's table and the
window's record are views of `COLUMNS`: a quantity added there is in all of them. In the report and the record
it goes to the end, unless `_REPORT` or `_RECORD` gives it a place.
"""

from instrument.files.acceleration import acceleration_unit
from instrument.files.column import (
    Column,
    ColumnPoint,
    ShownQuantity,
    each,
    number,
    numbers,
    plain,
    reading_std_m_s,
    said,
    texts,
    told,
)


def _level(row: ColumnPoint) -> str:
    return acceleration_unit().said(row.point.level_m_s2)


def _both(value: complex, unit: str) -> str:
    return f"{value.real:.5g}, {value.imag:.5g} {unit}"


def _base(row: ColumnPoint) -> str:
    shown = acceleration_unit()
    return _both(row.point.base_m_s2 / shown.m_s2, shown.symbol)


def _spot(row: ColumnPoint) -> str:
    at = row.point.spot_mm
    return f"{row.point.pickup}" + (f" at {at[0]:g}, {at[1]:g} mm" if at is not None else "")


def _place(row: ColumnPoint) -> str:
    p = row.point
    return "sentinel" if p.purpose == "sentinel" else f"{p.segment}, {p.sweep}"


_PHASOR = "Phasor of e^{+i omega t}, zero to peak, time from the acquisition's first sample"
_NOISE = "Standard deviation of each part of the phasor"
_DISTORTION = "Root sum of squares of the harmonics over the fundamental"
_READ_TIP = "Zero to peak; gain and delay of the calibration are taken off"

COLUMNS: tuple[Column, ...] = (
    Column("sweep", "1", numbers("sweep"), "sweep", "if known", whole=True, identity=True, unsaid=1.0),
    Column(
        "segment",
        "1",
        numbers("segment"),
        "segment",
        "if known",
        whole=True,
        identity=True,
        report=ShownQuantity("segment, pass", _place),
        record=ShownQuantity("Segment, pass", lambda r: f"{r.point.segment}, {r.point.sweep}"),
    ),
    Column(
        "level_g",
        "1",
        each(lambda r: r.point.level_m_s2 / r.reference_m_s2),
        "",
        "if known",
        above_zero=True,
        identity=True,
        unsaid=1.0,
    ),
    Column(
        "level_m_s2",
        "m/s^2",
        field="level_m_s2",
        report=ShownQuantity(
            "level", lambda r: f"{acceleration_unit().of(r.point.level_m_s2):.4g}", acceleration=True
        ),
        record=ShownQuantity("Level asked for", _level),
    ),
    Column(
        "time_s",
        "s",
        each(lambda r: r.time_s - r.first_s),
        "",
        "if known",
        identity=True,
        record=ShownQuantity("Time", lambda r: f"{r.time_s:.2f} s", "Since the session's first sample"),
    ),
    plain(
        "frequency_hz",
        "Hz",
        given="always",
        above_zero=True,
        identity=True,
        report=ShownQuantity("f / Hz", lambda r: f"{r.point.frequency_hz:g}"),
        record=said("Frequency", "frequency_hz", ".7g", " Hz"),
    ),
    plain(
        "velocity_re_m_s",
        "m/s",
        given="velocity",
        record=ShownQuantity("Velocity re, im", lambda r: _both(1e3 * r.point.velocity_m_s, "mm/s"), _PHASOR),
    ),
    plain("velocity_im_m_s", "m/s", given="velocity"),
    Column(
        "velocity_m_s",
        "m/s",
        given="velocity",
        above_zero=True,
        report=ShownQuantity("|v| / (m/s)", lambda r: f"{abs(r.point.velocity_m_s):.5g}"),
        record=ShownQuantity("Velocity", lambda r: f"{abs(1e3 * r.point.velocity_m_s):.5g} mm/s", _READ_TIP),
    ),
    Column("acceleration_re_m_s2", "m/s^2", given="velocity"),
    Column("acceleration_im_m_s2", "m/s^2", given="velocity"),
    Column("displacement_re_m", "m", given="velocity"),
    Column("displacement_im_m", "m", given="velocity"),
    plain(
        "base_accel_re_m_s2",
        "m/s^2",
        given="if known",
        record=ShownQuantity("Base re, im", _base, _PHASOR),
    ),
    plain("base_accel_im_m_s2", "m/s^2", given="if known"),
    Column(
        "pickup",
        "1",
        numbers("pickup"),
        "pickup",
        "if known",
        whole=True,
        identity=True,
        record=ShownQuantity("Spot", _spot, "0 is the specimen file's own"),
    ),
    plain("mass_kg", "kg", record=said("Known mass", "mass_kg", ".4g", " g", "Put on the plate", 1e3)),
    plain("mounting", "1", whole=True, record=said("Clamped anew", "mounting", ".0f", " times")),
    Column("force_re_n", "N", given="if known"),
    Column("force_im_n", "N", given="if known"),
    Column(
        "base_accel_m_s2",
        "m/s^2",
        record=ShownQuantity(
            "Base acceleration",
            lambda r: acceleration_unit().said(abs(r.point.base_m_s2), ".5g"),
            "Zero to peak, of the fundamental",
        ),
    ),
    Column(
        "base_accel_std_m_s2",
        "m/s^2",
        field="base_accel_std_m_s2",
        record=ShownQuantity(
            "Base noise", lambda r: acceleration_unit().said(r.point.base_accel_std_m_s2, ".2g"), _NOISE
        ),
    ),
    Column(
        "velocity_std_m_s",
        "m/s",
        lambda rows: reading_std_m_s([r.point for r in rows]),
        "velocity_std_m_s",
        "if known",
        above_zero=True,
        report=ShownQuantity(
            "noise / %",
            lambda r: number(100 * r.point.velocity_std_m_s / abs(r.point.velocity_m_s), ".2g", nothing="-"),
        ),
        record=said("Velocity noise", "velocity_std_m_s", ".2g", " mm/s", _NOISE, 1e3),
    ),
    Column("weight", "1", given="if known", above_zero=True),
    plain(
        "step",
        "1",
        report=told("step", "step", ""),
        record=ShownQuantity("Step", lambda r: f"{r.point.step} ({r.point.purpose})"),
    ),
    Column("purpose", "", texts(lambda p: p.purpose)),
    Column(
        "sample",
        "1",
        field="sample",
        record=said("First sample", "sample", "", tip="Of the dwell, in its acquisition"),
    ),
    plain(
        "settle_s",
        "s",
        report=told("settling / s", "settle_s", ".2f"),
        record=said(
            "Settling", "settle_s", ".3g", " s", "From the last change of drive until it was at rest"
        ),
    ),
    plain(
        "dwell_s",
        "s",
        report=told("dwell / s", "dwell_s", ".2f"),
        record=said("Dwell", "dwell_s", ".3g", " s", "Length of the reading"),
    ),
    plain("drive_v", "V", record=said("Drive", "drive_v", ".4g", " V")),
    plain(
        "control_error_percent",
        "%",
        report=told("control / %", "control_error_percent", "+z.2f"),
        record=ShownQuantity(
            "Level error",
            lambda r: f"{r.point.control_error_percent:+z.3f} % (\u00b1{r.tolerance_percent:g} %)",
        ),
    ),
    plain(
        "base_distortion_percent",
        "%",
        record=said("Base distortion", "base_distortion_percent", ".2g", " %", _DISTORTION),
    ),
    plain(
        "velocity_distortion_percent",
        "%",
        report=told("distortion / %", "velocity_distortion_percent", ".2g"),
        record=said("Velocity distortion", "velocity_distortion_percent", ".2g", " %", _DISTORTION),
    ),
    Column(
        "range",
        "",
        texts(lambda p: p.range_name),
        report=ShownQuantity("range", lambda r: r.point.range_name),
        record=ShownQuantity("Range", lambda r: r.point.range_name, "Of the vibrometer"),
    ),
    plain(
        "signal_level",
        "1",
        record=said("Light", "signal_level", ".2f", tip="That came back to the vibrometer, 0 to 1"),
    ),
    plain("temperature_c", "degC", record=said("Temperature", "temperature_c", ".2f", " \u00b0C")),
    Column("remarks", "", texts(lambda p: "; ".join(p.remarks))),
)
"""In the order of the exported file."""

_REPORT = (
    *("step", "segment", "frequency_hz", "level_m_s2", "velocity_m_s", "velocity_std_m_s"),
    *("control_error_percent", "velocity_distortion_percent", "settle_s", "dwell_s", "range"),
)
_RECORD = (
    *("frequency_hz", "level_m_s2", "base_accel_m_s2", "control_error_percent", "base_accel_re_m_s2"),
    *("base_accel_std_m_s2", "base_distortion_percent", "drive_v", "velocity_m_s", "velocity_re_m_s"),
    *("velocity_std_m_s", "velocity_distortion_percent", "range", "signal_level", "settle_s", "dwell_s"),
    *("temperature_c", "time_s", "sample", "step", "segment"),
)


def exported() -> list[Column]:
    """Columns of the sweep CSV and the .mat file."""
    return [c for c in COLUMNS if c.read is not None]


def stored() -> list[Column]:
    """Numbers in the session file's `/points`."""
    return [c for c in COLUMNS if c.field]


def understood() -> list[Column]:
    """Columns that mean something in a sweep CSV that is read; others are kept as they stand."""
    return [c for c in COLUMNS if c.given != "kept"]


def in_report() -> list[tuple[Column, ShownQuantity]]:
    """Columns of the report's table."""
    return [(c, c.report) for c in _placed(_REPORT) if c.report is not None]


def in_record() -> list[tuple[Column, ShownQuantity]]:
    """Lines of the window's record."""
    return [(c, c.record) for c in _placed(_RECORD) if c.record is not None]


def _placed(order: tuple[str, ...]) -> list[Column]:
    return sorted(COLUMNS, key=lambda c: order.index(c.name) if c.name in order else len(order))
