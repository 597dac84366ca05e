"""Blows that other files have as records in time, as the FRFs they give. No Qt; not for the main thread."""

from collections import defaultdict
from collections.abc import Mapping, Sequence
from pathlib import Path

from fitting.modal.frf import Frf
from gui.pages.hammer.findings import Look, accelerated
from instrument.impact.judge import judge
from instrument.impact.record import Hit
from instrument.impact.spectra import spectra


def frfs_of_records(files: Mapping[Path, Sequence[Hit]], look: Look) -> dict[str, Frf]:
    """Averages over the good hits of each file, by what they are drawn as; of the first response.

    Hits of another length or rate are an average of their own. What has no good hit is left out.
    """
    found = {}
    for path, hits in files.items():
        sets = _alike(hits)
        for number, alike in enumerate(sets, start=1):
            look()
            judged = [judge(hit) for hit in alike]
            good = [accelerated(one) for one in judged if one.accepted]
            if good:
                frf = next(iter(spectra(good).frfs.values()))
                which = f", set {number}" if len(sets) > 1 else ""
                found[f"{path.name}: {len(good)} of {len(alike)} hits{which}"] = frf
    return found


def _alike(hits: Sequence[Hit]) -> list[list[Hit]]:
    """Those that can be averaged, in the order of the first of each."""
    groups: dict[tuple[float, int, str], list[Hit]] = defaultdict(list)
    for hit in hits:
        groups[hit.sample_rate_hz, len(hit.force_n), hit.responses[0].motion].append(hit)
    return list(groups.values())
