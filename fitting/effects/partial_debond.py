"""The core has come loose along a strip: it carries hardly any shear there."""

from collections.abc import Iterable, Mapping, Sequence

import numpy as np
import scipy.sparse as sp

from fitting.arrays import Array, Complex
from fitting.effects.base import ONE_SIDE, WHOLE, Effect, EffectParameter
from fitting.effects.given import Points
from fitting.numerics.linear import times
from fitting.plate.element import core_shear_stiffness
from fitting.specimen import StatedSpecimen
from fitting.stated.patches import Patch
from fitting.widened.change import Change
from fitting.widened.enriched_plate import EnrichedReducedPlate
from fitting.widened.full_plate import FullPlate, Snapshot
from fitting.widened.span import Span

LEFT = 0.01
"""Share of the shear stiffness that a loose strip keeps."""
_WIDTH_M = 0.025
"""To begin with, and between starts: about a twelfth of a plate of 300 mm."""
_EDGE_WIDTHS_M = (0.025, 0.01)
"""To begin with at an edge, where there is no place to be found."""


class Strips(Span):
    """Shear stiffness of every row of elements, and motions with some of them loose."""

    columns = 24

    def __init__(self, along: str) -> None:
        self.along = along
        self.name = f"strips_{along}"
        # Strips across all of the width leave the plate even in y.
        self.odd = along == "y"

    def matrices(self, full: FullPlate) -> Mapping[str, sp.sparray | Array]:
        return {f"{k:03d}": A for k, A in enumerate(strips(full, self.along))}

    def forces(self, full: FullPlate, at: Snapshot) -> Complex:
        def make() -> sp.csr_array:
            # Two rows of elements at a time.
            rows = strips(full, self.along)
            return sp.csr_array(sp.vstack([sum(rows[k : k + 2]) for k in range(0, len(rows), 2)]))

        lost = times(full.once(f"pairs of strips along {self.along}", make), at.both)
        pairs = lost.reshape(-1, *at.both.shape).transpose(1, 0, 2).reshape(len(at.x), -1)
        return np.asarray((1 - LEFT) * at.G * pairs)


def strips(full: FullPlate, along: str) -> list[sp.csc_array]:
    """Shear stiffness for G = 1 Pa of every row of elements, counted along x or y. Shape (n, n) each."""

    def make() -> list[sp.csc_array]:
        mesh, s = full.loose.mesh, full.specimen
        assert s.core is not None
        assert s.constraining is not None
        every = np.arange(mesh.n_x * mesh.n_y)
        i, j = np.divmod(every, mesh.n_y)
        place, count = (i, mesh.n_x) if along == "x" else (j, mesh.n_y)
        found = [sp.csc_array((full.loose.size, full.loose.size)) for _ in range(count)]
        for cell in full.loose.cells:
            if not cell.treated:
                continue
            Ae = core_shear_stiffness(mesh.shape, s.core, s.substrate, s.constraining, cell.over)
            elements = every[cell.elements]
            for k in np.unique(place[elements]):
                found[k] = found[k] + full.loose.scatter(Ae, elements[place[elements] == k])
        return found

    return full.once(f"strips along {along}", make)


def joined(pieces: Iterable[tuple[float, float]]) -> list[tuple[float, float]]:
    """Pieces of a line, those that touch as one; ascending."""
    found = list[tuple[float, float]]()
    for low, high in sorted(pieces):
        if found and low <= found[-1][1]:
            found[-1] = (found[-1][0], max(high, found[-1][1]))
        else:
            found.append((low, high))
    return found


class PartialDebondEffect(Effect):
    """A strip across the plate or along it; or one that ends at an edge, its width alone unknown.

    Of patches an edge is where one of them ends.
    """

    name = "partial_debond"
    enters = "stiffness"
    source = "shear coupling lost in a strip, e.g. Wang and Wereley, AIAA J. 40 (2002)"
    needs = ONE_SIDE
    unexplained_share = 0.02
    chance = 0.03
    discriminating_test = "a tap test or ultrasound over the plate; a second spot off the axis"

    def __init__(
        self,
        along: str = "x",
        *,
        at_edge: bool = False,
        patches: tuple[Patch, ...] = (),
        edge_m: float | None = None,
    ) -> None:
        """`patches` are those of the specimen it stands on, `edge_m` the one edge it begins at, if any."""
        self.along, self.at_edge, self.patches, self.edge_m = along, at_edge, patches, edge_m
        self.spans = (Strips(along),)
        place = (
            EffectParameter(f"{along}_edge", "m", 0.0, np.inf, 0.02, neutral=None, fixed=True)
            if at_edge
            else EffectParameter(f"{along}_from", "m", 0.0, np.inf, 0.02, neutral=None)
        )
        self.parameters = (place, EffectParameter("width", "m", 0.0, 0.15, _WIDTH_M, spread=0.03))

    def on(self, kind: str) -> Effect | None:
        return DebondOfBeamEffect() if kind == "beam" else super().on(kind)

    def form_on(self, specimens: Sequence[StatedSpecimen]) -> Effect | None:
        form = super().form_on(specimens)
        # Of plates with unlike patches an edge of one is no edge of the other.
        alike = {getattr(s, "patches", ()) for s in specimens}
        if form is not self or len(alike) > 1:
            return form
        return PartialDebondEffect(self.along, at_edge=self.at_edge, patches=alike.pop(), edge_m=self.edge_m)

    def variants(self) -> tuple[Effect, ...]:
        # Glue misses an edge first, and a place that is known need not be paid for.
        anywhere, at_edge = (
            [PartialDebondEffect(a, at_edge=e, patches=self.patches) for a in ("x", "y")]
            for e in (False, True)
        )
        if not self.patches:
            return (*anywhere, *at_edge)
        # Each edge by itself: the best first step is not always that of the right one.
        each = [
            PartialDebondEffect(e.along, at_edge=True, patches=self.patches, edge_m=edge)
            for e in at_edge
            for edge in e._edges(0.0)
        ]
        return (*anywhere, *each)

    def _treated(self, side: float) -> list[tuple[float, float]]:
        """From where to where it is treated, patch by patch, in m."""
        along_x = self.along == "x"
        ends = [(p.from_x_m, p.to_x_m) if along_x else (p.from_y_m, p.to_y_m) for p in self.patches]
        return sorted(set(ends)) or [(0.0, side)]

    def _edges(self, side: float) -> list[float]:
        return sorted({edge for ends in self._treated(side) for edge in ends})

    def _side(self, plate: EnrichedReducedPlate) -> float:
        return plate.length_m if self.along == "x" else plate.width_m

    def limits(self, plate: EnrichedReducedPlate) -> tuple[Array, Array]:
        lower, upper = super().limits(plate)
        return lower, np.minimum(upper, [self._side(plate), np.inf])

    def starts(self, plate: EnrichedReducedPlate, points: Points) -> list[Array]:
        side = self._side(plate)
        if self.at_edge:
            edges = self._edges(side) if self.edge_m is None else [self.edge_m]
            return [np.array([edge, width]) for width in _EDGE_WIDTHS_M for edge in edges]
        treated = self._treated(side)
        count = int(side / _WIDTH_M)
        places = (k / count * side for k in range(count))
        return [
            np.array([x, _WIDTH_M]) for x in places if any(a <= x + _WIDTH_M / 2 <= b for a, b in treated)
        ]

    def scaled(self, u: Array, a: float) -> Array:
        width = max(0.0, a * u[1])
        # The first look says how much is loose about the middle of what it tried.
        return np.array([u[0] if self.at_edge else u[0] + (u[1] - width) / 2, width])

    def _ends(self, place: float, width: float) -> tuple[float, float]:
        """Between what places it is loose, in m."""
        begins = {a for a, _ in self._treated(0.0)}
        inwards = -1 if self.at_edge and place not in begins else 1
        low, high = sorted((place, place + inwards * width))
        return low, high

    def change(self, plate: EnrichedReducedPlate, u: Array) -> Change:
        stack = plate.stack(f"strips_{self.along}.")
        edges = np.linspace(0, self._side(plate), len(stack) + 1)
        treated, loose = np.zeros(len(stack)), np.zeros(len(stack))
        for a, b in joined(self._treated(self._side(plate))):
            low, high = (np.clip(x, edges[:-1], edges[1:]) for x in (a, b))
            treated += high - low
            low, high = (np.clip(x, low, high) for x in self._ends(u[0], u[1]))
            loose += high - low
        share = np.divide(loose, treated, out=np.zeros_like(loose), where=treated > 0)
        return Change(K_1=-(1 - LEFT) * np.tensordot(share, stack, axes=1))

    def story(self, u: Mapping[str, float]) -> str:
        where = "across the plate, x" if self.along == "x" else "along the plate, y"
        low, high = self._ends(u[f"{self.along}_{'edge' if self.at_edge else 'from'}"], u["width"])
        return f"the core is loose in a strip {where} = {1e3 * low:.0f} to {1e3 * high:.0f} mm"


class DebondOfBeamEffect(PartialDebondEffect):
    """A strip across a beam: there is none along it."""

    needs = WHOLE

    discriminating_test = "a tap test or ultrasound along the beam; a second spot"

    def variants(self) -> tuple[Effect, ...]:
        return tuple(DebondOfBeamEffect(at_edge=e) for e in (False, True))

    def story(self, u: Mapping[str, float]) -> str:
        low, high = self._ends(u[f"x_{'edge' if self.at_edge else 'from'}"], u["width"])
        return f"the core is loose from {1e3 * low:.0f} to {1e3 * high:.0f} mm"
