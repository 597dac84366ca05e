"""The reduced plate widened: full responses to what each effect stirs, condensed and projected once."""

from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import numpy as np
import scipy.linalg as la
import scipy.sparse as sp
from threadpoolctl import threadpool_limits

from fitting.arrays import Array
from fitting.numerics.linear import times
from fitting.plate.element import THETA_X, THETA_Y, W
from fitting.plate.layers_array import layers_of
from fitting.plate.part_matrices import moving_part, on_motions, projected_parts
from fitting.plate.part_names import names_of
from fitting.plate.parts import coefficients, loaded
from fitting.progress import Report, unheard
from fitting.widened.enriched_plate import EnrichedReducedPlate
from fitting.widened.full_plate import FullPlate
from fitting.widened.leading import Motions, Stirred
from fitting.widened.span import Span

SNAPSHOTS = 12
"""Points of frequency and modulus that are solved in full, each a factorisation. A choice; `TOLERANCE` is of
what they span."""
_LOWEST_HZ, USUAL_HZ = 12.0, 420.0
"""From where to where these reach: a laboratory plate's first resonances (decision 30)."""
_SOFTEST_PA, _STIFFEST_PA = 1e5, 1e7
"""Storage moduli between which they are: the middle of `fitting.reduced.domain.MODULI_PA`. A choice."""
_LOSSY = 1 + 0.6j
"""Over the storage modulus: of a core that damps well. A choice."""
_R2 = (0.7549, 0.5698)
"""1/p and 1/p^2 of the plastic number, p^3 = p + 1, to four places: multiples of them fill a square evenly.
Roberts, The unreasonable effectiveness of quasirandom sequences (2018)."""
_FURTHER, _BEYOND = 6, 1.05
"""Snapshots from there on where a sweep goes further, and to what multiple of its reach (decision 30)."""
_HUNDRED_HZ = 100
"""A sweep's reach is rounded up to the next hundred (decision 30)."""
_SOLVED, _CONDENSED = 0.8, 0.1
"""Shares of the work that full solves are, and taking the leading motions of what they found."""
TOLERANCE = 3e-3
"""Of a typical change, what may be missed; the reading's error goes with its square."""
_TOLERANCE_ODD = 1e-4
"""The same of what pushes at the spots stir of motions odd in y: all effects that twist a plate need it."""


def enriched(
    full: FullPlate,
    basis: Array,
    spans: Sequence[Span],
    progress: Report = unheard,
    reach_hz: float = USUAL_HZ,
) -> EnrichedReducedPlate:
    """Build it to hold up to `reach_hz`.

    `basis`: the unchanged plate's columns over the held degrees of freedom. Shape (held, k).
    """
    halves, points = _halves(full), _points(reach_hz)
    first = halves[0]
    with threadpool_limits(1, "blas"), ThreadPoolExecutor(2) as pool:
        found: list[list[dict[str, Stirred]]] = []
        for answers in pool.map(lambda at: _responses(full, halves, spans, at), points):
            found.append(answers)
            progress(_SOLVED * len(found) / len(points))
        own = [first.orthonormal(first.of(full.lift @ basis))]
        most = _MOST_ODD * (full.loads.shape[1] - 1)
        own += [
            odd.leading([each[1]["plate"] for each in found], None, _TOLERANCE_ODD, most)
            for odd in halves[1:]
        ]
        for half, ending, known in zip(halves, _ENDINGS, own, strict=False):
            half.groups[f"plate{ending}"] = known

        def motions(span: Span) -> list[Array]:
            count = span.columns * len(points) // SNAPSHOTS * (1 if full.only_even else 2)
            count = count * full.loads.shape[1] // 2
            return [
                half.leading([each[n][span.name] for each in found], own[n], TOLERANCE, count)
                for n, half in enumerate(halves[: 2 if span.odd else 1])
            ]

        for span, V in zip(spans, pool.map(motions, spans), strict=True):
            for half, ending, columns in zip(halves, _ENDINGS, V, strict=False):
                half.groups[f"{span.name}{ending}"] = columns
            progress(_SOLVED + _CONDENSED * len(first.groups) / len(spans))
        return _project(full, halves, spans, pool)


_MOST_ODD = 40
"""Motions odd in y beside a plate's own even ones, for each spot: a bound on time."""
_ENDINGS = ("", "/odd")
"""Of a group's name, by the parity of its motions."""


def _halves(full: FullPlate) -> tuple[Motions, ...]:
    """Even and odd motions apart where nothing but effects couples them, all together otherwise."""
    if full.only_even:
        return Motions(full, "even"), Motions(full, "odd")
    # Let go the clamps may be alike on both sides, though the held plate is not.
    return (Motions(full, "carried" if full.specimen.alike_in_y else "all"),)


def reach_over(frequency_hz: Array) -> float:
    """What the motions that effects stir must reach for some frequencies, in Hz. Shape (n,)."""
    highest = float(np.max(frequency_hz))
    return USUAL_HZ if highest <= USUAL_HZ else _HUNDRED_HZ * float(np.ceil(highest / _HUNDRED_HZ))


def _points(reach_hz: float) -> list[tuple[float, complex]]:
    """Frequencies in rad/s and lossy moduli in Pa, both spread by their logarithms."""
    s = _spread(SNAPSHOTS, _R2[0])
    omega = list(2 * np.pi * _LOWEST_HZ * (USUAL_HZ / _LOWEST_HZ) ** s)
    if reach_hz > USUAL_HZ:
        t = (0.5 + np.arange(_FURTHER)) / _FURTHER
        omega += list(2 * np.pi * USUAL_HZ * (_BEYOND * reach_hz / USUAL_HZ) ** t)
    m = _spread(len(omega), _R2[1])
    return [
        (float(w), complex(_SOFTEST_PA * (_STIFFEST_PA / _SOFTEST_PA) ** n * _LOSSY))
        for w, n in zip(omega, m, strict=True)
    ]


def _spread(count: int, step: float) -> Array:
    """One coordinate of the R2 sequence, from its middle. Shape (count,)."""
    return np.asarray((0.5 + np.arange(count) * step) % 1)


def _responses(
    full: FullPlate, halves: tuple[Motions, ...], spans: Sequence[Span], point: tuple[float, complex]
) -> list[dict[str, Stirred]]:
    """To the pickup and of each span, by its name: even motions, and odd ones where it has any."""
    at = full.snapshot(*point)
    size = np.sqrt(np.real(np.vdot(at.x, times(full.scale, at.x))))
    at = replace(at, x=at.x / size, z=at.both[:, 1:] / size)
    forces = [span.forces(full, at) for span in spans]
    answers = at.answers(forces, [span.odd or not full.only_even for span in spans])
    found = {span.name: span.responses(full, at, X) for span, X in zip(spans, answers, strict=True)}
    twisting = {span.name: found[span.name] for span in spans if span.odd} | {"plate": at.both[:, 1:]}
    return [
        dict(zip(some, half.stirred(list(some.values())), strict=True))
        for half, some in zip(halves, (found, twisting), strict=False)
    ]


def _project(
    full: FullPlate, halves: tuple[Motions, ...], spans: Sequence[Span], pool: ThreadPoolExecutor
) -> EnrichedReducedPlate:
    loose, s = full.loose, full.specimen
    V = np.hstack([half.half.P @ half.columns for half in halves])
    matrices: dict[str, Array] = {}
    vectors: dict[str, Array] = {}
    of_spans = [(f"{span.name}.{name}", A) for span in spans for name, A in span.matrices(full).items()]
    projected = pool.map(lambda named: _between(V, named[1]), of_spans)
    parts = [
        pool.submit(projected_parts, loose, half.half.P @ half.columns, one_parity=full.only_even)
        for half in halves
    ]
    for span in spans:
        vectors |= {f"{span.name}.{name}": V.T @ v for name, v in span.vectors(full).items()}
    for (name, _), A in zip(of_spans, projected, strict=True):
        matrices[name] = A
    k = V.shape[1]
    both = _in_blocks([found.result() for found in parts])
    stated = coefficients(s, s)
    # The inertia of held nodes loads their neighbours.
    of_load = on_motions(moving_part(s)[..., loose.free], V)
    at = names_of(s).counts
    return EnrichedReducedPlate(
        group=np.array([name for half in halves for name in half.names]),
        M=np.tensordot(stated.M, both[at.M], axes=1),
        K_0=np.tensordot(stated.K_0, both[at.K_0], axes=1) - _edges(full, V),
        K_1=np.tensordot(stated.K_1, both[at.K_1], axes=1),
        U=V.T @ (loose.M @ _over_mass(full)),
        d=full.damping.d,
        load=-loaded(stated.load, of_load) if s.drive == "base" else V.T @ full.drive,
        pitch=-V.T @ (loose.M @ full.pitching) if s.drive == "base" else np.zeros(k),
        observe=V.T @ loose.observe(*full.pickup_m),
        gram=la.block_diag(*(half.gram for half in halves)),
        names=np.array(list(matrices), dtype=str),
        matrices=np.array(list(matrices.values())).reshape(-1, k, k),
        vector_names=np.array(list(vectors), dtype=str),
        vectors=np.array(list(vectors.values())).reshape(-1, k),
        deflection=loose.on_nodes(V)[:, [W, THETA_X, THETA_Y]],
        size=np.array([s.length_m, s.width_m, loose.mesh.n_x, loose.mesh.n_y], dtype=float),
        pickup=np.array(full.pickup_m),
        parts=both,
        load_part=of_load,
        layers=layers_of(s),
    )


def _edges(full: FullPlate, V: Array) -> Array | float:
    """What `Plate.K_0` lacks beside its parts. Shape (k, k)."""
    if not full.specimen.lacks_edge_twist:
        return 0.0
    W = full.lift.T @ V
    return np.asarray(W.T @ (full.held.edge_twist @ W))


def _in_blocks(parts: Sequence[Array]) -> Array:
    """Stacks of matrices along the diagonal. Shape (count, k, k)."""
    k = sum(p.shape[1] for p in parts)
    found, at = np.zeros((len(parts[0]), k, k)), 0
    for p in parts:
        there = slice(at, at + p.shape[1])
        found[:, there, there] = p
        at = there.stop
    return found


def _between(V: Array, A: sp.sparray | Array) -> Array:
    """V^T A V; an array stands for L of A = L L^T."""
    if isinstance(A, np.ndarray):
        L = V.T @ A
        return L @ L.T
    # A strip touches few degrees of freedom.
    A = A.tocsr()
    touched = np.flatnonzero(np.diff(A.indptr))
    few = V[touched]
    return np.asarray(few.T @ (A[touched][:, touched] @ few))


def _over_mass(full: FullPlate) -> Array:
    """Phi of C_1 = M Phi diag(d) Phi^T M, on the loose plate. Shape (n, modes)."""
    found = np.zeros((full.loose.size, len(full.damping.d)))
    for held in full.halves:
        if held is None:
            continue
        half = held.half
        found += held.up @ half.chain.factorise(half.M)(half.down @ full.damping.U)
    return found
