"""What was measured with what: specimen, rig, sensors, mounting, versions."""

from datetime import date

from fitting.specimen import Kind
from instrument.files.acceleration import acceleration_unit
from instrument.files.rig_file import ResponseSection, SensorSection
from instrument.files.specimen_file import SpecimenDocument
from instrument.files.structure_file import AnyDocument
from instrument.remarks.tolerance_words import tolerance_rows
from instrument.report.blocks import Block, FactsBlock, FigureBlock, ReportSection, Sentence, TableBlock
from instrument.results.numbers import format_number
from instrument.results.sketch import Mark, sketch_of
from instrument.results.sketch_figure import sketch_figure
from instrument.results.typeset import quantity
from instrument.session.contents import Contents
from instrument.stream.raw import OperatorDid

_ACCELEROMETERS = ("base", "response")
_OTHERS = {"force": "mV/N", "temperature": "mV/°C"}
_MOST_LISTED = 8
_TITLES: dict[Kind, str] = {"plate": "Plate", "beam": "Beam", "shear-pair": "Shear pair"}
_DONE = {
    ("mounted", "bare"): "bare {} mounted",
    ("mounted", "damped"): "damped {} mounted",
    ("aimed", "base"): "laser pointed at the base",
    ("aimed", "pickup"): "laser pointed at the spot",
}
_LAYERS = ("substrate", "core", "constraining")


def specimen_section(contents: Contents) -> ReportSection:
    """Geometry, layers, the law identification starts from."""
    s = contents.configuration.specimen
    geometry = FactsBlock(_TITLES[contents.specimen.kind], tuple(_geometry(contents, s)))
    drawn = FigureBlock(
        sketch_figure(sketch_of(contents.specimen, _of_hammer(contents))), "The specimen to scale"
    )
    blocks: list[Block] = [drawn, _layers(s), geometry]
    if s.core is not None:
        rows = [(quantity(k), _law_value(v)) for k, v in s.core.law.items()]
        blocks.append(FactsBlock("Core law to start from", tuple(rows)))
    blocks.append(FactsBlock("Tolerances (one standard deviation)", tuple(tolerance_rows(contents.specimen))))
    return ReportSection("Specimen", tuple(blocks))


def _of_hammer(contents: Contents) -> tuple[Mark, ...]:
    hammer = contents.configuration.experiment.hammer
    if hammer is None:
        return ()
    return (
        Mark(hammer.hit_x_mm, hammer.hit_y_mm, "hit", "hit"),
        Mark(hammer.response_x_mm, hammer.response_y_mm, "accelerometer", "sensor"),
    )


def _law_value(value: object) -> str:
    if isinstance(value, list) and len(value) > _MOST_LISTED:
        return f"{len(value)} values, {min(value):g} to {max(value):g}"
    return str(value)


def _layers(s: AnyDocument) -> TableBlock:
    rows = []
    for name in _LAYERS:
        layer = getattr(s, name, None)
        if layer is not None:
            thickness = layer if hasattr(layer, "thickness_mm") else getattr(s, "pair", None)
            numbers = (
                getattr(thickness, "thickness_mm", None),
                *(
                    getattr(layer, key, None)
                    for key in ("young_gpa", "poisson", "density_kg_m3", "loss_factor")
                ),
            )
            rows.append((name, *(format_number(v, 6) for v in numbers)))
    columns = ("layer", "thickness / mm", "E / GPa", "Poisson's ratio", "density / (kg/m³)", "loss factor")
    return TableBlock("Layers", columns, tuple(rows))


def _geometry(contents: Contents, s: AnyDocument) -> list[tuple[str, str]]:
    if isinstance(s, SpecimenDocument):
        return _plate(contents, s)
    rows = [(name.replace("_", " "), _law_value(value)) for name, value in s.geometry.items()]
    return [*rows, ("velocity", contents.configuration.rig.vibrometer.reads)]


def _plate(contents: Contents, s: SpecimenDocument) -> list[tuple[str, str]]:
    reads = contents.configuration.rig.vibrometer.reads
    rows = [
        ("length x width", f"{s.plate.length_mm:g} x {s.plate.width_mm:g} mm"),
        ("boundary", s.plate.boundary),
    ]
    if s.pickup is not None:
        rows.append(("pickup", f"x = {s.pickup.x_mm:g} mm, y = {s.pickup.y_mm:g} mm; velocity {reads}"))
    if s.damping is not None:
        rows.append(("stated modal damping", ", ".join(f"{p:g}" for p in s.damping.modal_percent) + " %"))
    return rows


def rig_section(contents: Contents) -> ReportSection:
    """Instruments as they name themselves, sensors, mounting."""
    c = contents.configuration
    m = c.experiment.mounting
    mounting = [
        ("bolts", str(m.bolts) if m.bolts else "not stated"),
        ("torque", f"{m.torque_n_m:g} N m" if m.torque_n_m else "not stated"),
        ("remounted", f"{m.remount} times" if m.remount != 1 else "once"),
    ]
    kind = contents.specimen.kind.replace("-", " ")
    mounting += [("by hand", _done(did, kind)) for did in contents.operator if not did.hit]
    instruments: Block = Sentence("The session holds no instrument's identity.", "note")
    if contents.began:
        named = {**contents.began[-1].instruments, "sampled at": _rates(contents)}
        named |= {"vibrometer's model in the rig file": c.rig.vibrometer.model_name}
        rows = tuple((k.replace("_", " "), v) for k, v in named.items() if v)
        instruments = FactsBlock(f"Instruments of {c.rig.name!r}", rows)
    blocks = (instruments, _sensors(contents), FactsBlock("Mounting", tuple(mounting)))
    return ReportSection("Rig", (*blocks, *_temperature(contents)))


def _done(did: OperatorDid, kind: str) -> str:
    """What a person did at the rig, a specimen of some kind on it."""
    named = _DONE.get((did.what, did.detail), f"{did.what} {did.detail}".strip())
    return named.replace("{}", kind)


def _temperature(contents: Contents) -> tuple[Block, ...]:
    """What was asked of the chamber, and what it or the thermometer read."""
    asked, read = contents.configuration.experiment.temperature, contents.temperatures
    rows = []
    if asked is not None:
        rows.append(("set point", f"{asked.set_point_c:g} °C, within {asked.within_c:g} °C"))
        rows += [("soaked", f"{s.seconds:.0f} s, the last {asked.soak_s:g} s within") for s in contents.soaks]
    if read:
        values = [r.value_c for r in read]
        rows.append(("before the steps", f"{min(values):.2f} to {max(values):.2f} °C, {len(read)} readings"))
        analog = contents.configuration.rig.channels.temperature is not None
        source = "the front-end's channel" if analog else "the reading before it"
        rows.append(("a point's temperature", source))
    return (FactsBlock("Temperature", tuple(rows)),) if rows else ()


def _rates(contents: Contents) -> str:
    rates = {"sweep": contents.sample_rate_hz, "hammer test": contents.hammer_rate_hz}
    return ", ".join(f"{rate:g} Hz ({part})" for part, rate in rates.items() if rate is not None)


def _sensors(contents: Contents) -> TableBlock:
    measured = date.fromisoformat(contents.configuration.created_utc[:10])
    rows = [_sensor(name, s, measured) for name, s in contents.configuration.rig.channels.named().items()]
    columns = ("channel", "input", "sensitivity", "range / V", "IEPE", "inverted", "serial", "calibrated")
    return TableBlock("Sensors", columns, tuple(rows))


def _sensor(name: str, s: SensorSection, measured: date) -> tuple[str, ...]:
    sensitivity = _sensitivity(name, s)
    mass = f" ({s.mass_g:g} g)" if isinstance(s, ResponseSection) and s.mass_g else ""
    return (
        name + mass,
        str(s.input),
        sensitivity,
        f"{s.range_v:g}",
        "yes" if s.iepe else "no",
        "yes" if s.invert else "no",
        s.serial or "not stated",
        _calibrated(s, measured),
    )


def _sensitivity(name: str, s: SensorSection) -> str:
    if name in _ACCELEROMETERS:
        shown = acceleration_unit()
        return f"{s.sensitivity_mv_per_unit * shown.m_s2:.6g} mV/{shown.under}"
    unit = _OTHERS.get(name)
    return f"{s.sensitivity_mv_per_unit:g} {unit}" if unit else "by the vibrometer's range"


def _calibrated(s: SensorSection, measured: date) -> str:
    until = s.valid_until
    expired = f"expired {until.isoformat()}" if until is not None and until < measured else ""
    said = s.calibrated.isoformat() if s.calibrated is not None else "not stated"
    return f"{said}, {expired}" if expired else said


def versions_section(contents: Contents, now: dict[str, str]) -> ReportSection:
    """Of the run, and of the program that wrote this page."""
    recorded = contents.configuration.versions
    names = list(dict.fromkeys([*recorded, *now]))
    rows = tuple((n, recorded.get(n, "-"), now.get(n, "-")) for n in names)
    return ReportSection("Versions", (TableBlock("", ("package", "at the run", "of this page"), rows),))
