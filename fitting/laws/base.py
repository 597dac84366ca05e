"""What every core law is: a frozen dataclass of parameters that gives G*(omega) and its derivatives.

A law lives in one file of this folder: a dataclass derived from `CoreLaw`, its fields made
with `quantity`, or with `fixed` where a fit must leave them alone. Everything else (file keys,
names in results, bounds of a fit) follows from those fields.
"""

from dataclasses import dataclass, field, fields, replace
from functools import cache, cached_property
from typing import Any, ClassVar, Self, cast

import numpy as np

from fitting.arrays import Array, Complex
from fitting.errors import OutsideModel
from fitting.laws.vicinity import Vicinity

_UNITS = ("_pa", "_rad_s", "_s")
"""How a name may end; a list's number goes before it."""


@dataclass(frozen=True)
class FileField:
    """A field of a law as files give it: its key and its factor to SI."""

    file_key: str
    to_si: float


@dataclass(frozen=True)
class Quantity(FileField):
    """What a parameter is: how files give it and its physical range in SI."""

    lower: float
    upper: float
    search: tuple[float, float]
    """Where a fit without a good start looks, in SI."""
    zero_allowed: bool = False
    """A file may say 0 (a lossless core), though a fit in log parameters cannot reach it."""

    def holds(self, value: float) -> bool:
        """Whether `value` (SI) is physical."""
        return self.lower <= value <= self.upper or (self.zero_allowed and value == 0)


def quantity(
    file_key: str,
    *,
    to_si: float = 1.0,
    lower: float,
    upper: float,
    search: tuple[float, float],
    zero_allowed: bool = False,
) -> Any:
    """A dataclass field that is a parameter of a law."""
    return field(metadata={"given": Quantity(file_key, to_si, lower, upper, search, zero_allowed)})


def fixed(file_key: str, *, to_si: float = 1.0) -> Any:
    """A dataclass field that a file gives and no fit moves."""
    return field(metadata={"given": FileField(file_key, to_si)})


@dataclass(frozen=True)
class CoreLaw:
    """Complex shear modulus G*(omega) = G'(omega) (1 + i eta(omega)) of the core, in Pa."""

    source: ClassVar[str]

    @property
    def kind(self) -> str:
        """The name of the law in files; a law of files has it as a class variable."""
        raise NotImplementedError

    def __post_init__(self) -> None:
        for k, (value, limits) in enumerate(zip(self.values, self.limits, strict=True)):
            if not limits.holds(value):
                low, high = limits.lower / limits.to_si, limits.upper / limits.to_si
                raise OutsideModel(
                    f"core law {self.kind}: {limits.file_key} = {value / limits.to_si:g} ({self.names[k]}), "
                    f"expected {low:g} to {high:g}"
                )

    @property
    def plain(self) -> "CoreLaw":
        """The law as its kind has it, without a bend."""
        return self

    @property
    def bend_count(self) -> int:
        """How many of the last parameters only bend the law: they have priors (`fitting.laws.bent_law`)."""
        return 0

    def modulus(self, omega: Array) -> Complex:
        """G* in Pa at real angular frequencies `omega` in rad/s. Shape of `omega`."""
        raise NotImplementedError

    def jacobian(self, omega: Array) -> Complex:
        """dG*/dp for every parameter, in the order of `names`. Shape (parameters, frequencies)."""
        raise NotImplementedError

    def objections(self) -> list[str]:
        """What is unphysical about the parameters together, in words."""
        return []

    def breaches(self) -> Array:
        """How far the parameters together break what every core keeps, in standard deviations.

        Rows of a fit, as many wherever the parameters are; none by default. Shape (rows,).
        """
        return np.empty(0)

    def breaches_by_logs(self) -> Array:
        """Derivatives of `breaches` to the log parameters. Shape (rows, names)."""
        return np.empty((0, len(self.names)))

    def outside(self, frequency_hz: Array) -> str:
        """Where the law is asked beyond what it was made for, in words; empty for nowhere. Shape (any,)."""
        return ""

    def to_fit(self, frequency_hz: Array) -> "CoreLaw":
        """What a fit to data at these frequencies begins with, and has the kind of; the law itself.

        Shape (any,), Hz.
        """
        return self

    @classmethod
    def alternatives(cls, near: Vicinity) -> list["CoreLaw"]:
        """Laws of this kind to try in the place of the stated one (effect `core_law`); none by default."""
        return []

    @classmethod
    def following(cls, curve: Vicinity) -> list["CoreLaw"]:
        """Laws of this kind beside a curve that a law without a formula has found; none by default."""
        return []

    @classmethod
    @cache
    def file_fields(cls) -> dict[str, FileField]:
        """All a file says of the law: its parameters and what is fixed."""
        return {f.name: f.metadata["given"] for f in fields(cls) if "given" in f.metadata}

    @classmethod
    @cache
    def quantities(cls) -> dict[str, Quantity]:
        """The parameters of the law and what they are."""
        return {name: given for name, given in cls.file_fields().items() if isinstance(given, Quantity)}

    @property
    def names(self) -> list[str]:
        """Parameters in SI units, a list's items numbered: g_pa -> g_1_pa, g_2_pa; zeta -> zeta_1."""
        return [
            _numbered(name, k) if isinstance(values, tuple) else name
            for name, values in self._fields()
            for k, _ in enumerate(_as_tuple(values))
        ]

    @property
    def values(self) -> Array:
        """Parameters in SI units, in the order of `names`. Shape (parameters,)."""
        return np.array([float(v) for _, values in self._fields() for v in _as_tuple(values)])

    @property
    def limits(self) -> list[Quantity]:
        """The physical range of every parameter, in the order of `names`."""
        quantities = self.quantities()
        return [quantities[name] for name, values in self._fields() for _ in _as_tuple(values)]

    def with_values(self, values: Array) -> Self:
        """The same law with other parameters, in the order of `names`. Shape (names,)."""
        rest = [float(v) for v in values]
        changed: dict[str, Any] = {}
        for name, old in self._fields():
            count = len(_as_tuple(old))
            taken, rest = rest[:count], rest[count:]
            changed[name] = tuple(taken) if isinstance(old, tuple) else taken[0]
        return replace(self, **changed)

    def lifted(self) -> Self:
        """Parameters of zero raised to where a search begins: a fit in logarithms cannot leave zero."""
        return self.with_values(
            np.array(
                [v if v >= q.lower else q.search[0] for v, q in zip(self.values, self.limits, strict=True)]
            )
        )

    @property
    def log_limits(self) -> tuple[Array, Array]:
        """Logarithms of the physical limits. Shape (parameters,) each."""
        lower, upper = self._ends
        return np.log(lower), np.log(upper)

    @property
    def search_widths(self) -> Array:
        """Standard deviations of the log parameters, as likely anywhere in the ranges that are searched.

        Of the plain law's. Shape (parameters,).
        """
        low, high = np.log([q.search for q in self.plain.limits]).T
        # The variance of a uniform density is its width squared over twelve.
        return np.asarray((high - low) / np.sqrt(12.0))

    @property
    def open_widths(self) -> Array:
        """Of what data leave open about where the law is. Shape (parameters,).

        As `search_widths`; but one that ran below the range that is searched is as likely anywhere from zero
        to the end of that range. In its logarithm it would be sure to be nothing.
        """
        widths = self.search_widths
        low, high = np.array([q.search for q in self.limits[: len(widths)]]).reshape(-1, 2).T
        values = self.values[: len(widths)]
        return np.where(values < low, high / values, widths)

    def with_logs(self, logs: Array) -> Self:
        """The same law with the exponentials of `logs` as parameters, kept within their limits.

        Shape (names,).
        """
        return self.with_values(np.clip(np.exp(logs), *self._ends))

    @cached_property
    def _ends(self) -> tuple[Array, Array]:
        """The physical limits. Kept: a fit asks one law for all that it tries. Shape (parameters,) each."""
        lower, upper = np.array([(q.lower, q.upper) for q in self.limits]).T
        return lower, upper

    def moduli(self, logs: Array, omega: Array) -> Complex:
        """G* in Pa of many laws of this kind, one a row of logarithms. Shapes (any, names) to (any, points).

        `omega` in rad/s, shape (points,).
        """
        return np.array([self.with_logs(row).modulus(omega) for row in logs]).reshape(len(logs), len(omega))

    def storage_and_loss(self, omega: Array) -> tuple[Array, Array]:
        """G' in Pa and eta, dimensionless. Shape of `omega` each."""
        G = self.modulus(omega)
        return G.real, G.imag / G.real

    def _fields(self) -> list[tuple[str, Any]]:
        return [(name, getattr(self, name)) for name in self.quantities()]


def _as_tuple(values: Any) -> tuple[float, ...]:
    return values if isinstance(values, tuple) else (cast(float, values),)


def _numbered(name: str, k: int) -> str:
    unit = next((u for u in _UNITS if name.endswith(u)), "")
    return f"{name.removesuffix(unit)}_{k + 1}{unit}"
