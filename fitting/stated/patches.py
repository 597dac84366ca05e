"""Where a plate is treated: rectangles, and how each may lie elsewhere than stated or be cut otherwise."""

from dataclasses import dataclass
from typing import Literal, Protocol

from fitting.stated.number_names import NumberName

Moved = Literal["patch", "cut"]
"""What of a patch is another than stated: where it lies, or how long it is cut."""
OF_PATCHES: tuple[Moved, ...] = ("patch", "cut")
"""Both, of each patch along x and along y."""
_ROUNDING_M = 1e-9
"""A patch's edge so near to the plate's is the plate's."""


@dataclass(frozen=True)
class Patch:
    """A rectangle of the plate that is treated."""

    from_x_m: float
    to_x_m: float
    from_y_m: float
    to_y_m: float

    def common_m2(self, other: "Patch") -> float:
        """Area they have in common."""
        x = min(self.to_x_m, other.to_x_m) - max(self.from_x_m, other.from_x_m)
        y = min(self.to_y_m, other.to_y_m) - max(self.from_y_m, other.from_y_m)
        return max(x, 0.0) * max(y, 0.0)


class Patched(Protocol):
    """A plate as far as its patches need it."""

    @property
    def length_m(self) -> float:
        """Along x."""

    @property
    def width_m(self) -> float:
        """Along y."""

    @property
    def patches(self) -> tuple[Patch, ...]:
        """In the order of their numbers."""


@dataclass(frozen=True)
class Shift:
    """A patch laid elsewhere along x or y than stated, or cut longer about its middle."""

    patch: int
    axis: int
    """0 for x, 1 for y."""
    kind: Moved = "patch"

    @property
    def name(self) -> str:
        """Its name in lists of results."""
        return f"{self.kind}_{self.patch + 1}_{'xy'[self.axis]}"

    def of(
        self, specimen: Patched, by_m: float, patches: tuple[Patch, ...] | None = None
    ) -> tuple[Patch, ...]:
        """The patches with it, or others of the same plate; edges that are the plate's stay."""
        found = list(patches or specimen.patches)
        sides = list(_sides(found[self.patch]))
        for k, share in self.moving(specimen).items():
            sides[k] += share * by_m
        found[self.patch] = Patch(*sides)
        return tuple(found)

    def moving(self, specimen: Patched) -> dict[int, float]:
        """How far from x, to x, from y, to y move for each metre."""
        inner = [k for k in _inner(specimen, specimen.patches[self.patch]) if k // 2 == self.axis]
        if self.kind == "patch":
            return dict.fromkeys(inner, 1.0)
        # What ends at the plate's edge is as long as its other end is laid.
        return dict(zip(inner, (-0.5, 0.5), strict=True)) if len(inner) > 1 else {}

    def stated_m(self, specimen: Patched) -> float:
        """Where its first edge that moves is, or how long it is."""
        low, high = _along(specimen.patches[self.patch], self.axis)
        return high - low if self.kind == "cut" else (low, high)[next(iter(self.moving(specimen))) % 2]

    def by_m(self, specimen: Patched, stated: Patched) -> float:
        """How much further, or longer, it is than another specimen has it."""
        pairs = zip(*(_along(s.patches[self.patch], self.axis) for s in (specimen, stated)), strict=True)
        low, high = (now - then for now, then in pairs)
        if self.kind == "cut":
            return high - low
        moving = [(low, high)[k % 2] for k in self.moving(stated)]
        return sum(moving) / len(moving)


def shift_of(name: NumberName) -> Shift:
    """The one that has a name. Raises `LookupError` where that says no patch or axis."""
    return Shift(name.item, name.axis, "cut" if name.kind == "cut" else "patch")


def shifts_of(specimen: Patched) -> tuple[Shift, ...]:
    """What patches can be laid elsewhere, or cut otherwise; those that reach from edge to edge left out."""
    each = (
        Shift(k, axis, kind) for kind in OF_PATCHES for k in range(len(specimen.patches)) for axis in (0, 1)
    )
    return tuple(shift for shift in each if shift.moving(specimen))


def _sides(patch: Patch) -> tuple[float, float, float, float]:
    return patch.from_x_m, patch.to_x_m, patch.from_y_m, patch.to_y_m


def _along(patch: Patch, axis: int) -> tuple[float, float]:
    sides = _sides(patch)
    return sides[2 * axis], sides[2 * axis + 1]


def _inner(specimen: Patched, patch: Patch) -> list[int]:
    x_0, x_1, y_0, y_1 = _sides(patch)
    x, y = specimen.length_m - _ROUNDING_M, specimen.width_m - _ROUNDING_M
    inside = (x_0 > _ROUNDING_M, x_1 < x, y_0 > _ROUNDING_M, y_1 < y)
    return [k for k, moves in enumerate(inside) if moves]
