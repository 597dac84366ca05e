"""The Polytec vibrometers known by name: what is true of a model and not asked of the device.

Whatever was not seen in a manual, in public source or on a device stands here, marked, and nowhere else.
"""

from dataclasses import dataclass

from drivers.errors import Refused
from drivers.vibrometer.interface import Range


@dataclass(frozen=True)
class PolytecModel:
    """One controller with one velocity decoder."""

    name: str
    controller: str
    """As `GetDevInfo,Controller,0,Name` spells it."""
    decoder: str
    """As `Get,VeloDec,<index>,Name` spells it."""
    ranges: tuple[Range, ...]
    """From the most sensitive to the coarsest."""
    signal_level_full: int
    """The integer of a full bar. From memory for every model."""

    def range_named(self, name: str) -> Range:
        """Raises `Refused`, naming the ranges there are."""
        for one in self.ranges:
            if one.name == name:
                return one
        raise Refused(f"{self.name} has no range {name!r}: it has {', '.join(r.name for r in self.ranges)}")


def model_named(name: str) -> PolytecModel:
    """Raises `Refused`, naming the models there are."""
    if name not in MODELS:
        raise Refused(f"no vibrometer model {name!r}: known are {', '.join(MODELS)}")
    return MODELS[name]


def _ranges(rows: tuple[tuple[str, float, float, float], ...], full_scale_v: float) -> tuple[Range, ...]:
    """Rows of name, m/s/V and highest Hz; the second Hz is that of the LP variant, 0 where there is none.

    Names and scales are seen in public source; full scale and highest frequencies are from memory, so none of
    these counts as verified. The device states its highest frequency and delay itself.
    """
    wide = [Range(name, scale, full_scale_v, hz, None, False) for name, scale, hz, _ in rows]
    low_pass = [
        Range(f"{name} LP", scale, full_scale_v, lp, None, False) for name, scale, _, lp in rows if lp
    ]
    return tuple(sorted(wide + low_pass, key=lambda r: r.scale_m_s_v))


_VD_08 = _ranges(
    (
        ("0.2mm/s/V", 0.2e-3, 25e3, 0),
        ("0.5mm/s/V", 0.5e-3, 25e3, 0),
        ("1mm/s/V", 1e-3, 25e3, 0),
        ("2mm/s/V", 2e-3, 25e3, 0),
        ("5mm/s/V", 5e-3, 25e3, 0),
        ("10mm/s/V", 10e-3, 25e3, 0),
        ("20mm/s/V", 20e-3, 25e3, 0),
        ("50mm/s/V", 50e-3, 25e3, 0),
    ),
    full_scale_v=10.0,
)

_VD_09 = _ranges(
    (
        ("5mm/s/V", 5e-3, 20e3, 0),
        ("10mm/s/V", 10e-3, 20e3, 0),
        ("20mm/s/V", 20e-3, 1e6, 100e3),
        ("50mm/s/V", 50e-3, 1.5e6, 100e3),
        ("100mm/s/V", 100e-3, 1.5e6, 100e3),
        ("200mm/s/V", 200e-3, 2.5e6, 100e3),
        ("500mm/s/V", 500e-3, 2.5e6, 100e3),
        ("1m/s/V", 1.0, 2.5e6, 100e3),
    ),
    full_scale_v=10.0,
)

# 1.1 ms at the 22 kHz low-pass: 40 degrees at 100 Hz, so a phase without calibration is worthless.
_PDV_100 = (
    Range("5mm/s/V", 5e-3, 4.0, 22e3, 1.1e-3, verified=True),
    Range("25mm/s/V", 25e-3, 4.0, 22e3, 1.1e-3, verified=False),
    Range("125mm/s/V", 125e-3, 4.0, 22e3, 1.1e-3, verified=False),
)

_OFV = "OFV-5000 Vibrometer Controller"

MODELS = {
    model.name: model
    for model in (
        PolytecModel("OFV-5000", _OFV, "VD-09", _VD_09, 512),
        PolytecModel("OFV-5000 VD-08", _OFV, "VD-08", _VD_08, 512),
        # Its serial language was not seen in public: the OFV-5000's is assumed.
        PolytecModel("PDV-100", "PDV-100", "PDV-100", _PDV_100, 512),
    )
}
