"""SENSORS.toml: the laboratory's sensors with their calibrations. A rig names them by serial number."""

from datetime import date
from pathlib import Path
from typing import Annotated, Literal

from pydantic import Field, model_validator

from instrument.errors import BadInput
from instrument.files.file_kind import kind_of_file, refuse_another
from instrument.files.nearest import nearest
from instrument.files.rig_file import RigDocument, SensorSection, year_after
from instrument.files.toml import NotNegative, TomlTable, read_document
from instrument.files.units import unit_of

SensorKind = Literal["accelerometer", "force", "thermometer"]
_KIND: dict[str, SensorKind] = {
    "base": "accelerometer",
    "response": "accelerometer",
    "force": "force",
    "temperature": "thermometer",
}
"""Which sensor serves a channel. The vibrometer is none: its sensitivity is its range."""
_UNITS: dict[SensorKind, str] = {"accelerometer": "acceleration", "force": "force"}
_DEGREES = ("degC", "°C", "C", "K")
_SAME = 1e-6
"""Relative difference of a number written twice."""


class Sensor(TomlTable):
    """A sensor as its calibration sheet has it."""

    serial: Annotated[str, Field(min_length=1, max_length=60)]
    kind: SensorKind
    model: str = ""
    sensitivity: Annotated[float, Field(ge=1e-6, le=1e9)]
    unit: str
    """Of the sensitivity: `mV/g`, `mV/(m/s^2)`, `mV/N`, `mV/degC`; V in place of mV too."""
    iepe: bool | None = None
    mass_g: NotNegative | None = None
    calibrated: date | None = None
    calibrated_until: date | None = None
    """Where it is not said, a year after `calibrated`."""

    @model_validator(mode="after")
    def _of_its_kind(self) -> "Sensor":
        self.mv_per_unit()
        return self

    def mv_per_unit(self) -> float:
        """Per m/s^2, N or degree. Raises `ValueError` for a unit that does not fit the kind."""
        volts, _, under = self.unit.partition("/")
        milli = {"mV": 1.0, "V": 1e3}.get(volts.strip())
        of = unit_of(under.strip())
        if milli is not None and self.kind == "thermometer" and under.strip() in _DEGREES:
            return self.sensitivity * milli
        if milli is not None and of is not None and of.per is None and of.quantity == _UNITS.get(self.kind):
            return self.sensitivity * milli / of.factor
        expected = {"accelerometer": "mV/g or mV/(m/s^2)", "force": "mV/N", "thermometer": "mV/degC"}
        raise ValueError(f"unit {self.unit!r} of {self.serial}: expected {expected[self.kind]}")

    @property
    def valid_until(self) -> date | None:
        """Last day of its calibration; None where nothing is said of one."""
        return self.calibrated_until or (year_after(self.calibrated) if self.calibrated else None)


class SensorsDocument(TomlTable):
    """SENSORS.toml."""

    sensor: Annotated[list[Sensor], Field(min_length=1, max_length=1000)]

    @model_validator(mode="after")
    def _once(self) -> "SensorsDocument":
        serials = [one.serial for one in self.sensor]
        twice = next((s for s in serials if serials.count(s) > 1), None)
        if twice is not None:
            raise ValueError(f"serial {twice!r} is there twice, expected each sensor once")
        return self


def read_sensors(path: Path) -> list[Sensor]:
    """The sensors of a file. Raises `BadInput`."""
    refuse_another(path, "a list of sensors", "a list of sensors (viscorig new sensors)")
    return read_document(path, SensorsDocument).sensor


def read_rig(path: Path) -> RigDocument:
    """A rig with what its sensors' file says of the sensors it names. Raises `BadInput`."""
    its = ", whose [simulation] may name it" if kind_of_file(path) == "a specimen" else ""
    refuse_another(path, "a rig", f"a rig{its} (viscorig new rig)")
    document = read_document(path, RigDocument)
    if document.sensors is None:
        return document
    where = path.parent / document.sensors
    known = {one.serial: one for one in read_sensors(where)}
    channels = {
        name: _with(section, name, known, path, where) for name, section in document.channels.named().items()
    }
    # What was looked up is kept with a session; the file it came from is not.
    of_rig = document.channels.model_copy(update=channels)
    return document.model_copy(update={"channels": of_rig, "sensors": None})


def _with(
    section: SensorSection, name: str, known: dict[str, Sensor], rig: Path, sensors: Path
) -> SensorSection:
    if not section.serial or name not in _KIND:
        return section
    sensor = known.get(section.serial)
    if sensor is None:
        near = nearest(section.serial, list(known))
        said = f", the nearest is {near}" if near else ""
        raise BadInput(f"{rig}: channels.{name}: serial {section.serial!r} is not in {sensors}{said}")
    if sensor.kind != _KIND[name]:
        said = f"serial {section.serial!r} is of kind {sensor.kind}, expected {_KIND[name]}"
        raise BadInput(f"{rig}: channels.{name}: {said}")
    found = {
        "sensitivity_mv_per_unit": sensor.mv_per_unit(),
        "calibrated": sensor.calibrated,
        "calibrated_until": sensor.calibrated_until,
        "iepe": sensor.iepe,
        **({"mass_g": sensor.mass_g} if "mass_g" in type(section).model_fields else {}),
    }
    found = {key: value for key, value in found.items() if value is not None}
    for key in section.model_fields_set & set(found):
        if not _same(getattr(section, key), found[key]):
            raise BadInput(
                f"{rig}: channels.{name}.{key}: {getattr(section, key)}, but {sensors} says {found[key]} of "
                f"{sensor.serial}: leave it out here, or mend one of them"
            )
    return section.model_copy(update=found)


def _same(here: object, there: object) -> bool:
    if isinstance(here, float) and isinstance(there, float):
        return abs(here - there) <= _SAME * abs(there)
    return here == there
