"""Sizes of what a layer-wise plate gets wrong against a solid, at a specimen's own frequencies and moduli.

Inside, exact elasticity of the layers says how wrong (`fitting.discrepancy.theory_error`), and a wave on the
mesh how wrong that is (`fitting.discrepancy.mesh_error`); at clamp and edges a solid gives way a little more.
What is left is what solids and plates of several shapes differ by.
"""

from dataclasses import dataclass, field

import numpy as np

from fitting.arrays import Array, Complex
from fitting.discrepancy.mesh_error import MeshError, beside_edges, mesh_error
from fitting.discrepancy.theory_error import EDGE_FREQUENCY, EDGE_LOSS, theory_error
from fitting.specimen import PlateSpecimen

FREQUENCY = 3.5e-4
"""Of a resonance, relative: the scatter between plates."""
LOSS = 1e-3
"""Of a modal loss factor, relative."""
GAIN = 2e-3
"""Of the response, in size and in phase."""
STRUCK_GAIN = 1e-2
"""Of each resonance of several that a force drives, in size and in phase.

Shapes of neighbours mix by what the theory's error is of their distance, and at points near the nodes of one
little is left of it. A judgement: of solids struck without bounces 0.2 % did as well.
"""
AGAIN, AGAIN_WITHIN_S = 3e-3, 0.025
"""Of a mean over a few blows: how large second blows are in it that nobody saw, in size and in phase, and how
late they come. A judgement: a hammer touches again after some milliseconds, with a hundredth of its force."""
DRIFT = 1e-3
"""Of an instrument's gain from one end of a segment to the other."""


@dataclass(frozen=True)
class ModelError:
    """Standard deviations, relative. Shape (frequencies,) each."""

    frequency: Array
    loss: Array
    modal_loss: Array
    """The loss factor of a wave there: what `loss` is a share of."""
    signed: tuple[Array, ...] = ()
    """Of a plate: what theory and mesh get wrong of frequency and of loss in the mean, with its sign.

    Shape (points,) each.
    """
    together: Array = field(default_factory=lambda: np.zeros((0, 1)))
    """Of all resonances by one cause each. Shape (causes, frequencies)."""

    @property
    def in_common(self) -> tuple[float, float]:
        """Of the first frequency: what the one cause that all share makes of it, and of its loss."""
        if self.signed:
            return float(self.signed[0][0]), float(self.signed[1][0])
        return float(self.together[:, 0].sum()), 0.0


def model_error_at(
    specimen: PlateSpecimen, frequency_hz: Array, G: Complex, *, of_mesh: bool = True
) -> ModelError:
    """Around some frequencies, the core's modulus there given. Shape (points,) each.

    Not `of_mesh`: where what the mesh gets wrong is taken off as far as a coarser one says it.
    """
    found = theory_error(specimen, frequency_hz, G)
    at = np.broadcast_to(np.asarray(G, dtype=complex), found.wavenumber.shape)
    mesh, beside = MeshError(*np.zeros((4, len(at)))), (np.zeros(len(at)), np.zeros(len(at)))
    if set(specimen.edges) != {"simply-supported"}:
        # A mode there is no sum of plain waves, and less off than they are: sliding faces are what counts.
        beside = beside_edges(specimen, at, taken_off=not of_mesh)
    elif of_mesh:
        mesh = mesh_error(specimen, found.wavenumber, at)
    s = specimen
    layers = (s.substrate, s.core, s.constraining)
    thickness = sum(layer.thickness_m for layer in layers if layer is not None)
    if s.both_sides and s.core is not None:
        thickness = 2 * s.apart_m + (layers[2].thickness_m if layers[2] is not None else 0.0)
    edge = (thickness / min(specimen.length_m, specimen.width_m)) ** 2
    return ModelError(
        frequency=_together(
            *(FREQUENCY, found.frequency_error, EDGE_FREQUENCY * edge),
            *(mesh.frequency, mesh.frequency_by_way, beside[0]),
        ),
        loss=_together(
            *(LOSS, found.loss_factor_error, EDGE_LOSS * edge),
            *(mesh.loss, mesh.loss_by_way, beside[1]),
        ),
        modal_loss=found.loss_factor,
        signed=(found.frequency_error + mesh.frequency, found.loss_factor_error + mesh.loss),
    )


def _together(*each: Array | float) -> Array:
    """Sizes of independent causes, together."""
    return np.sqrt(sum(np.square(one) for one in each))
