"""Universal files of any origin to what they hold."""

from pathlib import Path

import numpy as np

from fitting.arrays import Array
from fitting.modal.frf import Motion
from instrument.errors import BadInput
from instrument.files.sweep_file import reading_said
from instrument.files.uff58 import COHERENCE, TIME, Function, read_uff58
from instrument.files.units import DERIVATIVE
from instrument.interchange.found import Found, Ratio, motion_of


def read_uff(path: Path) -> Found:
    """FRFs, transmissibilities and time records. Raises `BadInput` naming the data set."""
    universal = read_uff58(path)
    coherences = [f for f in universal.functions if f.kind == COHERENCE]
    ratios = [f for f in universal.functions if f.kind not in (TIME, COHERENCE)]
    found, theirs = Found(), [_coherence_of(k, ratios, coherences) for k in range(len(ratios))]
    for f, own in zip(ratios, theirs, strict=True):
        per = f.unit.per or "force"
        if per != "force" and _is_across(f):
            found.said.append(f"passed over: {f.name}: {f.points}: not along what drives it")
            continue
        turned = f"{f.name} (sign turned: a negative direction)" if f.turned else f.name
        if f.points and per == "force":
            # Several of a roving hammer have one name.
            turned = f"{turned}, {f.points}"
        ratio = Ratio(turned, f.x, f.values, f.unit.quantity, per, f.level_m_s2, f.place, f.points)
        found.add_ratio(ratio, None if own is None else own.values)
    found.reads = reading_said([f.name for f in ratios])
    left = [c for c in coherences if not any(c is own for own in theirs)]
    found.said += [f"passed over: {c.name}: a coherence that no one FRF here belongs to" for c in left]
    found.said += [f"passed over: {name}: function type {kind}" for name, kind in universal.others]
    _add_hits(path, found, [f for f in universal.functions if f.kind == TIME])
    return found


def _is_across(f: Function) -> bool:
    """Whether both directions are stated, and are not of one axis."""
    axes = {at.axis for at in f.between if at.axis}
    return len(axes) > 1


def _coherence_of(k: int, ratios: list[Function], coherences: list[Function]) -> Function | None:
    """Of one FRF: between the same degrees of freedom, on the same lines.

    Where a file has several of both alike, the first belongs to the first; where it has more of one, the only
    coherence is that of all, and of several nobody knows whose they are.
    """
    f = ratios[k]
    own = [c for c in coherences if _alike(c, f)]
    rank = [n for n, r in enumerate(ratios) if _alike(r, f)]
    if len(own) == len(rank):
        return own[rank.index(k)]
    return own[0] if len(own) == 1 else None


def _alike(a: Function, b: Function) -> bool:
    return a.between == b.between and len(a.x) == len(b.x) and bool(np.allclose(a.x, b.x, rtol=1e-6))


def _add_hits(path: Path, found: Found, records: list[Function]) -> None:
    """Each force with the responses behind it; where there is one force, with all of them."""
    forces = [k for k, r in enumerate(records) if r.unit.quantity == "force"]
    if records and not forces:
        found.said.append(f"passed over: {len(records)} time records without a force among them")
    for n, k in enumerate(forces, start=1):
        end = forces[n] if n < len(forces) else len(records)
        mine = records[k + 1 : end] if len(forces) > 1 else records[:k] + records[k + 1 :]
        rate, force = records[k].rate_hz, records[k].values
        source = f"{path.name} hit {n}"
        responses: list[tuple[Motion, Array]] = []
        for record in mine:
            quantity, its_rate, samples = record.unit.quantity, record.rate_hz, record.values
            if len(samples) != len(force) or abs(its_rate / rate - 1) > 1e-6:
                raise BadInput(
                    f"{path}: {source}: a response of {len(samples)} samples at {its_rate:g} Hz beside "
                    f"a force of {len(force)} at {rate:g} Hz, expected both alike"
                )
            if quantity in DERIVATIVE:
                responses.append((motion_of(source, quantity), samples))
        if not responses:
            raise BadInput(f"{path}: {source}: no response beside the force")
        found.add_hit(source, rate, force, responses)
