"""Builds `drivers/simulated/plant/plate.npz`: the 3D solid model of the plate, reduced. Takes some minutes.

    .venv/bin/python scripts/build_plant.py [--check COUNT]

Everything an effect changes is kept as its own matrix, all on one basis, found in two steps: modes and static
responses of the solid over a box of core moduli, debonded strips and root springs span a wide basis; the wide
model's responses at random places of that box span the narrow one. The first vectors of either vanish at the
root, so that leaving out the others is the rigid clamp. `--check` compares with full solutions elsewhere.
"""

import argparse
import hashlib
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace
from multiprocessing import get_context
from pathlib import Path

import numpy as np
import plant_solid
import scipy.sparse as sp
from numpy.typing import NDArray
from plant_solid import Mesh, Solid
from scipy.linalg import cholesky, eigh, solve_triangular
from scipy.sparse.linalg import LinearOperator, SuperLU, eigsh, splu

from drivers.simulated.plant import air, grid, specimen, strips
from drivers.simulated.plant.effects import AddedMass, ClampCompliance, CoreThickness, Effects, PartialDebond
from drivers.simulated.plant.model import ReducedModel, model_from
from drivers.simulated.plant.sandwich import clamp, core_stiffness, elastic, inertia
from drivers.simulated.plant.specimen import LAYERS, LENGTH_M, WIDTH_M

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
FILE = Path(__file__).resolve().parents[1] / "drivers/simulated/plant/plate.npz"


@dataclass(frozen=True)
class Case:
    """One place of the box: where snapshots are taken, or the reduced model is checked."""

    modulus_pa: complex = 0.5e6
    effects: Effects = Effects()  # noqa: RUF009
    frequency_hz: float = 0.0

    @property
    def rigid(self) -> bool:
        """The root does not move."""
        return self.effects.clamp_compliance is None


@dataclass(frozen=True)
class Recipe:
    """What a reduced model is made from."""

    mesh: Mesh
    cases: tuple[Case, ...]
    """Rigid ones first."""
    modes: int
    samples: int = 0
    """Of the wide model; none: the wide model is kept."""
    kept: tuple[int, int] = (100, 12)
    """Vectors at rest at the root, and moving there."""


SPRINGS = ((1e13, 1e13), (1e14, 1e12), (1e12, 1e14), (2e14, 2e14))
LOOSE_X = (
    (0.0, 0.03),
    (0.0, 0.06),
    (0.03, 0.06),
    (0.08, 0.11),
    (0.13, 0.16),
    (0.18, 0.21),
    (0.23, 0.27),
    (0.26, 0.3),
)
LOOSE_Y = ((0.0, 0.01), (0.0, 0.03), (0.0, 0.0499))


def sandwich_recipe(mesh: Mesh | None = None) -> Recipe:
    """Of the treated plate."""
    cases = [Case(g) for g in (0.05e6, 0.25e6, 0.8e6, 2.5e6, 7e6, 20e6)]
    spans = [PartialDebond("x", *span) for span in LOOSE_X]
    for low, high in LOOSE_Y:
        spans += [PartialDebond("y", low, high), PartialDebond("y", WIDTH_M - high, WIDTH_M - low)]
    cases += [Case(g, Effects(partial_debond=span)) for span in spans for g in (0.2e6, 4e6)]
    cases += [Case(0.5e6, Effects(clamp_compliance=ClampCompliance(*k))) for k in SPRINGS]
    cases += [Case(4e6, Effects(clamp_compliance=ClampCompliance(3e13, 3e13)))]
    return Recipe(mesh or Mesh(), tuple(cases), 24, samples=1500)


def bare_recipe(mesh: Mesh | None = None) -> Recipe:
    """Of the substrate alone: its modes to 2.5 kHz."""
    springs = (Case(effects=Effects(clamp_compliance=ClampCompliance(*k))) for k in SPRINGS)
    return Recipe(replace(mesh or Mesh(), layers=LAYERS[:1]), (Case(), *springs), 32, kept=(32, 10))


def factorised(K: sp.csr_array) -> SuperLU:
    """LU without pivoting, in the order given."""
    options = {"SymmetricMode": True}
    return splu(K.tocsc(), permc_spec="NATURAL", diag_pivot_thresh=0.0, options=options)


def snapshots(solid: Solid, case: Case, modes: int) -> Array:
    """Modes, and responses to constant base motion and point loads, each of unit energy."""
    free = solid.order(case.rigid)
    K, M = solid.stiffness(case.modulus_pa, case.effects)[free][:, free], solid.mass(case.effects)
    lu = factorised(K)
    solve = LinearOperator(K.shape, matvec=lu.solve, dtype=float)
    start = np.sin(np.arange(1, len(free) + 1))
    _, phi = eigsh(K, modes, M[free][:, free], sigma=0.0, OPinv=solve, v0=start)
    parts = [phi]
    if len(solid.mesh.layers) > 1:
        parts.append(lu.solve(np.ascontiguousarray((M @ solid.rigid)[free])))
    if case in (Case(0.25e6), Case(2.5e6)):
        x, y = LENGTH_M * np.array([0.2, 0.4, 0.6, 0.8, 1.0]), WIDTH_M * np.array([0.0, 0.3, 0.7, 1.0])
        parts.append(lu.solve(solid.readings(x, y, top=True)[:, free].T.toarray()))
    columns = np.hstack(parts)
    out = np.zeros((solid.size, columns.shape[1]))
    out[free] = columns / np.sqrt(np.einsum("ij,ij->j", columns, K @ columns))
    return out


def leading(columns: Array, energy: Callable[[Array], Array], tolerance: float, most: int) -> Array:
    """The leading vectors of the columns, of unit energy."""
    lam, u = eigh(columns.T @ energy(columns))
    kept = np.flatnonzero(lam > lam[-1] * tolerance**2)[::-1][:most]
    return np.asarray(columns @ (u[:, kept] / np.sqrt(lam[kept])))


def parted(
    rest: Array, moving: Array, energy: Callable[[Array], Array], take: Callable[[Array, int], Array]
) -> Array:
    """Both spaces in a row, the second cleared of the first."""
    first = take(rest, 0)
    for _ in range(2):
        moving = moving - first @ np.linalg.solve(first.T @ energy(first), first.T @ energy(moving))
    return np.hstack([first, take(moving, 1)])


_solid: Solid | None = None


def _take(task: tuple[Case, int]) -> Array:
    assert _solid is not None
    return snapshots(_solid, *task)


def wide_basis(solid: Solid, made: Recipe, workers: int) -> tuple[Array, int]:
    """Vectors of all the snapshots, and how many of them (the first) vanish at the root."""
    global _solid
    _solid = solid
    with ProcessPoolExecutor(workers, mp_context=get_context("fork")) as pool:
        taken = list(pool.map(_take, [(case, made.modes) for case in made.cases]))
    K = solid.stiffness(1e6, Effects(clamp_compliance=ClampCompliance(1e13, 1e13)))
    rigid = sum(case.rigid for case in made.cases)
    most = (500, 100) if made.samples else made.kept
    counts = []

    def take(columns: Array, which: int) -> Array:
        vectors = leading(columns, lambda a: K @ a, 1e-5, most[which])
        counts.append(vectors.shape[1])
        return vectors

    rest, moving = np.hstack(taken[:rigid]), np.hstack(taken[rigid:])
    return parted(rest, moving, lambda a: K @ a, take), counts[0]


def draw(random: np.random.Generator) -> Case:
    """A random place of the box."""
    low, high = np.log((0.1e6, 8e6) if random.uniform() < 0.85 else (0.05e6, 20e6))
    modulus, eta = np.exp(random.uniform(low, high)), np.exp(random.uniform(np.log(0.05), 0.2))
    kind, u = random.choice(6, p=(0.25, 0.15, 0.2, 0.2, 0.1, 0.1)), random.uniform(size=3)
    width = 0.01 + 0.05 * u[1]
    y = 0.0499 * u[0]
    low, high = ((0.0, y), (WIDTH_M - y, WIDTH_M))[int(u[1] > 0.5)]
    effects = (
        Effects(),
        Effects(clamp_compliance=ClampCompliance(10 ** (12 + 2.5 * u[0]), 10 ** (12 + 2.5 * u[1]))),
        Effects(
            partial_debond=PartialDebond("x", u[0] * (LENGTH_M - width), u[0] * (LENGTH_M - width) + width)
        ),
        Effects(partial_debond=PartialDebond("y", low, high)),
        Effects(added_mass=AddedMass(0.02 * u[0], LENGTH_M * u[1], WIDTH_M * u[2])),
        Effects(core_thickness=CoreThickness(0.9 + 0.2 * u[0])),
    )[kind]
    top = 350 if random.uniform() < 0.8 else 650
    complex_modulus = modulus * (1 + 1j * eta) / abs(1 + 1j * eta)
    return Case(complex_modulus, effects, float(np.exp(random.uniform(np.log(8), np.log(top)))))


def displacement(model: ReducedModel, case: Case) -> Complex:
    """The reduced model's response to unit heave and pitch of the base, zeros where the root is rigid."""
    effects = case.effects
    thickness = effects.core_thickness.scale if effects.core_thickness else 1.0
    M, loads = inertia(effects, model, thickness)
    K = elastic(effects, model) + case.modulus_pa * core_stiffness(effects, model, thickness)
    K = K + sum(branch.K for branch in clamp(effects, model)) - (2 * np.pi * case.frequency_hz) ** 2 * M
    n = model.rigid_count if case.rigid else len(M)
    out = np.zeros((len(M), 2), complex)
    out[:n] = np.linalg.solve(K[:n, :n], -loads[:n])
    return out


MODULI_OF_MODES = (0.1e6, 0.5e6, 2e6, 8e6)
"""Whose first modes are among the snapshots, five times as heavy: those that are odd in y hardly respond."""


def narrow_basis(model: ReducedModel, made: Recipe) -> Array:
    """The leading vectors of the wide model's responses at random places, in wide coordinates."""
    random = np.random.default_rng(20)
    M, _ = inertia(Effects(), model, 1.0)
    K = elastic(Effects(), model) + 1e6 * core_stiffness(Effects(), model, 1.0)
    H = M + K / (2 * np.pi * 500) ** 2 + 1e13 * (model["S_x"] + model["S_z"]) / (2 * np.pi * 300) ** 2
    n = model.rigid_count
    core = core_stiffness(Effects(), model, 1.0)[:n, :n]
    columns: tuple[list[Array], list[Array]] = ([], [])
    for g in MODULI_OF_MODES:
        _, phi = eigh(elastic(Effects(), model)[:n, :n] + g * core, M[:n, :n], subset_by_index=[0, 9])
        columns[0].append(5 * np.pad(phi, ((0, len(M) - n), (0, 0))))
    for case in (draw(random) for _ in range(made.samples)):
        X = displacement(model, case)
        X /= np.sqrt(np.einsum("ij,ij->j", X.conj(), M @ X).real)
        columns[not case.rigid].extend([X.real, X.imag])

    def take(columns: Array, which: int) -> Array:
        size = len(H) if which else n
        R = cholesky(H[:size, :size])
        u, s, _ = np.linalg.svd(R @ columns[:size], full_matrices=False)
        most = made.kept[which]
        print(
            f"  {columns.shape[1]} responses, {most} vectors kept, the next {s[most] / s[0]:.1e}", flush=True
        )
        return np.vstack([solve_triangular(R, u[:, :most]), np.zeros((len(H) - size, most))])

    return parted(np.hstack(columns[0]), np.hstack(columns[1]), lambda a: H @ a, take)


def projected(solid: Solid, V: Array, rigid_count: int) -> dict[str, Array]:
    """Every matrix on the basis."""

    def on_basis(A: sp.csr_array) -> Array:
        return np.asarray(V.T @ (A @ V))

    out: dict[str, Array] = {"rigid_count": np.array(rigid_count)}
    names = ("substrate", "core", "constraining")[: len(solid.mesh.layers)]
    for name, M in zip(names, solid.M_layers, strict=True):
        out[f"M_{name}"], out[f"load_{name}"] = on_basis(M), V.T @ (M @ solid.rigid)
    for name, K in zip(names[::2], solid.K_faces, strict=True):
        out[f"K_{name}"] = on_basis(K)
    out["S_x"], out["S_z"] = (on_basis(S) for S in solid.root)
    x, y = grid.points(grid.POINTS_X, LENGTH_M), grid.points(grid.POINTS_Y, WIDTH_M)
    out["w_top"], out["w_bottom"] = (solid.readings(x, y, top) @ V for top in (True, False))
    panels = solid.mesh.air_panels
    x, y = air.centres(LENGTH_M, WIDTH_M, panels)
    A, w = air.mass_per_density(LENGTH_M, WIDTH_M, panels), solid.readings(x, y, top=False)
    wV = w @ V
    out["M_air"], out["load_air"] = wV.T @ A @ wV, wV.T @ A @ (w @ solid.rigid)
    if len(names) > 1:
        for name, local in zip(("in_plane", "mixed", "normal"), solid.core_local, strict=True):
            out[f"K_core_{name}"] = on_basis(solid.assemble(local, 1))
        for axis, which in zip("xy", solid.strip_of, strict=True):
            each = [on_basis(solid.core(factor=which == k)) for k in range(which.max() + 1)]
            out[f"K_core_strips_{axis}"] = np.array(each)
    return out


def narrowed(arrays: dict[str, Array], T: Array, rigid_count: int) -> dict[str, Array]:
    """The arrays on the columns of T."""
    out = {"rigid_count": np.array(rigid_count)}
    for name, array in arrays.items():
        if name[:2] in ("M_", "K_", "S_"):
            out[name] = T.T @ array @ T
        elif name != "rigid_count":
            out[name] = T.T @ array if name.startswith("load_") else array @ T
    return out


def build(made: Recipe, workers: int = 2) -> tuple[dict[str, Array], Solid]:
    """Arrays of one reduced model, and the solid they come from."""
    solid = Solid(made.mesh)
    arrays = projected(solid, *wide_basis(solid, made, workers))
    if made.samples:
        model = ReducedModel(int(arrays["rigid_count"]), arrays)
        arrays = narrowed(arrays, narrow_basis(model, made), made.kept[0])
    return arrays, solid


def packed(arrays: dict[str, Array]) -> dict[str, Array]:
    """Symmetric matrices as their upper triangles."""
    i, j = np.triu_indices(arrays["w_top"].shape[1])
    return {k: v[..., i, j] if k[:2] in ("M_", "K_", "S_") else v for k, v in arrays.items()}


def digest() -> str:
    """Of the text of all that decides the numbers."""
    files = [__file__, *(str(m.__file__) for m in (plant_solid, air, grid, specimen, strips))]
    return hashlib.sha256(b"".join(Path(f).read_bytes() for f in files)).hexdigest()


def full_velocity(solid: Solid, case: Case, spots_m: tuple[tuple[float, float], ...]) -> Complex:
    """Relative velocity at spots for unit heave and pitch acceleration, solved on every degree of freedom."""
    free, omega = solid.order(case.rigid), 2 * np.pi * case.frequency_hz
    M = solid.mass(case.effects)
    Z = (solid.stiffness(case.modulus_pa, case.effects) - omega**2 * M)[free][:, free]
    X = factorised(Z.astype(complex)).solve(-np.ascontiguousarray((M @ solid.rigid)[free]).astype(complex))
    rows = sp.vstack([solid.deflection(*spot, top=True) for spot in spots_m]).tocsr()
    return np.asarray(1j * omega * (rows[:, free] @ X))


def check(solid: Solid, model: ReducedModel, count: int) -> None:
    """Prints the relative error in velocity at random places of the box."""
    random, spots = np.random.default_rng(7), (specimen.SPOT_M, (0.29, 0.02), (0.15, 0.17))
    rows = np.array([grid.on_plate(*spot) @ model["w_top"] for spot in spots])
    for case in (draw(random) for _ in range(count)):
        full = full_velocity(solid, case, spots)
        velocity = 2j * np.pi * case.frequency_hz * rows @ displacement(model, case)
        error = np.abs(velocity - full)
        named = {k: v for k, v in vars(case.effects).items() if v is not None}
        place = f"{case.frequency_hz:6.1f} Hz, {abs(case.modulus_pa) / 1e6:6.3f} MPa"
        at_spot, of_largest = error[0, 0] / abs(full[0, 0]), (error / np.abs(full).max(axis=0)).max()
        print(f"{place}: spot {at_spot:.1e}, of the largest {of_largest:.1e} {named}", flush=True)


def main() -> None:
    """Build, write, check."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument(
        "--check", type=int, default=0, metavar="COUNT", help="full solutions to compare with"
    )
    parser.add_argument("--out", type=Path, default=FILE)
    options = parser.parse_args()
    sandwich, solid = build(sandwich_recipe())
    sandwich, bare = packed(sandwich), packed(build(bare_recipe())[0])
    arrays = {f"sandwich_{k}": v for k, v in sandwich.items()} | {f"bare_{k}": v for k, v in bare.items()}
    np.savez_compressed(options.out, digest=np.array(digest()), **arrays)
    print(f"{options.out.name}: {options.out.stat().st_size / 1e6:.2f} MB")
    check(solid, model_from(sandwich), options.check)


if __name__ == "__main__":
    main()
