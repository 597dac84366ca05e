"""A coarse plate on all its degrees of freedom, solved directly beside the widened reduced one."""

from dataclasses import replace

import numpy as np
import scipy.sparse as sp
import scipy.sparse.linalg as sla

from fitting.diagnosis.problem.plate_answer import answer
from fitting.dynamics.damping import viscous_damping
from fitting.effects import CATALOGUE
from fitting.plate.plate import Plate
from fitting.reduced.domain import domain_of
from fitting.reduced.reduced_plate import reduce_plate
from fitting.widened.enriching import enriched
from fitting.widened.full_plate import FullPlate
from instrument.files.specimen_file import read_specimen
from instrument.paper_case import case_file

OMEGA = 2 * np.pi * np.array([19.5, 62.0, 100.0, 281.0])
G = np.array([0.3e6 * (1 + 0.3j), 0.45e6 * (1 + 0.6j), 0.55e6 * (1 + 0.9j), 1.2e6 * (1 + 1.1j)])
SPANNED = (
    "treatment_not_gripped",
    "uneven_clamp",
    "orthotropic_substrate",
    "graded_core",
    "tether",
    "base_roll",
    "constraining_stiffness",
    "constraining_thickness",
    "core_thickness",
    "substrate_stiffness",
    "clamp_line",
)


class Full:
    """The plate as stated, and what a full solve makes of it with something else."""

    def __init__(self, names=SPANNED, **changes):
        self.specimen = replace(read_specimen(case_file("zn1.toml")), elements=(14, 10), **changes)
        self.plate = Plate(self.specimen)
        self.damping = viscous_damping(self.plate)
        self.full = FullPlate(self.plate, self.damping)
        reduced = reduce_plate(self.plate, self.damping, domain_of(self.specimen, np.array([14.0, 300.0])))
        spans = {s.name: s for n in names for e in CATALOGUE[n].variants() for s in e.spans}
        self.spanned = enriched(self.full, self.plate.carried @ reduced.V, list(spans.values()))

    omega, modulus = OMEGA, G

    @property
    def loose(self):
        return self.full.loose

    @property
    def clamped(self):
        """Degrees of freedom of the loose plate that move."""
        return np.unique(self.full.lift.indices)

    def direct(
        self, *, loose=None, K=0.0, K_1=0.0, M=0.0, load=0.0, r=None, row=None, free=None, U=None, travel=0.0
    ):
        """Displacements at `OMEGA`, and `travel` times the base's; `load` may be a function of omega."""
        loose, found = loose or self.loose, []
        U, d = self.full.lift @ self.damping.U if U is None else U, self.damping.d
        r = self.full.heave if r is None else r
        row = loose.observe(*self.full.pickup_m) if row is None else row
        free = self.clamped if free is None else free
        # What the held plate's own free edges lack in twist, not those of the loose one.
        K = K + loose.edge_twist - self.full.lift @ self.full.held.edge_twist @ self.full.lift.T
        for w, g in zip(OMEGA, G, strict=True):
            load_w = load(w) if callable(load) else load
            A = sp.csc_array(loose.K_0 + K + g * (loose.K_1 + K_1) - w**2 * (loose.M + M), dtype=complex)
            f = -(loose.M @ r) + load_w
            solve = sla.splu(A[free][:, free].tocsc()).solve
            X = solve(np.column_stack([f[free], U[free]]).astype(complex))
            small = np.diag(1 / (1j * w * d)) + U[free].T @ X[:, 1:]
            x = row[free] @ (X[:, 0] - X[:, 1:] @ np.linalg.solve(small, U[free].T @ X[:, 0]))
            found.append(x - travel / w**2)
        return np.array(found)

    def taken(self, effect):
        plate = self.spanned.take(effect.spans)
        return plate.with_part if effect.sharp else plate

    def reduced(self, effect, u):
        plate = self.taken(effect)
        change = effect.change(plate, np.array(u, dtype=float))
        return answer(plate, OMEGA, G, change, [], with_pitch=False).heave.value

    def error(self, effect, u, **changes):
        return float(np.max(np.abs(self.reduced(effect, u) / self.direct(**changes) - 1)))

    def slope(self, effect, u, n):
        """Derivative to unknown n by the adjoint, and by differences."""
        plate, u = self.taken(effect), np.array(u, dtype=float)
        h = 1e-4 * (abs(u[n]) if effect.parameters[n].logarithmic else effect.parameters[n].typical)
        step = h * np.eye(len(u))[n]
        up, down = (effect.change(plate, u + s * step) for s in (1, -1))
        nearby = [(up, down, 2 * h)]
        by = answer(plate, OMEGA, G, effect.change(plate, u), nearby, with_pitch=False).heave.by_u[0]
        return by, (self.reduced(effect, u + step) - self.reduced(effect, u - step)) / (2 * h)
