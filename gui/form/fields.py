"""What a form asks for, read off a model. No Qt."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from types import NoneType, UnionType
from typing import Annotated, Any, Literal, Union, get_args, get_origin

from pydantic import BaseModel
from pydantic.fields import FieldInfo
from pydantic_core import PydanticUndefined

from drivers.options import DeviceOptions
from fitting.laws import LAWS
from fitting.laws.base import Quantity
from fitting.laws.table import Tabulated
from gui.form.labels import LABELS
from instrument.facts.docstrings import docstrings_of
from instrument.files.devices import DEVICES, options_of
from instrument.files.law_table import COLUMNS
from instrument.files.new_file import SPECIMENS
from instrument.files.specimen_file import TolerancesSection, typical_tolerances

Place = tuple[str | int, ...]
"""Where a value stands in a file: keys, and numbers of tables in a list."""
Kind = Literal["number", "whole", "text", "choice", "switch", "numbers", "toml", "file"]
Off = Literal["never", "left out", "false"]
"""How a file says that it has no such table."""

_UNITS = {
    "_mv_per_unit": "mV a unit", "_m_s2": "m/s²", "_m_s": "m/s", "_kg_m3": "kg/m³", "_n_m": "N m",
    "_us": "µs", "_deg": "°",
    "_percent": "%", "_gpa": "GPa", "_mpa": "MPa", "_rad_s": "rad/s", "_mm": "mm", "_hz": "Hz", "_kg": "kg",
    "_c": "°C", "_s": "s", "_g": "g", "_v": "V", "_m": "m",
}  # fmt: skip
_NOT_ASKED = {"effects", "core", "log", "specimen", "memory"}
"""Of a simulated rig: what it hides is not for whoever measures on it."""
_NOT_SHOWN = {"further_pickups", "mass"}
"""What a document holds of `[[pickup]]` after the first, no key of a file; and masses put on for one sweep,
which stay as the file has them."""
FILES = {
    "specimen": "Specimen (*.toml)",
    "rig": "Rig (*.toml)",
    "sensors": "Sensors (*.toml)",
    "path": "Table (*.csv)",
}
"""Keys whose value is the name of a file, and of which kind."""


@dataclass(frozen=True)
class Field:
    """One value."""

    key: str
    kind: Kind
    needed: bool = False
    default: str = ""
    """What counts where it is left out."""
    choices: tuple[str, ...] = ()
    tip: str = ""

    @property
    def unit(self) -> str:
        """As the key's ending says."""
        return next((unit for ending, unit in _UNITS.items() if self.key.endswith(ending)), "")

    @property
    def label(self) -> str:
        """For people; where nobody has said better, the key without its unit."""
        if self.key in LABELS:
            return LABELS[self.key]
        ending = next((ending for ending in _UNITS if self.key.endswith(ending)), "")
        return (self.key.removesuffix(ending) or self.key).replace("_", " ")


@dataclass(frozen=True)
class FormSection:
    """A table of the file, or a list of tables."""

    key: str
    tip: str
    fields: tuple[Field, ...]
    sections: tuple["FormSection", ...] = ()
    off: Off = "never"
    repeated: bool = False

    @property
    def label(self) -> str:
        """Its key in words."""
        return self.key.replace("_", " ")


def section_of(
    model: type[BaseModel],
    key: str = "",
    off: Off = "never",
    *,
    repeated: bool = False,
    default: object = None,
) -> FormSection:
    """All that the model of a file, or of a table in it, asks for; `default` counts where it is left out."""
    schema, said = model.model_json_schema()["properties"], docstrings_of(model)
    fields: list[Field] = []
    sections: list[FormSection] = []
    for field_name, info in model.model_fields.items():
        name = info.alias or field_name
        if model.__name__ == "Simulation" and name in _NOT_ASKED:
            continue
        if name in _NOT_SHOWN:
            continue
        table = _table_in(info.annotation)
        if table is not None:
            is_list = get_origin(_plain(info.annotation)) is list
            counts = info.get_default(call_default_factory=True)
            inner = section_of(table, name, _off(info), repeated=is_list, default=counts)
            sections.append(_device(inner) if issubclass(table, DeviceOptions) else inner)
        elif (name, info.annotation) == ("law", dict[str, Any]):
            sections.append(FormSection("law", "How the core's modulus depends on frequency.", (law_kind(),)))
        else:
            counts = getattr(default, field_name, info.get_default(call_default_factory=True))
            fields.append(_field(name, info, schema[name], counts, said.get(field_name)))
    return FormSection(key, _first_line(model), tuple(fields), tuple(sections), off, repeated)


def form_of(model: type[BaseModel]) -> FormSection:
    """What the form of a file asks for: of `[tolerances]` what its specimen has, typical ones shown."""
    whole = section_of(model)
    kind = next((section.key for section in whole.sections if section.key in SPECIMENS), None)
    if kind is None:
        return whole
    typical = typical_tolerances(kind)
    sections = (_narrowed(s, typical) if s.key == "tolerances" else s for s in whole.sections)
    return replace(whole, sections=tuple(sections))


def _narrowed(tolerances: FormSection, typical: Mapping[str, float | None]) -> FormSection:
    fields = []
    for field in tolerances.fields:
        if field.key in typical:
            counts = typical[field.key]
            fields.append(replace(field, default="" if counts is None else f"{counts:g}"))
        elif not any(field.key == key for key in TolerancesSection.model_fields) or field.key == "exact":
            fields.append(field)
    return replace(tolerances, fields=tuple(fields))


def law_kind() -> Field:
    """Which law; it decides what else is asked."""
    return Field("kind", "choice", needed=True, choices=tuple(sorted(LAWS)), tip="The law of the core.")


def _device(section: FormSection) -> FormSection:
    """What is asked of every device; its kind, one of those there are, decides what else."""
    kinds = tuple(sorted(DEVICES[section.key]))
    fields = (replace(f, kind="choice", choices=kinds) if f.key == "kind" else f for f in section.fields)
    return replace(section, fields=tuple(fields))


def device_fields(section: FormSection, kind: object) -> tuple[Field, ...]:
    """What the driver of this kind asks for beside what `section` does; nothing where it is no device's."""
    options = options_of(section.key, kind) if section.key in DEVICES else None
    if options is None:
        return ()
    asked = {field.key for field in section.fields}
    return tuple(field for field in section_of(options, section.key).fields if field.key not in asked)


def law_fields(kind: object) -> tuple[Field, ...]:
    """What a law of this kind asks for; nothing where there is none."""
    law = LAWS.get(kind) if isinstance(kind, str) else None
    if law is None:
        return ()
    if law is Tabulated:
        tip = f"A CSV with {', '.join(COLUMNS)}, or a material card; relative to this file."
        return (Field("path", "file", needed=True, tip=tip),)
    return tuple(
        Field(
            field.file_key,
            "number" if law.__annotations__[name] in (float, "float") else "numbers",
            needed=True,
            tip=_law_range(field) if isinstance(field, Quantity) else "",
        )
        for name, field in law.file_fields().items()
    )


def _field(name: str, info: FieldInfo, schema: dict[str, Any], default: object, said: str | None) -> Field:
    options = [o for o in schema.get("anyOf", [schema]) if o.get("type") != "null"]
    choices = tuple(
        str(c) for o in options for c in (*o.get("enum", ()), *([o["const"]] if "const" in o else ()))
    )
    kind = _kind(options, choices)
    if kind == "text" and name in FILES:
        kind = "file"
    if kind == "switch" and default is None:
        # A file that does not say so says no.
        default = False
    return Field(
        name,
        kind,
        info.is_required(),
        "" if default is PydanticUndefined else shown(default),
        choices if kind == "choice" else (),
        " ".join(filter(None, (info.description or said, _range(options)))),
    )


def _kind(options: list[dict[str, Any]], choices: tuple[str, ...]) -> Kind:
    types = {str(o.get("type", "")) for o in options}
    if choices and types <= {"string"}:
        return "choice"
    if "boolean" in types:
        return "switch"
    if "integer" in types:
        return "whole"
    if "number" in types:
        return "number"
    if "array" in types:
        return "numbers"
    return "toml" if "object" in types or any(o.get("format") == "date" for o in options) else "text"


def shown(value: object) -> str:
    """A value as a form shows it."""
    if value is None or value == {}:
        return ""
    if isinstance(value, list):
        return ", ".join(shown(one) for one in value)
    if isinstance(value, bool):
        return "yes" if value else "no"
    return f"{value:g}" if isinstance(value, float) else str(value)


def _range(options: list[dict[str, Any]]) -> str:
    said = []
    for option in options:
        if option.get("type") == "array":
            said.append(_range([option.get("items", {})]))
            if option.get("minItems") is not None and option.get("minItems") == option.get("maxItems"):
                said.append(f"{option['minItems']} numbers, a comma between them.")
        low, under = option.get("minimum"), option.get("exclusiveMinimum")
        high, over = option.get("maximum"), option.get("exclusiveMaximum")
        # A limit that only keeps nonsense out tells nobody anything.
        high = None if high is not None and high >= 1e9 else high
        words = [
            f"{word} {limit:g}"
            for word, limit in (("at least", low), ("above", under), ("at most", high), ("below", over))
            if limit is not None
        ]
        said.append(f"{', '.join(words).capitalize()}." if words else "")
        said.append(f"Or {option['const']}." if "const" in option and len(options) > 1 else "")
    return " ".join(filter(None, said))


def _law_range(quantity: Quantity) -> str:
    low, high = quantity.lower / quantity.to_si, quantity.upper / quantity.to_si
    return f"At least {low:g}, at most {high:g}."


def _off(info: FieldInfo) -> Off:
    if NoneType not in get_args(info.annotation):
        return "never"
    return "left out" if info.default is None else "false"


def _table_in(annotation: Any) -> type[BaseModel] | None:
    """The model of a table, or of the tables of a list, where the annotation is one."""
    plain = _plain(annotation)
    if get_origin(plain) is list:
        plain = _plain(get_args(plain)[0])
    return plain if isinstance(plain, type) and issubclass(plain, BaseModel) else None


def _plain(annotation: Any) -> Any:
    """Without limits, and without None beside it."""
    if get_origin(annotation) is Annotated:
        return _plain(get_args(annotation)[0])
    if get_origin(annotation) in (Union, UnionType):
        others = [a for a in get_args(annotation) if a is not NoneType]
        return _plain(others[0]) if len(others) == 1 else annotation
    return annotation


def _first_line(model: type[BaseModel]) -> str:
    return (model.__doc__ or "").strip().split("\n")[0]
